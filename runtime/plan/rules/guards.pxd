# The C types of `guards.py`.

cimport cython
from runtime.constraints.domains.base_domain cimport is_growing
from runtime.constraints.engine cimport Engine
from runtime.plan.store.scopes cimport constraint
from runtime.plan.store.operands cimport member
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows

cdef long long BRANCH_ELSE, BRANCH_THEN, BRANCH_WAITING, NONE, KIND_OBJECT, MERGED, OP_WATCH, ROLE_TOKEN, SCOPE_GUARD, STATE


@cython.locals(
    count="long long", i="long long", inputs="long long", owner="long long", position="long long", rows=Rows,
    s="long long", watch="long long"
)
cpdef int wait(
    Plan plan, long long scope, long long at, long long condition, long long first, long long span
) except -1


@cython.locals(x="long long")
cpdef int listen(Plan plan, long long v) except -1


@cython.locals(t="long long")
cpdef long long standing(Plan plan, long long v) except? -1


@cython.locals(c="long long")
cpdef void follow(Plan plan, long long scope, long long v, long long other, long long span) except *


@cython.locals(found=list, v="long long")
cpdef list deciders(Plan plan, long long c)


@cython.locals(x="long long")
cpdef bint is_bound(Plan plan, long long v) except -1


@cython.locals(engine=Engine, first="long long", v="long long")
cpdef bint agree(Plan plan, long long x, long long name) except -1


@cython.locals(condition="long long", engine=Engine, holds=bint, i="long long", inputs="long long", rows=Rows)
cpdef long long choice(Plan plan, long long s) except? -1
