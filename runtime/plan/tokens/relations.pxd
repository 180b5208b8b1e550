# The C types of `relations.py`.

from runtime.plan.store.scopes cimport between
from runtime.plan.store.plan cimport Plan

cdef long long DURATION, DURATION_EQUAL, DURATION_ORIGIN_SHORTER, DURATION_TARGET_SHORTER, INFINITY, RELATION_CELLS


cpdef bint relate(
    Plan plan, long long scope, long long relation, long long origin, long long target, long long at, long long span
) except -1
