# The C types of `distances.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.constraints.domains.store cimport Store
from runtime.constraints.stn.heap cimport Heap
from runtime.constraints.stn.network cimport is_followed


cdef class Distances:
    cdef public Store engine
    cdef public Heap heap
    cdef public long long stamp
    cdef public long long[::1] stamped, distance, via
    cdef public bint by_bounds, temporal_only

    @cython.locals(e="long long", engine=Engine, is_shorter=bint, u="long long")
    cpdef bint admits(self, long long source, long long target, long long weight) except -1
