# The C types of `guards.py`.

cimport cython
from runtime.constraints.domains.base_domain cimport is_growing
from runtime.plan.store.scopes cimport constraint, new_inputs
from runtime.plan.store.operands cimport member
from runtime.plan.store.plan cimport Plan

cdef long long BRANCH_ELSE, BRANCH_THEN, BRANCH_WAITING, NONE, KIND_OBJECT, MERGED, OP_WATCH, ROLE_TOKEN, SCOPE_GUARD, STATE


cpdef int wait(
    Plan plan, long long scope, long long at, long long condition, long long first, long long span
) except -1


cpdef int _listen(Plan plan, long long v) except -1


cpdef long long _standing(Plan plan, long long v) except? -1


@cython.locals(c="long long")
cpdef void follow(Plan plan, long long scope, long long v, long long other, long long span) except *


@cython.locals(v="long long")
cpdef list deciders(Plan plan, long long c)


cpdef bint _is_bound(Plan plan, long long v) except -1


cpdef bint _agree(Plan plan, long long x, long long name) except -1


@cython.locals(holds=bint)
cpdef long long choice(Plan plan, long long s) except? -1
