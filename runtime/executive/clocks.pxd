# The C types of `clocks.py`.


cdef class FastClock:
    cdef public long long tick
    cdef public dict counts

    cpdef object begin(self, long long tick)

    cpdef object count(self, long long steps)

    cpdef bint is_free(self) except -1
