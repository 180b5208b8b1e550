# The C types of `present.py`.

cimport cython

cdef long long NONE, FAR, PAIRS, PREDICATE, START, SLOT, LEAST, MOST, FOLLOWER, OWNER, ENDING, DUE, WISH, WISH_FROM
cdef long long WISH_UNTIL, BEFORE, SECTIONS


cdef class Present:
    cdef public long long lines, before, pairs, now, reach, changed
    cdef public long long[::1] state, kept, flags, is_used

    @cython.locals(n="long long", k="long long", i="long long")
    cpdef int clear(self) except -1

    @cython.locals(n="long long", i="long long", found="long long", slot="long long", due="long long")
    cpdef long long next_event(self, long long tick) except? -1

    @cython.locals(n="long long", i="long long", most="long long")
    cpdef bint begin_tick(self, long long tick) except -1

    @cython.locals(
        n="long long", j="long long", k="long long", at="long long", grows="bint"
    )
    cpdef bint end_with(self, long long i) except -1

    @cython.locals(n="long long")
    cpdef bint is_news(self, long long i) except -1

    @cython.locals(n="long long", first="long long")
    cpdef bint is_kept(self, long long at) except -1

    @cython.locals(
        n="long long", i="long long", j="long long", k="long long", at="long long", slot="long long", pairs="long long",
        count="long long", left="long long", grows="bint"
    )
    cpdef bint end_tick(self, long long tick) except -1

    @cython.locals(n="long long", least="long long")
    cpdef bint has_room(self, long long i, long long tick) except -1

    @cython.locals(n="long long", first="long long", second="long long", moved="bint")
    cpdef bint order_ends(self, long long a, long long b) except -1

    @cython.locals(n="long long", i="long long", first="long long", second="long long")
    cpdef int tie(self, long long a, long long b) except -1

    @cython.locals(n="long long", at="long long", count="long long")
    cpdef bint put_within(self, long long a, long long b) except -1

    @cython.locals(n="long long")
    cpdef int start(self, long long i, long long predicate) except -1
