# The C types of `all_different.py`.

cimport cython
from runtime.constraints.domains.bitset cimport count_values, has_value, next_value
from runtime.constraints.domains.narrow cimport high, low
from runtime.constraints.domains.store cimport Store

cdef long long HALF_INF, KIND_FLOAT
cdef double FLOAT_TOLERANCE


cpdef bint is_subset(Store s, long long a, long long b) except -1

@cython.locals(inside="long long", u="long long", v="long long")
cpdef bint has_hall_violation(Store s, long long first, long long count) except -1

@cython.locals(found="long long", v="long long")
cpdef bint _has_few_values(Store s, long long first, long long count) except -1
