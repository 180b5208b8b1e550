# The C types of `conflict_analysis.py`.

cimport cython
from runtime.constraints.explanation.support_walk cimport SupportWalk
from runtime.plan.rules.guards cimport deciders
from runtime.solver.flaws.decisions cimport Decisions
from runtime.solver.flaws.agenda cimport Agenda

cdef long long END, LIST_ORDER, OBJECT, START
cdef long long ACTIVE, CONFLICT_DOMAIN, EVERYTHING, HEAD_OPEN, LISTS, LIST_OPEN, NONE, NOW, OPEN_CONDITION
cdef long long AS_IT_IS, OP_EXTERNAL, RESOURCE_CONSUMES, RESOURCE_PRODUCES, SIDE_HOLES, SIDE_LOWER, SIDE_UPPER
cdef long long SUPPORT_CONSTRAINT, SUPPORT_EDGE, UNBOUND_VARIABLE
cdef double FLOAT_TOLERANCE


cdef class ConflictAnalysis(SupportWalk):
    cdef public Agenda agenda
    cdef public Decisions stack
    cdef public long long met_count, opened
    cdef public bint is_local
    cdef public long long[::1] marked, met

    cpdef int begin(self) except -1

    cpdef int meet(self, long long level) except -1

    cpdef bint visit(self, long long support, long long v, long long side, long long when) except -1

    cpdef int visit_support(self, long long support) except -1

    cpdef bint ask_more(self) except -1

    cdef long long _level_of(self, long long support) except? -1

    cpdef int ask_enough(self, long long v, long long side, long long enough) except -1

    cpdef long long base_bound(self, long long v, long long side) except? -1

    cpdef int ask_domain(self, long long v) except -1

    cdef int _ask_guards(self, long long level) except -1

    @cython.locals(r="long long", v="long long")
    cdef int _ask_arguments(self, long long c) except -1

    cpdef bint explain_edge(self, long long source, long long target, long long weight) except -1

    @cython.locals(c="long long")
    cdef int _ask_path_edge(self, long long e) except -1

    @cython.locals(first="long long", k="long long")
    cpdef bint learn(self, long long d) except -1

    cpdef int keep(self, long long d) except -1

    cpdef long long target(self, long long d) except? -1

    @cython.locals(is_new=bint)
    cdef bint _may_bring(self, long long d, long long predicate) except -1

    cpdef int explain_absence(self, long long d, long long predicate) except -1

    cpdef int explain_use(self, long long u, long long d) except -1

    @cython.locals(predicate="long long")
    cpdef bint explain_helpers(self, long long o, long long sign, long long d) except -1

    @cython.locals(end="long long", needed="long long", start="long long", t="long long")
    cdef int _explain_window(self, violation) except -1

    cdef int _explain_ordering(self, long long t) except -1

    @cython.locals(
        e="long long", end="long long", key="long long", least=double, length="long long", loss=double, slack=double,
        start="long long", u="long long"
    )
    cdef bint _explain_violation(self, long long c, long long d) except -1
