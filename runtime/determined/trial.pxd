# The C types of `trial.py`.

cimport cython
from runtime.determined.present cimport Present
from runtime.determined.tables cimport CodeTables

cdef long long ENDING, FOLLOWER, LEAST, MOST, OWNER, PREDICATE, SLOT, WISH, WISH_FROM


@cython.locals(follower="long long", n="long long")
cpdef bint holds(Present present, CodeTables tables, long long i, long long predicate, bint is_trial) except -1

@cython.locals(
    at="long long", k="long long", least="long long", most="long long", n="long long", slot="long long"
)
cpdef bint fits_within(Present present, long long i) except -1

@cython.locals(i="long long", n="long long", owner="long long")
cpdef bint leaves_next(Present present) except -1

@cython.locals(i="long long", n="long long", owner="long long")
cpdef bint comes_between(Present present) except -1

@cython.locals(block="long long", i="long long", n="long long", slot="long long")
cpdef bint can_follow(Present present, CodeTables tables) except -1
