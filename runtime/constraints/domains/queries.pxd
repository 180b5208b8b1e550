# The C types of `queries.py`.

from runtime.constraints.domains.base_domain cimport base_set, is_growing
from runtime.constraints.domains.bitset cimport count_values, has_value, next_index, index_above, index_below, value_at
from runtime.constraints.domains.narrow cimport is_near, is_single
from runtime.constraints.domains.store cimport Store

cdef long long HALF_INF, KIND_FLOAT
cdef double FLOAT_TOLERANCE


cpdef bint may_be(Store s, long long v, double x) except -1

cpdef bint has_finitely_many(Store s, long long v) except -1

cpdef long long number_of_values(Store s, long long v) except? -1

cpdef list listed(Store s, long long v)

cpdef list _listed_reals(Store s, long long v)
