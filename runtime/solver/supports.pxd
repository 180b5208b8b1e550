# The C types of `supports.py`.

cimport cython


cdef class Supports:
    cdef public long long[::1] first, action, effect
    cdef public list reach

    cpdef bint leads_to(self, long long predicate, long long other) except -1
