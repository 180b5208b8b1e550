# The C types of `geodesy.py`.

cimport cython
from libc cimport math
from runtime.constraints.propagators.functions cimport are_known, half_width, middle, rounded, sine, whole
from runtime.constraints.domains.narrow cimport high, low, raise_to, reduce_to
from runtime.constraints.propagators.reals cimport down, hold_absolute, hold_extreme, up, within
from runtime.constraints.domains.store cimport Store

cdef long long KIND_FLOAT, OP_ABSF, OP_CEILF, OP_CIRCLE_MOD, OP_COSF, OP_DEG_TO_RAD, OP_EXPF, OP_FLOORF, OP_LL_DIST
cdef long long OP_LOGF, OP_MAXF, OP_MINF, OP_SIN, OP_SINF, OP_SQRTF, OP_TICK_DATE, OP_WGS_DISPLACE
cdef long long OP_WGS_DISPLACEMENT, SUPPORT_CONSTRAINT
cdef double _DEGREE, _DISTANCE_TOLERANCE, FLOAT_TOLERANCE, _LEAST_METRES_PER_DEGREE, _METRES_PER_DEGREE, _POSITION_TOLERANCE
cdef double _LEAST, _SLACK, STRICT_STEP, inf


@cython.locals(first="long long", op="long long", r="long long", x="long long")
cpdef bint propagate_geodesy(Store s, long long c) except -1

cpdef bint _turn(Store s, long long r, long long x, double ahead, long long support) except -1

cpdef bint _passes(double lo, double hi, double peak) except -1

cpdef double _angle_of(double x) except? -1.0

cpdef bint _hold_root(Store s, long long r, long long x, long long support) except -1

cpdef bint _be_whole(Store s, long long r, long long support) except -1

cpdef bint _hold_rounded(Store s, long long r, long long x, bint is_down, long long support) except -1

cpdef bint _hold_exponential(Store s, long long r, long long x, long long support) except -1

cpdef double _exponential(double x, double slack) except? -1.0

cpdef bint _scale(Store s, long long r, long long x, double factor, long long support) except -1

cpdef bint _bring_within_turn(Store s, long long r, long long x, long long support) except -1

@cython.locals(k="long long", tick="long long", v="long long")
cpdef bint _relate_date(Store s, long long first, long long support) except -1

@cython.locals(x=double)
cpdef bint _measure(Store s, long long first, long long support) except -1

cpdef double _blur(Store s, long long first, long long last) except? -1.0

@cython.locals(k="long long")
cpdef bint _displace(Store s, long long first, bint is_position, long long support) except -1
