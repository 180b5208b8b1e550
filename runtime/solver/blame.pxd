# The C types of `blame.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.constraints.reasons cimport collect_reasons, collect_weight
from runtime.plan.kinds cimport first_active, next_active
from runtime.plan.rows cimport Rows
from runtime.solver.decisions cimport Decisions
from runtime.solver.distances cimport Distances
from runtime.solver.queues cimport Queues

cdef long long CONFLICT_DOMAIN, DURATION, END, EVERYTHING, LISTS, LIST_ORDER, NONE, NOW, OBJECT, OPEN_CONDITION
cdef long long ROLE_TOKEN, SIDE_HOLES, SIDE_LOWER, SIDE_UPPER, START, STATE, SUPPORT_CONSTRAINT, SUPPORT_EDGE
cdef long long THREAT, UNBOUND_VARIABLE


cdef class Blame:
    cdef public Queues queues
    cdef public Decisions stack
    cdef public Engine engine
    cdef public long long stamp, met_count, work_count, origin
    cdef public long long[::1] marked, met, seen, work_key, work_before

    cpdef long long begin(self) except? -1

    cpdef long long meet(self, long long level) except? -1

    cpdef long long ask(self, long long v, long long side, long long before) except? -1

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

    @cython.locals(
        engine=Engine, first="long long", k="long long", side="long long", support="long long", v="long long"
    )
    cpdef long long learn(self, long long d) except? -1

    @cython.locals(k="long long", level="long long", reason="long long", stack=Decisions)
    cpdef long long keep(self, long long d) except? -1

    @cython.locals(heir="long long", latest="long long", reason="long long", stack=Decisions)
    cpdef long long target(self, long long d) except? -1

    @cython.locals(item="long long", kind="long long", q=Queues, stack=Decisions)
    cpdef long long complete(self, long long d) except? -1

    @cython.locals(candidate="long long", other="long long", predicate="long long", q=Queues, rows=Rows)
    cpdef long long blame_partners(self, long long d, long long t) except? -1

    @cython.locals(k="long long")
    cpdef long long blame_difference(self, long long mine, long long theirs, long long width) except? -1

    @cython.locals(distances=Distances, e="long long", v="long long")
    cpdef bint blame_edge(self, long long source, long long target, long long weight) except -1

    @cython.locals(c="long long", k="long long")
    cpdef long long ask_weight(self, long long e) except? -1

    @cython.locals(item="long long", kind="long long", q=Queues, t="long long")
    cpdef bint may_bring(self, long long d, long long predicate) except -1

    @cython.locals(after="long long", o="long long", other="long long", q=Queues, v="long long")
    cpdef long long blame_neighbours(self, long long t) except? -1

    @cython.locals(lb="long long[::1]", ub="long long[::1]", var0="long long[::1]")
    cpdef long long blame_times(self, long long t, long long other, long long after) except? -1
