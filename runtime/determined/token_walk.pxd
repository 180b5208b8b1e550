# The C types of `token_walk.py`.

cimport cython
from runtime.determined.log cimport Log

cdef long long FAR, IS_FOLLOWING, IS_MERGED, IS_PREVIOUS, NONE, OF_FACT, OF_NOBODY, OF_OBSERVATION, OF_REQUEST, OF_RULE
cdef long long ROW, SHOWN, WISHED


cdef class TokenWalk:
    cdef public Log log
    cdef public long long count, merged_count, next_key
    cdef public long long[::1] first, how, line, predicate, context, indices, truths, is_fact, is_used
    cdef public long long[::1] keys, ends, origins, children, child_keys, child_rows, merged
    cdef public long long[::1] current, before, awaited, follower

    @cython.locals(room="long long", row="long long", block="long long", tick="long long", last="long long", k="long long")
    cpdef int run(self) except -1

    @cython.locals(at="long long", line="long long", block="long long", origin="long long", key="long long")
    cpdef int begin(self, long long row, long long tick) except -1

    @cython.locals(
        block="long long", shown="long long", first="long long", t="long long", c="long long", holds="bint",
        into="long long", line="long long"
    )
    cpdef int carry_out(self, long long row) except -1

    @cython.locals(at="long long")
    cpdef int merge(self, long long token, long long row) except -1
