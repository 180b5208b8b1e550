# The C types of `clock.py`.

cimport cython
from runtime.constraints.domains.sparse_set cimport SparseSet
from runtime.constraints.engine cimport Engine
from runtime.executive.view cimport PlanView

cdef long long OP_TEST_LEQ, OP_TEST_LT, OP_WATCH
cdef double inf


@cython.locals(
    c="long long", clock="long long", engine=Engine, first="long long", found=double, k="long long",
    result="long long", slot="long long", tested=SparseSet,
)
cpdef double next_reading(PlanView bench, long long tick) except? -1.0
