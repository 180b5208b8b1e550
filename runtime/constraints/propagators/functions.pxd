# The C types of `functions.py`.

cimport cython
from libc cimport math
from runtime.constraints.domains.bitset cimport has_value, next_value, previous_value
from runtime.constraints.domains.narrow cimport assign, high, is_single, low, raise_to, reduce_to
from runtime.constraints.domains.store cimport Store

cdef long long HALF_INF, KIND_FLOAT, OP_ABS, OP_BIND, OP_CEIL, OP_FLOOR, OP_MAX, OP_MIN, OP_MOD, OP_POW, OP_RAND
cdef long long OP_SAMPLE, OP_SQRT, OP_TOWARDS, OP_TRAVEL_TIME, SIDE_HOLES, SUPPORT_CONSTRAINT
cdef double FLOAT_TOLERANCE, ULP


@cython.locals(a="long long", first="long long", k="long long", op="long long", r="long long")
cpdef bint propagate_function(Store s, long long c) except -1

@cython.locals(a="long long", b="long long", corner="long long", hi=double, lo=double, r="long long")
cpdef bint _spread(Store s, long long op, long long first, long long count, double z, long long support) except -1

cpdef double middle(Store s, long long v) except? -1.0

cpdef double half_width(Store s, long long v) except? -1.0

cpdef double whole(Store s, long long v) except? -1.0

cpdef double rounded(double x) except? -1.0

cpdef bint _has_power(double x, double y) except -1

cpdef double _apply(long long op, double x, double y) except? -1.0

cpdef double sine(double degrees) except? -1.0

@cython.locals(wanted="long long")
cpdef bint _bind(Store s, long long v, double x, long long support) except -1

cpdef bint are_known(Store s, long long first, long long last) except -1

@cython.locals(ticks="long long")
cpdef bint _travel(Store s, long long first, long long support) except -1

@cython.locals(k="long long", v="long long")
cpdef bint _point_towards(Store s, long long first, long long support) except -1
