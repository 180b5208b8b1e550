# The C types of `ties.py`.

cimport cython
from runtime.plan.store.plan cimport Plan

cdef long long DURATION, END, HOLDS_CONSTRAINT, HOLDS_EDGE, MERGED, NONE, ROLE_LOCAL, ROLE_TOKEN
cdef long long SCOPE_INSERTION, SCOPE_MERGE, START


cpdef bint ties_what_goes_on(Plan plan, long long t, long long tick) except -1


@cython.locals(
    at="long long", count="long long", h="long long", k="long long", kind="long long", only="long long",
    s="long long", v="long long",
)
cpdef bint _has_two_that_go_on(Plan plan, long long t, long long tick) except -1


@cython.locals(at="long long", first="long long", h="long long", k="long long", s="long long")
cpdef list _posted(Plan plan, long long t)


@cython.locals(k="long long", t="long long")
cpdef long long _standing_for(Plan plan, long long v) except? -1


cpdef bint _is_known(Plan plan, long long v) except -1


cpdef bint _goes_on(Plan plan, long long v, long long tick) except -1
