# The C types of `sparse_set.py`.


cdef class SparseSet:
    cdef public signed char[::1] marks
    cdef public long long[::1] items
    cdef public long long count

    cpdef int add(self, long long number) except -1

    cpdef bint has(self, long long number) except -1
