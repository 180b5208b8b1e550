# The C types of `reasons.py`.

cimport cython
from runtime.constraints.domains.store cimport Store

cdef long long KIND_BOOL, KIND_FLOAT, MODE_DISTANCE, OWN_ALWAYS, OWN_AT_ONE, READS_ALL, READS_DISTANCE
cdef long long READS_SAME_SIDE, READS_SUM_LAST, SIDE_HOLES, SIDE_LOWER, SIDE_UPPER, SUPPORT_CONSTRAINT, SUPPORT_EDGE
cdef const short[:] READS, READS_OWN


@cython.locals(first="long long", k="long long", last="long long", reads="long long")
cpdef void collect_reasons(Store s, long long support, long long v, long long side) except *

cpdef void _add_reason(Store s, long long v, long long side) except *

@cython.locals(c="long long")
cpdef int _collect_weight(Store s, long long e) except -1

cpdef int _collect_sum(
    Store s, long long v, long long side, long long total, long long first, long long last
) except -1

@cython.locals(first="long long", k="long long", u="long long")
cpdef int _collect_all(Store s, long long c, long long v, long long side) except -1

cpdef bint _reads_itself(Store s, long long op, long long v, long long side) except -1

cpdef int collect_weight_reasons(Store s, long long e) except -1

cpdef int collect_all_reasons(Store s, long long c) except -1
