# The C types of `block.py`.

cimport cython
from libc cimport math

cdef long long BLOCK
cdef double _NAN


cdef class RowBlock:
    cdef public double[::1] store, latest, texts, object_texts, cells, drawn
    cdef public long long[::1] starts, ends, standing, predicates, objects, values, row_of
    cdef public long long[::1] code, rows, shown, first, child_keys, token_rows, token_stands, argument
    cdef public long long[::1] least, most
    cdef public long long[::1] now_judged, now_open, fails, sides
    cdef public unsigned char[::1] begun, planned, tables, holds
    cdef public long long store_count, key_count, symbol_count, length, child_count, count, judged, open

    cpdef int put(self, long long at, long long row) except -1

    @cython.locals(least="long long", most="long long", i="long long", place="long long")
    cpdef int span(self, long long token, long long first, long long last) except -1

    @cython.locals(gap="double", margin="double")
    cpdef bint is_near(self, double x, double y) except -1

    @cython.locals(
        i="long long", one="long long", other="long long", lower="double", upper="double", least_a="double",
        most_a="double", least_b="double", most_b="double"
    )
    cpdef int relate(self, long long at, long long first, long long last) except -1

    @cython.locals(i="long long", place="long long", key="long long", row="long long", table="long long")
    cpdef int find_children(self, long long at, long long begin, long long first, long long last) except -1
