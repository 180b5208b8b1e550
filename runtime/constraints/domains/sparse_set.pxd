# The C types of `sparse_set.py`.

cimport cython


cdef class SparseSet:
    cdef public signed char[::1] marks
    cdef public long long[::1] items
    cdef public long long count

    @cython.locals(i="long long")
    cpdef int empty(self, long long room) except -1

    cpdef int add(self, long long number) except -1

    cpdef bint has(self, long long number) except -1

    @cython.locals(at="long long", gap="long long", i="long long", number="long long")
    cpdef int sort(self) except -1
