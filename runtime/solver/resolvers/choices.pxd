# The C types of `choices.py`.

cimport cython
from runtime.constraints.domains.bitset cimport next_value, previous_value
from runtime.plan.lifecycle cimport fire
from runtime.plan.tokens.timelines cimport order
from runtime.solver.resolvers.conditions cimport mend_open_condition
from runtime.solver.flaws.decisions cimport Decisions
from runtime.solver.resolvers.resource_resolvers cimport mend_instant
from runtime.solver.resolvers.insertions cimport fill_places, is_open_place
from runtime.solver.flaws.agenda cimport Queues

cdef long long SPREAD
cdef long long APPLIED, CUSTOM, FAILED_CHOICE, HANDLER_HSTS_THREAT, HANDLER_LISTED, HANDLER_MAX, HANDLER_RANDOM
cdef long long KIND_FLOAT, NEVER, NONE, NO_CHOICE, OPEN_CONDITION, THREAT, UNBOUND_VARIABLE


@cython.locals(kind="long long")
cpdef long long mend(Queues q, Decisions stack, long long d) except? -1


@cython.locals(outcome="long long")
cpdef long long mend_custom(Queues q, Decisions stack, long long d) except? -1


@cython.locals(handler="long long", v="long long", x="long long")
cpdef long long mend_variable(Queues q, Decisions stack, long long d) except? -1


cpdef long long value_above(Queues q, long long v, long long x) except? -1


cpdef long long value_below(Queues q, long long v, long long x) except? -1


@cython.locals(count="long long", place="long long", step="long long", v="long long", x="long long")
cpdef long long random_value(Queues q, Decisions stack, long long d) except? -1


@cython.locals(rest="long long")
cpdef bint are_coprime(long long a, long long b) except -1


@cython.locals(v="long long", x="double")
cpdef long long mend_by_list(Queues q, Decisions stack, long long d) except? -1


@cython.locals(after="long long", at="long long", before="long long", place="long long", t="long long")
cpdef long long mend_threat(Queues q, Decisions stack, long long d) except? -1
