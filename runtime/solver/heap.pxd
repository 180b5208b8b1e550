cimport cython


cdef class Heap:
    cdef long long[::1] first
    cdef long long[::1] second
    cdef long long[::1] item
    cdef public long long length
    cdef long long capacity

    @cython.locals(at="long long", above="long long", first="long long[::1]", second="long long[::1]")
    cpdef long long push(self, long long key, long long tie, long long entry) except -1
    cpdef long long top_key(self) except? -1
    cpdef long long top_tie(self) except? -1
    cpdef long long top_item(self) except? -1
    @cython.locals(at="long long", below="long long", last="long long", key="long long", tie="long long",
                   entry="long long", first="long long[::1]", second="long long[::1]")
    cpdef long long pop(self) except -1
    cdef long long grow(self) except -1
