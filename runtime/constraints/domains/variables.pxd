# The C types of `variables.py`.

cimport cython
from runtime.constraints.domains.bitset cimport (
    attach_table, attach_words, clear_bits, detach_words, drop_log, next_index, index_above, value_at,
)
from runtime.constraints.domains.narrow cimport is_near, raise_to, reduce_to, round_bounds
from runtime.constraints.domains.store cimport Store

cdef long long FLAG_VALUES, HALF_INF, INF, KIND_FLOAT, SIDE_HOLES, SUPPORT_RESTRICTION, TRAIL_OPEN
cdef long long TRAIL_RESTRICTION, TRAIL_VARIABLE, WIDEST_SET
cdef double FLOAT_TOLERANCE, inf
cdef unsigned long long ONE_BIT


cpdef long long take_row(Store s) except? -1

cpdef long long take_block(Store s, long long count) except? -1

cpdef int clear_row(Store s, long long v, long long kind) except -1

@cython.locals(count="long long", first="long long")
cpdef int drop_variable(Store s, long long v) except -1

cpdef long long add_restriction(
    Store s, long long v, double lo, double hi, long long flags, long long span, long long owner
) except? -1

@cython.locals(other="long long", v="long long")
cpdef int drop_restriction(Store s, long long r) except -1

cpdef void start_interval(Store s, long long v, double lo, double hi, long long r) except *

@cython.locals(k="long long", index="long long", value=double)
cpdef void start_values(Store s, long long v, list values, long long r) except *

cpdef long long constant_interval(Store s, long long kind, double lo, double hi) except? -1

cpdef long long constant_set(Store s, long long kind, list values) except? -1

cpdef bint keep_values(Store s, long long v, list values, long long support) except -1

cpdef bint _keep_reals(Store s, long long v, list values, long long support) except -1

@cython.locals(r="long long")
cpdef bint close_values(Store s, long long v) except -1

@cython.locals(r="long long")
cpdef bint is_untouched_set(Store s, long long v) except -1

@cython.locals(k="long long")
cpdef int copy_words(Store s, long long v, long long other) except -1
