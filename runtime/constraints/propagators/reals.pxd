# The C types of `reals.py`.

cimport cython
from libc cimport math
from runtime.constraints.domains.narrow cimport high, is_single, low, raise_to, reduce_to, remove_value
from runtime.constraints.domains.store cimport Store

cdef long long KIND_FLOAT, OP_ABS_VAL, OP_ADD_EQ, OP_CALC_DISTANCE, OP_DIFF_SQUARE, OP_DISTANCE_SQUARES, OP_DIV_EQ
cdef long long OP_EQ_MAXIMUM, OP_EQ_MINIMUM, OP_EQ_PRODUCT, OP_EQ_SUM, OP_MUL_EQ, OP_NEG, SIDE_HOLES
cdef long long SUPPORT_CONSTRAINT
cdef double FLOAT_TOLERANCE, _TINY, ULP, inf


@cython.locals(a="long long", b="long long", first="long long", op="long long")
cpdef bint propagate_reals(Store s, long long c) except -1

cpdef double lower_sum(double x, double y) except? -1.0

cpdef double upper_sum(double x, double y) except? -1.0

cpdef double product(double x, double y) except? -1.0

cpdef bint is_exact(double x) except -1

cpdef double down(double x) except? -1.0

cpdef double up(double x) except? -1.0

cpdef bint within(Store s, long long v, double lo, double hi, long long support) except -1

cpdef bint _add(Store s, long long a, long long b, long long r, long long support) except -1

cpdef bint _multiply(Store s, long long a, long long b, long long r, long long support) except -1

cpdef bint _is_known(Store s, long long v) except -1

cpdef bint _divide(Store s, long long r, double lo, double hi, long long a, long long support) except -1

cpdef bint _divide_by(Store s, long long a, long long b, long long q, long long support) except -1

@cython.locals(v="long long")
cpdef bint _add_all(Store s, long long first, long long count, long long support) except -1

@cython.locals(v="long long")
cpdef bint _multiply_all(Store s, long long first, long long count, long long support) except -1

cpdef double _top(Store s, long long v, double sign) except? -1.0

cpdef double _bottom(Store s, long long v, double sign) except? -1.0

cpdef bint _press(Store s, long long v, double hi, double sign, long long support) except -1

cpdef bint _lift(Store s, long long v, double lo, double sign, long long support) except -1

@cython.locals(able="long long", r="long long", v="long long")
cpdef bint hold_extreme(Store s, long long first, long long count, double sign, long long support) except -1

cpdef bint hold_absolute(Store s, long long r, long long x, long long support) except -1

cpdef bint _square_difference(Store s, long long a, long long b, long long r, long long support) except -1

cpdef bint _root_of_sum(Store s, long long a, long long b, long long r, long long support) except -1

cpdef double _gap(double least, double most) except? -1.0

@cython.locals(u="long long", v="long long", x="long long", y="long long")
cpdef bint _measure_distance(Store s, long long first, long long support) except -1
