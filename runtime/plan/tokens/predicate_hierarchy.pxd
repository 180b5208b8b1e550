# The C types of `predicate_hierarchy.py`.

from runtime.plan.store.plan cimport Plan

cdef long long HEAD_PREDICATE, LISTS, LIST_PREDICATE, NONE


cpdef bint is_kind_of(Plan plan, long long predicate, long long other) except -1


cpdef long long own_predicate(Plan plan, long long predicate, long long parent) except? -1


cpdef long long active_head(Plan plan, long long predicate) except? -1


cpdef long long first_active(Plan plan, long long predicate) except? -1


cpdef long long next_active(Plan plan, long long t, long long predicate) except? -1


cpdef long long _on_list(Plan plan, long long t, long long predicate) except? -1
