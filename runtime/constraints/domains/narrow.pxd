# The C types of `narrow.py`.

cimport cython
from libc cimport math
from runtime.constraints.domains.bitset cimport (
    attach_words, clear_bits, has_value, next_index, next_value, index_above, previous_index, previous_value,
    table_index,
)
from runtime.constraints.domains.store cimport Store

cdef long long EVENT_LOWER, EVENT_UPPER, HALF_INF, INF, KIND_FLOAT, KIND_INT, MOST_VALUES, SIDE_HOLES, SIDE_LOWER
cdef long long SIDE_UPPER
cdef double FLOAT_TOLERANCE, inf
cdef unsigned long long ONE_BIT


cpdef bint set_lower(Store s, long long v, long long x, long long support) except -1

cpdef bint set_upper(Store s, long long v, long long x, long long support) except -1

cpdef bint assign(Store s, long long v, long long x, long long support) except -1

cpdef bint remove_value(Store s, long long v, long long x, long long support) except -1

cpdef bint round_bounds(Store s, long long v, long long support) except -1

cpdef bint _set_real_lower(Store s, long long v, double x, long long support) except -1

cpdef bint _set_real_upper(Store s, long long v, double x, long long support) except -1

cpdef double low(Store s, long long v) except? -1.0

cpdef double high(Store s, long long v) except? -1.0

cpdef bint raise_to(Store s, long long v, double x, long long support) except -1

cpdef bint reduce_to(Store s, long long v, double x, long long support) except -1

cpdef bint is_single(Store s, long long v) except -1

@cython.locals(y=double)
cpdef bint is_near(double x, list values) except -1
