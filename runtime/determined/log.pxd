# The C types of `log.py`.


cdef long long ROW


cdef class Log:
    cdef public long long[::1] rows, draws
    cdef public double[::1] values
    cdef public long long row_count, row_capacity, value_count, value_capacity, draw_count, draw_capacity

    cpdef long long note(self, long long tick, long long line, long long predicate, long long block) except? -1

    cpdef long long take(self, long long row, long long width) except? -1

    cpdef int note_draw(self, long long tick, long long parameter) except -1

    cpdef int forget_from(self, long long tick) except -1

    cpdef int grow_rows(self) except -1

    cpdef int grow_values(self) except -1
