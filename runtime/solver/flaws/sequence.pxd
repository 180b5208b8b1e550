# The C types of `sequence.py`.

cimport cython
from runtime.constraints.stn.reach cimport Reach
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows

cdef long long END, LISTS, LIST_ORDER, NONE, START


cdef class TimelineSequence:
    cdef public Plan plan
    cdef public Rows rows
    cdef public Reach from_start, to_start, from_end, to_end
    cdef public long long[::1] tokens, index_of
    cdef public long long range_object, range_first, range_end

    @cython.locals(count="long long")
    cpdef long long take(self, long long o) except? -1

    cpdef int look_around(self, long long t) except -1

    cpdef int note_range(self, long long o, long long count, long long first, long long end) except -1
