# The C types of `log.py`.

cimport cython

cdef long long BLOCK, CAUSE, EVENT, FAR, KIND, LINE, ROW, SHOWN, VALUES


cdef class Log:
    cdef public long long[::1] rows, draws, told, latest, order
    cdef public double[::1] values
    cdef public long long row_count, row_capacity, value_count, value_capacity, draw_count, draw_capacity
    cdef public long long shown, told_count, told_rows, told_draws

    cpdef long long note(self, long long tick, long long line, long long predicate, long long block) except? -1

    cpdef long long room(self, long long count) except? -1

    cpdef int note_draw(self, long long tick, long long parameter) except -1

    cpdef int forget_from(self, long long tick) except -1

    cpdef long long next_tick(self) except? -1

    @cython.locals(row="long long")
    cpdef long long next_change(self, long long watched) except? -1

    @cython.locals(
        row="long long", drawn="long long", first="long long", tick="long long", changed="long long", last="long long",
        k="long long", line="long long"
    )
    cpdef long long tell(self, long long until, long long busy, long long event) except? -1

    cpdef long long row_of(self, long long line, long long row) except? -1

    cpdef int tell_row(self, long long row, long long event, long long cause) except -1

    @cython.locals(at="long long")
    cpdef tuple row(self, long long row)

    @cython.locals(k="long long")
    cpdef list values_from(self, long long first, long long count)

    cpdef int grow_rows(self) except -1

    cpdef int grow_values(self) except -1
