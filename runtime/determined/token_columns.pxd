# The C types of `token_columns.py`.

cimport cython
from runtime.determined.token_walk cimport TokenWalk

cdef long long FAR, KIND, LINE, NONE, OF_RULE, ROW, VALUES, _ACTIVE, _MERGED, _INACTIVE
cdef double _INFINITE


cdef class WalkColumns:
    cdef public TokenWalk walk
    cdef public long long lines, count
    cdef public long long[::1] index_of, order, by_key, keys, least, most
    cdef public long long[::1] predicates, objects, starts, ends, merged_into, origins, ticks, values
    cdef public signed char[::1] states, is_over
    cdef public double[::1] latest

    @cython.locals(
        walk=TokenWalk, count="long long", entry="long long", k="long long", key="long long", line="long long",
        row="long long"
    )
    cpdef long long arrange(self) except -1

    @cython.locals(
        walk=TokenWalk, at="long long", begun="long long", end="long long", entry="long long", index="long long",
        row="long long"
    )
    cpdef int fill(self, long long tick) except -1

    cpdef int tell_bounds(self, long long index, long long line) except -1

    cpdef int tell_awaited(self, long long index, long long line, long long tick) except -1
