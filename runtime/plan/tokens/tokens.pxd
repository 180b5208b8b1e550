# The C types of `tokens.py`.

cimport cython
from runtime.plan.store.scopes cimport constraint, equate, make_closed, make_variable, restrict
from runtime.plan.tokens.predicate_hierarchy cimport active_head
from runtime.plan.store.links cimport link_by_key, unlink
from runtime.plan.store.operands cimport operand
from runtime.plan.store.plan cimport Plan

cdef long long ACTIVE, DURATION, END, FIRST_PARAMETER, FLAG_EVENT, FLAG_NATIVE, FLAG_REJECTABLE, HEAD_OPEN
cdef long long HEAD_THREAT, IN_NONE, LIST_OPEN, LIST_PREDICATE, LIST_THREAT, NONE, OBJECT, OP_TEMPORAL_DISTANCE
cdef long long RESOURCE_HOLDS, RESOURCE_PRODUCES, ROLE_TOKEN, SCOPE_BODY, SCOPE_RULE, START, STATE, SYMBOL_ACTIVE


@cython.locals(is_fixed=bint, holder="long long")
cpdef long long make_token(
    Plan plan, long long predicate, long long flags, long long parent, long long creator, long long given, long long span
) except? -1


@cython.locals(_="long long", made="long long", sign="long long")
cpdef bint activation(Plan plan, long long t, long long span) except -1
