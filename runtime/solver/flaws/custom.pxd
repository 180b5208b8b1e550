# The C types of `custom.py`.

cimport cython

cdef long long NONE, NO_CHOICE


cdef class CustomManager:

    cpdef double priority(self) except? -1

    cpdef long long select(self) except? -1

    cpdef long long attempt(self, long long flaw, long long number) except? -1

    cpdef bint has_choice(self, long long flaw, long long number) except -1
