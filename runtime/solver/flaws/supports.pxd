# The C types of `supports.py`.



cdef class Supports:
    cdef public long long[::1] first, action, effect
    cdef public list reach
    cdef public object guarded

    cpdef bint leads_to(self, long long predicate, long long other) except -1

    cpdef bint is_guarded(self, long long predicate) except -1
