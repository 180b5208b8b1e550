# The C types of `choices.py`.

from runtime.constraints.domains.bitset cimport next_value, previous_value
from runtime.plan.lifecycle cimport fire
from runtime.plan.tokens.timelines cimport order
from runtime.solver.resolvers.conditions cimport mend_open_condition
from runtime.solver.flaws.decisions cimport Decisions
from runtime.solver.resolvers.resource_resolvers cimport mend_resource
from runtime.solver.resolvers.insertions cimport list_insertions, is_open_insertion
from runtime.solver.flaws.agenda cimport Agenda

cdef long long SPREAD
cdef long long APPLIED, FAILED_CHOICE, HANDLER_HSTS_THREAT, HANDLER_LISTED, HANDLER_MAX, HANDLER_RANDOM
cdef long long KIND_FLOAT, NEVER, NONE, NO_CHOICE, OPEN_CONDITION, THREAT, UNBOUND_VARIABLE


cpdef long long mend(Agenda agenda, Decisions stack, long long d) except? -1


cpdef long long _mend_variable(Agenda agenda, Decisions stack, long long d) except? -1


cpdef long long _value_above(Agenda agenda, long long v, long long x) except? -1


cpdef long long _value_below(Agenda agenda, long long v, long long x) except? -1


cpdef long long _random_value(Agenda agenda, Decisions stack, long long d) except? -1


cpdef long long _mend_by_list(Agenda agenda, Decisions stack, long long d) except? -1


cpdef long long _mend_threat(Agenda agenda, Decisions stack, long long d) except? -1
