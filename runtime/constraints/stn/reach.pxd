# The C types of `reach.py`.

cimport cython
from runtime.constraints.domains.store cimport Store
from runtime.constraints.stn.heap cimport Heap
from runtime.constraints.stn.network cimport is_followed

cdef long long _APART, _MOST_NEAR, _REACHED, _UNKNOWN


@cython.final
cdef class Reach:
    cdef public Store engine
    cdef public Heap heap
    cdef public bint temporal_only, is_forward
    cdef public long long origin, most, stamp
    cdef public long long near_stamp
    cdef public long long[::1] stamped, distance, near, near_distance, near_stamped

    cpdef int begin(self, long long origin, bint is_forward) except -1

    @cython.locals(near="long long")
    cpdef bint is_apart(self, long long other) except -1

    cpdef bint is_plain(self, long long other) except -1

    @cython.locals(at="long long", count="long long", e="long long", is_shorter=bint, u="long long")
    cdef int _probe(self, long long other) except -1

    @cython.locals(room="long long")
    cdef int _restart(self, long long most) except -1

    @cython.locals(e="long long", u="long long")
    cdef int _expand(self) except -1
