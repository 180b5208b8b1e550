# The C types of `resource_resolvers.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.solver.flaws.agenda cimport Agenda
from runtime.solver.flaws.decisions cimport Decisions
from runtime.solver.flaws.uses cimport Uses

cdef long long APPLIED, CONCURRENT_FIRST, CONCURRENT_ONLY, CONSTRAINT_FIRST, FAILED_CHOICE, NONE, NO_CHOICE
cdef long long PRECEDES_FIRST


@cython.locals(
    at="long long", by_default=bint, count="long long", first="long long", handler="long long", kinds="long long",
    pair="long long", rounds="long long", second="long long", step="long long", together=bint, turn="long long"
)
cpdef long long mend_resource(Agenda agenda, Decisions stack, long long d) except? -1


@cython.locals(
    at="long long", base="long long", count="long long", first="long long", is_here=bint, k="long long",
    lb="long long[::1]", second="long long", step="long long", ub="long long[::1]", uses=Uses
)
cpdef long long _mend_in_order_of_ids(Agenda agenda, Decisions stack, long long d) except? -1


@cython.locals(
    at="long long", engine=Engine, giver="long long", grounded="long long", is_left=bint, k="long long",
    last="long long", lower="long long", taker="long long", uses=Uses, v="long long"
)
cpdef bint _add_useful_pairs(Agenda agenda, Decisions stack, long long d) except -1
