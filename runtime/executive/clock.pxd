# The C types of `clock.py`.

cimport cython
from runtime.constraints.domains.sparse_set cimport SparseSet
from runtime.constraints.engine cimport Engine
from runtime.executive.view cimport PlanView
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows

cdef long long FIRST_PARAMETER, FREED, HOLDS_VARIABLES, INFINITY, LIST_OPEN, LIST_THREAT, LISTS
cdef long long OP_TEST_LEQ, OP_TEST_LT, OP_WATCH, ROLE_LOCAL, START
cdef double inf


@cython.locals(
    c="long long", clock="long long", engine=Engine, first="long long", found=double, k="long long",
    result="long long", slot="long long", tested=SparseSet,
)
cpdef double next_reading(PlanView bench, long long tick) except? -1.0

@cython.locals(
    earliest="long long[::1]", found="long long", is_placed=bint, last="long long", rows=Rows, start="long long",
    t="long long",
)
cpdef long long next_within(PlanView view, long long tick, long long reach, bint is_any) except? -1

@cython.locals(h="long long", plan=Plan, rows=Rows, s="long long", v="long long")
cdef bint _has_choice(PlanView view, long long t) except -1

cdef bint _is_choice(PlanView view, long long v) except -1
