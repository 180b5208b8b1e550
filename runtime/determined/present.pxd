# The C types of `present.py`.

cimport cython

cdef long long NONE, FAR, PAIRS, PREDICATE, START, SLOT, LEAST, MOST, FOLLOWER, OWNER, ENDING, DUE, WISH, WISH_FROM
cdef long long WISH_UNTIL, WISH_END_FROM, WISH_END_UNTIL, WISH_LEAST, WISH_MOST, BEFORE, WISH_PREDICATE
cdef long long OWN_LEAST, OWN_MOST, SECTIONS


cdef class Present:
    cdef public long long lines, pairs, now, reach, changed, alone, steady, rest
    cdef public long long[::1] state, kept, flags, is_used

    @cython.locals(least="long long", most="long long", n="long long", slot="long long")
    cpdef int begin_wish(self, long long i) except -1

    cpdef long long coming(self, long long tick) except? -1

    @cython.locals(found="long long")
    cpdef long long next_event(self, long long tick) except? -1

    cpdef bint steps_alone(self, long long tick) except -1

    cpdef bint begin_tick(self, long long tick) except -1

    cpdef bint end_with(self, long long i) except -1

    cpdef bint is_kept(self, long long at) except -1

    @cython.locals(j="long long", left="long long")
    cpdef bint end_tick(self, long long tick) except -1

    @cython.locals(i="long long")
    cpdef bint becomes_steady(self, long long tick) except -1

    @cython.locals(i="long long")
    cpdef bint stays_steady(self, long long tick) except -1

    cpdef bint has_room(self, long long i, long long tick) except -1

    @cython.locals(moved="bint")
    cpdef bint order_ends(self, long long a, long long b) except -1

    cpdef int bound(self, long long i, long long duration, bint is_least, bint is_most) except -1

    cpdef int follow(self, long long i, long long owner, long long block) except -1

    cpdef int tie(self, long long a, long long b) except -1

    cpdef bint put_within(self, long long a, long long b) except -1

    cpdef int start(self, long long i, long long predicate) except -1
