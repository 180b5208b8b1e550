# The C types of `scopes.py`.

cimport cython
from runtime.constraints.domains.base_domain cimport is_base_growing
from runtime.plan.store.plan cimport Plan

cdef long long FIRST_WRITTEN, HOLDS_CONSTRAINT, HOLDS_EDGE, HOLDS_RESTRICTION, HOLDS_VARIABLES, INFINITY
cdef long long KIND_FLOAT, NONE, OP_EQ


cpdef bint between(
    Plan plan, long long scope, long long a, long long b, long long lower, long long upper, long long span
) except -1


cpdef bint _edge(
    Plan plan, long long scope, long long source, long long target, long long weight, long long span
) except -1


cpdef long long constraint(
    Plan plan, long long scope, long long operation, long long first, long long span
) except? -1


cpdef long long new_inputs(Plan plan, long long condition, long long first, long long count) except? -1


cpdef long long post_two(
    Plan plan, long long scope, long long operation, long long a, long long b, long long span
) except? -1


cpdef long long equate(Plan plan, long long scope, long long a, long long b, long long span) except? -1


cpdef bint decide(Plan plan, long long scope, long long v, double value, long long span) except -1


cpdef bint restrict(Plan plan, long long scope, long long v, long long source, long long span) except -1


cpdef long long copy_variable(
    Plan plan, long long scope, long long prototype, long long role, long long name
) except? -1


cpdef long long make_variable(
    Plan plan, long long prototype, long long role, long long owner, long long name
) except? -1


cpdef long long make_closed(
    Plan plan, long long prototype, long long role, long long owner, long long name
) except? -1


@cython.locals(kind="long long")
cpdef long long _copy(Plan plan, long long prototype) except? -1


cpdef bint _is_gapless(long long kind, list values) except -1


@cython.locals(count="long long", twin="long long")
cpdef long long _closed_twin(Plan plan, long long prototype, list values) except? -1
