# The C types of `support_walk.py`.

cimport cython
from runtime.constraints.domains.store cimport Store
from runtime.constraints.explanation.reasons cimport collect_reasons, collect_weight_reasons

cdef long long SIDE_HOLES, SIDE_LOWER, SUPPORT_EDGE


cdef class SupportWalk:
    cdef public Store engine
    cdef public long long stamp, origin, asked_count, answered, support, when, overwritten
    cdef public bint notes_sets
    cdef public long long[::1] seen, asked_key, asked_before

    cpdef bint visit(self, long long support, long long v, long long side, long long when) except -1

    cpdef int visit_support(self, long long support) except -1

    cpdef int visit_set(self, long long v) except -1

    cpdef bint ask_more(self) except -1

    cpdef int start(self) except -1

    cpdef int ask(self, long long v, long long side, long long before) except -1

    cpdef int ask_reasons(self, long long support, long long v, long long side, long long before) except -1

    cpdef int ask_edge(self, long long e, long long before) except -1

    cpdef int ask_collected(self, long long before) except -1

    @cython.locals(support="long long")
    cpdef int look_up(self, long long v, long long side, long long before) except -1

    @cython.locals(at="long long", hole="long long", when="long long")
    cpdef int walk(self) except -1

    cpdef int follow(self, long long support, long long v, long long side, long long when, long long before) except -1
