# The C types of `resource_selection.py`.

cimport cython
from runtime.plan.resources.resources cimport Resources
from runtime.solver.flaws.agenda cimport Agenda
from runtime.solver.flaws.uses cimport Uses

cdef long long NONE, PREFER_EARLIEST, PREFER_LATEST, PREFER_LEAST, PREFER_LOWER, PREFER_MOST, PREFER_UPPER
cdef long long RESOURCE_THREAT
cdef double BEST_PRIORITY


@cython.locals(manager="long long")
cpdef bint is_resource_managed(Agenda agenda, long long o) except -1


@cython.locals(
    at="long long", amount="double", handler="long long", is_mine=bint, is_rival=bint, low="long long",
    o="long long", priority="double", row="long long", takes_first=bint, uses=Uses
)
cpdef long long select_resource(Agenda agenda, long long manager, bint is_last) except? -1


@cython.locals(t="long long", u="long long", uses=Resources)
cpdef bint _is_in_scope(Agenda agenda, long long row, long long o) except -1


@cython.locals(at="long long", code="long long", difference="double", amount="double", k="long long", low="long long")
cpdef bint _is_better(
    Agenda agenda, long long manager, long long other_at, long long other_low, double other_amount
) except -1
