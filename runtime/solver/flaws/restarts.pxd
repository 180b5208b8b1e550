# The C types of `restarts.py`.

cimport cython
from runtime.constraints.domains.store cimport Store

cdef long long FEW_FAILURES, LARGEST_SIZE, SUPPORT_CONSTRAINT, SUPPORT_EDGE, WEIGHT_SCALE


cdef class Restarts:
    cdef public Store engine
    cdef public long long[::1] weight
    cdef public long long failures, limit, count

    cpdef int clear(self) except -1

    cpdef long long rank(self, long long v, long long size) except? -1

    cpdef int _add(self, long long v) except -1

    @cython.locals(k="long long")
    cpdef int note_failure(self) except -1

    cpdef int restart(self) except -1
