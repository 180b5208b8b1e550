# The C types of `reasons.py`.

cimport cython
from runtime.constraints.domains.store cimport Store

cdef long long FAMILY_ARITHMETIC, FAMILY_COMPARISON, FAMILY_FUNCTION, KIND_BOOL, KIND_FLOAT, MODE_EDGES, OP_ABS_VAL
cdef long long OP_ADD_EQ, OP_BIND, OP_DIV_EQ, OP_EQ, OP_EQ_SUM, OP_LEQ, OP_LT, OP_MUL_EQ, OP_TEMPORAL_DISTANCE
cdef long long SIDE_HOLES, SIDE_LOWER, SIDE_UPPER, SUPPORT_CONSTRAINT, SUPPORT_EDGE


@cython.locals(c="long long", first="long long", k="long long", kind="long long", op="long long", other="long long")
cpdef void collect_reasons(Store s, long long support, long long v, long long side) except *

cpdef void add_reason(Store s, long long v, long long side) except *

cpdef int collect_edge(Store s, long long e, long long v, long long side) except -1

@cython.locals(c="long long")
cpdef int collect_weight(Store s, long long e) except -1

@cython.locals(is_term=bint, k="long long")
cpdef int collect_sum(
    Store s, long long v, long long side, long long total, long long first, long long last
) except -1

@cython.locals(first="long long", k="long long", u="long long")
cpdef int collect_all(Store s, long long c, long long v, long long side) except -1

@cython.locals(family="long long")
cpdef bint reads_itself(Store s, long long op, long long v, long long side) except -1

cpdef bint is_carried(Store s, long long c) except -1

cpdef int collect_weight_reasons(Store s, long long e) except -1

cpdef int collect_all_reasons(Store s, long long c) except -1
