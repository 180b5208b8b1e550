# The C types of `selection.py`.

cimport cython
from runtime.constraints.stn.heap cimport Heap
from runtime.solver.resolvers.resource_resolvers cimport select_instant
from runtime.solver.flaws.agenda cimport Queues

cdef long long ACTIVE, CUSTOM, DROPPED_EFFECT, DROPPED_TOKEN, DROPPED_VARIABLE, INACTIVE, LISTS, LIST_ORDER, NONE
cdef long long OPEN_CONDITION, RESOURCE_THREAT, THREAT, UNBOUND_VARIABLE
cdef double BEST_PRIORITY, NO_PRIORITY


@cython.locals(manager="long long")
cpdef bint select(Queues q) except -1


@cython.locals(flaw="long long")
cpdef long long select_custom(Queues q) except? -1


@cython.locals(heap=Heap, is_stale=bint, slot="long long", t="long long")
cpdef bint select_effect(Queues q, long long manager) except -1


cpdef long long take(Queues q, long long manager, long long item, long long handler, double priority) except? -1


@cython.locals(first="long long", heap="long long", priority="double", row="long long", slot="long long")
cpdef long long select_from_heaps(Queues q, long long manager) except? -1


@cython.locals(heap=Heap, slot="long long", t="long long")
cpdef long long first_token(Queues q, long long number, long long kind) except? -1


@cython.locals(heap=Heap, row="long long", slot="long long", v="long long")
cpdef long long first_variable(Queues q, long long number) except? -1


cpdef bint is_token_flaw(Queues q, long long t, long long kind) except -1


@cython.locals(t="long long")
cpdef bint is_variable_flaw(Queues q, long long v) except -1


@cython.locals(
    at="long long", best_tie="long long", handler="long long", is_mine=bint, item="long long", kind="long long",
    own="long long", priority="double", row="long long", slot="long long"
)
cpdef long long select_loose(Queues q, long long manager) except? -1


cpdef long long tie(Queues q, long long item, long long kind, double priority) except? -1
