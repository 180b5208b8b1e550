# The C types of `instants.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.resources.resources cimport Resources
from runtime.solver.flaws.decisions cimport Decisions
from runtime.solver.flaws.agenda cimport Queues
from runtime.solver.flaws.uses cimport Uses

cdef long long APPLIED, CONCURRENT_FIRST, CONCURRENT_ONLY, CONSTRAINT_FIRST, FAILED_CHOICE, NONE, NO_CHOICE
cdef long long PRECEDES_FIRST, PREFER_EARLIEST, PREFER_LATEST, PREFER_LEAST, PREFER_LOWER, PREFER_MOST, PREFER_UPPER
cdef long long RESOURCE_THREAT
cdef double BEST_PRIORITY


@cython.locals(manager="long long")
cpdef bint is_mended(Queues q, long long o) except -1


@cython.locals(
    at="long long", excess="double", handler="long long", is_mine=bint, is_rival=bint, low="long long",
    o="long long", priority="double", row="long long", takes_first=bint, uses=Uses
)
cpdef long long select_instant(Queues q, long long manager) except? -1


@cython.locals(u="long long", uses=Resources)
cpdef bint is_in_scope(Queues q, long long row, long long o) except -1


@cython.locals(at="long long", code="long long", difference="double", excess="double", k="long long", low="long long")
cpdef bint is_better(
    Queues q, long long manager, long long other_at, long long other_low, double other_excess
) except -1


@cython.locals(
    at="long long", by_default=bint, count="long long", first="long long", handler="long long", kinds="long long",
    pair="long long", rounds="long long", second="long long", step="long long", together=bint, turn="long long"
)
cpdef long long mend_instant(Queues q, Decisions stack, long long d) except? -1


@cython.locals(
    at="long long", base="long long", count="long long", first="long long", is_here=bint, k="long long",
    lb="long long[::1]", second="long long", step="long long", ub="long long[::1]", uses=Uses
)
cpdef long long mend_in_order_of_ids(Queues q, Decisions stack, long long d) except? -1


@cython.locals(
    at="long long", engine=Engine, giver="long long", grounded="long long", is_left=bint, k="long long",
    last="long long", lower="long long", taker="long long", uses=Uses, v="long long"
)
cpdef bint add_useful_pairs(Queues q, Decisions stack, long long d) except -1
