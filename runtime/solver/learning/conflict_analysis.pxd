# The C types of `conflict_analysis.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.resources.resources cimport Resources
from runtime.solver.flaws.decisions cimport Decisions
from runtime.solver.flaws.agenda cimport Agenda
from runtime.solver.learning.support_walk cimport Walk

cdef long long END, LIST_ORDER, OBJECT, START
cdef long long ACTIVE, CONFLICT_DOMAIN, EVERYTHING, HEAD_OPEN, LISTS, LIST_OPEN, NONE, NOW, OPEN_CONDITION
cdef long long OP_EXTERNAL, RESOURCE_CONSUMES, RESOURCE_PRODUCES, SIDE_LOWER, SIDE_UPPER, UNBOUND_VARIABLE
cdef double FLOAT_TOLERANCE


cdef class ConflictAnalysis(Walk):
    @cython.locals(
        engine=Engine, first="long long", is_all=bint, k="long long", side="long long", support="long long", v="long long"
    )
    cpdef bint learn(self, long long d) except -1

    @cython.locals(k="long long", level="long long", reason="long long", stack=Decisions)
    cpdef long long keep(self, long long d) except? -1

    @cython.locals(heir="long long", latest="long long", reason="long long", stack=Decisions)
    cpdef long long target(self, long long d) except? -1

    @cython.locals(is_new=bint, item="long long", kind="long long", mine="long long", agenda=Agenda)
    cpdef bint may_bring(self, long long d, long long predicate) except -1

    @cython.locals(other="long long", agenda=Agenda, t="long long")
    cpdef long long blame_absence(self, long long d, long long predicate) except? -1

    @cython.locals(agenda=Agenda, t="long long")
    cpdef long long blame_use(self, long long u, long long d) except? -1

    @cython.locals(kind="long long", predicate="long long", agenda=Agenda, u="long long", uses=Resources)
    cpdef bint blame_helpers(self, long long o, long long sign, long long d) except -1

    @cython.locals(
        end="long long", needed="long long", start="long long", t="long long", var0="long long[::1]"
    )
    cpdef long long blame_window(self, excess) except? -1

    @cython.locals(first="long long", agenda=Agenda)
    cpdef long long blame_crowd(self, long long t) except? -1

    @cython.locals(
        e="long long", end="long long", key="long long", least=double, length="long long", loss=double,
        slack=double, start="long long", u="long long"
    )
    cpdef bint blame_excess(self, long long c, long long d) except -1
