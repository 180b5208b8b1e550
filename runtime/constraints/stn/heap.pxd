# The C types of `heap.py`.

cimport cython


cdef class Heap:
    cdef public long long length
    cdef public long long[::1] first, second, item

    cpdef int push(self, long long key, long long tie, long long entry) except -1

    cpdef long long top_key(self) except? -1

    cpdef long long top_item(self) except? -1

    @cython.locals(at="long long", below="long long")
    cpdef int pop(self) except -1

    cpdef int clear(self) except -1
