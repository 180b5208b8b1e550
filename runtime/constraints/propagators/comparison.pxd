# The C types of `comparison.py`.

cimport cython
from libc cimport math
from runtime.constraints.domains.bitset cimport attach_words, clear_bits, has_value, next_index, value_at
from runtime.constraints.propagators.all_different cimport has_hall_violation
from runtime.constraints.domains.narrow cimport (
    high, is_single, low, raise_to, reduce_to, remove_value, round_bounds, set_lower, set_upper,
)
from runtime.constraints.stn.network cimport tie_edge, tie_edges, tighten_edge
from runtime.constraints.stn.entailment cimport entail
from runtime.constraints.domains.store cimport Store

cdef long long HALF_INF, KIND_FLOAT, KIND_INT, MODE_EDGES, MODE_REAL, MOST_VALUES, NEVER, OP_ALL_DIFF, OP_EQ, OP_LEQ, OP_LT
cdef long long OP_NEQ, OP_PLUS, OP_TEMPORAL_DISTANCE, OP_WITHIN_BOUNDS, SIDE_HOLES, SIDE_LOWER
cdef long long SUPPORT_CONSTRAINT
cdef double FLOAT_TOLERANCE, STRICT_STEP
cdef unsigned long long ALL_BITS, ONE_BIT


@cython.locals(a="long long", b="long long", first="long long", last="long long", op="long long")
cpdef bint propagate_comparison(Store s, long long c) except -1

@cython.locals(step="long long")
cpdef bint precede(Store s, long long a, long long b, bint strict, long long support) except -1

@cython.locals(_="long long")
cpdef bint equate(Store s, long long a, long long b, long long support) except -1

@cython.locals(_="long long", a="long long")
cpdef bint equate_all(Store s, long long first, long long count, long long support) except -1

cpdef unsigned long long _chunk(Store s, long long v, long long start) except? 0

@cython.locals(k="long long")
cpdef bint exclude_missing(Store s, long long a, long long b, long long support) except -1

cpdef bint differ(Store s, long long a, long long b, long long support) except -1

@cython.locals(a="long long", b="long long", following="long long", k="long long")
cpdef bint differ_all(Store s, long long first, long long count, long long support) except -1

@cython.locals(is_known=bint, is_telling=bint)
cpdef bint _keep_distance(
    Store s, long long c, long long start, long long distance, long long end, long long support
) except -1

@cython.locals(longest="long long", shortest="long long")
cpdef bint _follow_distance(
    Store s, long long c, long long start, long long distance, long long end, bint wholly
) except -1
