# The C types of `base_domain.py`.

cimport cython
from runtime.constraints.domains.store cimport Store

cdef long long FLAG_DECISION, FLAG_VALUES, HALF_INF, KIND_FLOAT
cdef double FLOAT_TOLERANCE, inf


@cython.locals(r="long long")
cpdef double base_low(Store s, long long v) except? -1.0

@cython.locals(r="long long")
cpdef double base_high(Store s, long long v) except? -1.0

cpdef bint is_growing(Store s, long long v) except -1

cpdef bint is_base_growing(Store s, long long v) except -1

cpdef bint is_listing(Store s, long long r) except -1

@cython.locals(listed=list, r="long long", values=list)
cpdef list base_set(Store s, long long v)

@cython.locals(k="long long", x=double)
cpdef list in_order(list values)

@cython.locals(index="long long")
cpdef int insert_value(list values, double value) except -1

@cython.locals(has_values=bint, hi=double, lo=double, r="long long")
cpdef bint is_base_single(Store s, long long v) except -1
