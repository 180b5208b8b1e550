# The C types of `explain.py`.

cimport cython
from runtime.constraints.domains.store cimport Store
from runtime.constraints.explanation.reasons cimport collect_all_reasons
from runtime.constraints.explanation.support_walk cimport SupportWalk

cdef long long CONFLICT_CYCLE, CONFLICT_DOMAIN, FLAG_VALUES, KIND_BOOL, KIND_FLOAT, OP_EXTERNAL, SIDE_HOLES
cdef long long SIDE_LOWER, SIDE_UPPER, SUPPORT_EDGE, SUPPORT_RESTRICTION


cpdef cause_of(Store s, long long support)


cdef class _CauseWalk(SupportWalk):
    cdef public dict found
    cdef public list links
    cdef public set committed

    cpdef bint visit(self, long long support, long long v, long long side, long long when) except -1

    cpdef int visit_support(self, long long support) except -1

    @cython.locals(r="long long")
    cpdef int visit_set(self, long long v) except -1

    @cython.locals(is_real=bint)
    cpdef double value(self, long long v, long long side) except? -1.0

    @cython.locals(e="long long")
    cpdef int ask_conflict(self) except -1

    cpdef int ask_cycle(self, long long now) except -1


cpdef list explain_conflict(Store s)

cpdef list explain_bound(Store s, long long v, long long side)
