# The C types of `operands.py`.

cimport cython
from runtime.plan.store.scopes cimport copy_variable
from runtime.plan.store.plan cimport Plan

cdef long long HOLDS_CONSTRAINT, HOLDS_VARIABLES, IN_CONSTANT, IN_FIELD, IN_GLOBAL, IN_LOCAL, IN_PROTOTYPE, IN_SELF
cdef long long IN_TOKEN, IN_UNION, KIND_FLOAT, KIND_INT, NONE, ROLE_INTERNAL, TOKEN_SHIFT


cpdef long long operand(Plan plan, long long scope, long long kind, long long value, long long span) except? -1


@cython.locals(o="long long")
cpdef long long _field(Plan plan, long long scope, long long number, long long span) except? -1


cpdef long long member(Plan plan, long long o, long long name) except? -1


@cython.locals(o="long long", prototype="long long", x=double)
cpdef long long _proxy(Plan plan, long long scope, long long index, long long name, long long span) except? -1


cpdef list _base_listed(Plan plan, long long v)


cpdef long long _unite(Plan plan, long long scope, long long number, long long span) except? -1
