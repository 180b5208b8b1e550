# The C types of `arithmetic.py`.

cimport cython
from runtime.constraints.domains.narrow cimport remove_value, set_lower, set_upper
from runtime.constraints.propagators.reals cimport propagate_reals
from runtime.constraints.domains.store cimport Store

cdef long long HALF_INF, INF, MODE_REAL, OP_ADD_EQ, OP_DIV_EQ, OP_EQ_MAXIMUM, OP_EQ_MINIMUM, OP_EQ_PRODUCT
cdef long long OP_EQ_SUM, OP_MUL_EQ, SUPPORT_CONSTRAINT


@cython.locals(a="long long", b="long long", first="long long", op="long long")
cpdef bint propagate_arithmetic(Store s, long long c) except -1

cpdef long long _clipped(long long x) except? -1

cpdef long long _floor_of(long long x, long long y) except? -1

cpdef long long _ceiling_of(long long x, long long y) except? -1

cpdef long long _product(long long x, long long y) except? -1

cpdef bint _add(Store s, long long a, long long b, long long r, long long support) except -1

cpdef bint _within(Store s, long long v, long long lo, long long hi, long long support) except -1

cpdef bint _multiply(Store s, long long a, long long b, long long r, long long support) except -1

cpdef bint _divide(Store s, long long r, long long b, long long a, long long support) except -1

cpdef bint _divide_apart(Store s, long long r, long long lo, long long hi, long long a, long long support) except -1

@cython.locals(open_above="long long", open_below="long long", r="long long", v="long long")
cpdef bint _add_all(Store s, long long first, long long count, long long support) except -1

@cython.locals(r="long long", v="long long")
cpdef bint _multiply_all(Store s, long long first, long long count, long long support) except -1

@cython.locals(able="long long", r="long long", v="long long")
cpdef bint _hold_extreme(Store s, long long first, long long count, bint is_most, long long support) except -1
