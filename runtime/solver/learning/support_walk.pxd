# The C types of `support_walk.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.constraints.explanation.reasons cimport collect_reasons, collect_weight
from runtime.plan.rules.guards cimport deciders
from runtime.solver.flaws.decisions cimport Decisions
from runtime.constraints.stn.distances cimport Distances
from runtime.solver.flaws.agenda cimport Agenda

cdef long long AS_IT_IS, NOW, SIDE_HOLES, SIDE_LOWER, SIDE_UPPER, SUPPORT_CONSTRAINT, SUPPORT_EDGE


cdef class Walk:
    cdef public Agenda agenda
    cdef public Decisions stack
    cdef public Engine engine
    cdef public long long stamp, met_count, work_count, origin, opened
    cdef public bint is_local
    cdef public long long[::1] marked, met, seen, work_key, work_before

    cpdef long long begin(self) except? -1

    cpdef long long meet(self, long long level) except? -1

    cpdef long long ask(self, long long v, long long side, long long before) except? -1

    @cython.locals(at="long long", before="long long", engine=Engine, old="long long", when="long long")
    cpdef long long ask_enough(self, long long v, long long side, long long enough) except? -1

    @cython.locals(bound="long long", engine=Engine, when="long long")
    cpdef long long first(self, long long v, long long side) except? -1

    cpdef long long ask_domain(self, long long v) except? -1

    @cython.locals(
        at="long long", before="long long", engine=Engine, hole="long long", key="long long", side="long long",
        support="long long", v="long long", when="long long"
    )
    cpdef long long walk(self) except? -1

    @cython.locals(at="long long")
    cpdef long long expand(self, long long support, long long v, long long side, long long when) except? -1

    @cython.locals(k="long long")
    cpdef long long ask_reasons(self, long long support, long long v, long long side, long long when) except? -1

    @cython.locals(kind="long long")
    cpdef long long level_of(self, long long support) except? -1

    @cython.locals(distances=Distances, e="long long", v="long long")
    cpdef bint blame_edge(self, long long source, long long target, long long weight) except -1

    @cython.locals(c="long long", k="long long")
    cpdef long long ask_weight(self, long long e) except? -1

    @cython.locals(k="long long", agenda=Agenda, s="long long", t="long long")
    cpdef long long ask_guards(self, long long level) except? -1

    @cython.locals(engine=Engine, r="long long", v="long long")
    cpdef long long ask_arguments(self, long long c) except? -1
