# The C types of `rule_interpreter.py`.

cimport cython
from runtime.plan.rules.guards cimport wait
from runtime.plan.store.scopes cimport between, constraint, copy_variable, equate, post_two, restrict
from runtime.plan.tokens.predicate_hierarchy cimport own_predicate
from runtime.plan.store.operands cimport operand
from runtime.plan.store.plan cimport Plan
from runtime.plan.tokens.relations cimport relate
from runtime.plan.tokens.tokens cimport make_token

cdef long long DO_ASSIGN, DO_BETWEEN, DO_CHILD, DO_FOREACH, DO_GUARD, DO_POST, DO_RELATE, DO_SAMPLE, DO_USE
cdef long long DO_VARIABLE, FLAG_CONDITION, FLAG_EFFECT, HOLDS_USE, IN_NONE, KIND_INT, NONE, OBJECT, OBJECT_GIVEN
cdef long long OBJECT_OWN, OP_FREEZE, OP_SAMPLE, ROLE_INTERNAL, ROLE_LOCAL, START, DURATION, END


cpdef bint run(Plan plan) except -1


cpdef long long _step(Plan plan, long long scope, long long at) except? -1


cpdef long long _variable(Plan plan, long long scope, long long at, long long span) except? -1


cpdef long long _post(Plan plan, long long scope, long long at, long long span) except? -1


cpdef long long _collect(Plan plan, long long scope, long long at, long long count, long long span) except? -1


cpdef long long _distance(Plan plan, long long scope, long long at, long long span) except? -1


cpdef long long _relation(Plan plan, long long scope, long long at, long long span) except? -1


cpdef long long _child(Plan plan, long long scope, long long at, long long span) except? -1


cpdef long long _assign(Plan plan, long long scope, long long at, long long span) except? -1


cpdef long long _sample(Plan plan, long long scope, long long at, long long span) except? -1


@cython.locals(held="long long")
cpdef long long _loop(Plan plan, long long scope, long long at, long long span) except? -1


cpdef long long _use(Plan plan, long long scope, long long at, long long span) except? -1


cpdef long long _guard(Plan plan, long long scope, long long at, long long span) except? -1
