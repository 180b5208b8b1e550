# The C types of `explain.py`.

cimport cython
from runtime.constraints.explanation.reasons cimport collect_all, collect_reasons, collect_weight
from runtime.constraints.domains.store cimport Store

cdef long long CONFLICT_CYCLE, CONFLICT_DOMAIN, FLAG_VALUES, KIND_BOOL, KIND_FLOAT, SIDE_HOLES, SIDE_LOWER
cdef long long SIDE_UPPER, SUPPORT_CONSTRAINT, SUPPORT_EDGE, SUPPORT_RESTRICTION, TRAIL_REAL_LOWER, TRAIL_REAL_UPPER


@cython.locals(name="long long")
cpdef cause_of(Store s, long long support)

@cython.locals(found=dict, now="long long", side="long long", support="long long", v="long long", waiting=list)
cpdef list explain_conflict(Store s)

@cython.locals(links=list)
cpdef list explain_bound(Store s, long long v, long long side)

cpdef add_cause(Store s, dict found, long long support)

cpdef list read_reasons(Store s, long long time)

@cython.locals(side="long long", u="long long", waiting=list)
cpdef list walk_cycle(Store s, dict found, long long now)

@cython.locals(code="long long", i="long long", support="long long", value=double, when="long long")
cpdef state_before(Store s, long long v, long long side, long long time)

@cython.locals(entry="long long", i="long long", r="long long", seen=set)
cpdef int walk_back(Store s, dict found, list waiting, list links) except -1

cpdef void step_back(Store s, dict found, list waiting, list links, change, long long support, double value) except *
