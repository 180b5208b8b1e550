# The C types of `search.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.lifecycle cimport fire
from runtime.plan.store.marks cimport commit, mark, release, rewind
from runtime.plan.store.plan cimport Plan
from runtime.solver.learning.conflict_analysis cimport Blame
from runtime.solver.resolvers.choices cimport mend
from runtime.solver.learning.disjunctive cimport Crowds
from runtime.solver.flaws.decisions cimport Decisions
from runtime.solver.flaws.filters cimport Filters
from runtime.solver.resolvers.resource_resolvers cimport is_mended
from runtime.solver.flaws.agenda cimport Queues
from runtime.solver.flaws.selection cimport select
from runtime.solver.learning.dead_end cimport complete
from runtime.solver.flaws.agenda_updates cimport catch_up, fill, note_levels

cdef long long APPLIED, EVERYTHING, EXHAUSTED, FAILED, MOVED, NO_CHOICE, NO_LIMIT, OPEN_CONDITION, PLAN, REJECTED
cdef long long RESOURCE_THREAT, TIMEOUT, UNBOUND_VARIABLE


cdef class Solver:
    cdef public object database, account, nogoods
    cdef public Plan plan
    cdef public Engine engine
    cdef public bint europa, has_active, is_exhausted, is_started, is_close, is_hopeless, may_restart
    cdef public Filters filters
    cdef public Queues queues
    cdef public Decisions stack
    cdef public Blame blame
    cdef public Crowds crowds
    cdef public long long steps, failures, steps_floor, depth_floor, max_steps, max_depth

    cpdef int set_horizon(self, long long lower, long long upper) except -1

    cpdef int set_scope(self, object scope) except -1

    cpdef int set_custom(self, object manager) except -1

    @cython.locals(o="long long")
    cpdef int refresh(self) except -1

    cpdef int keep(self) except -1

    cpdef int take_back(self) except -1

    @cython.locals(count="long long", outcome="long long")
    cpdef long long solve(self, long long max_steps, long long max_depth, object is_late=*) except? -1

    @cython.locals(d="long long", most="long long", outcome="long long", q=Queues, stack=Decisions)
    cpdef long long step(self) except? -1

    cpdef long long fail(self, long long d) except? -1

    @cython.locals(level="long long", stack=Decisions)
    cpdef bint is_known_in_vain(self, long long d) except -1

    @cython.locals(stack=Decisions)
    cpdef long long go_to(self, long long d) except? -1

    @cython.locals(heap="long long", q=Queues)
    cpdef bint is_reordered(self, long long d) except -1

    cpdef long long begin_anew(self) except? -1

    @cython.locals(o="long long")
    cpdef int look_closer(self) except -1

    @cython.locals(d="long long", q=Queues, stack=Decisions)
    cpdef long long enter(self) except? -1

    @cython.locals(stack=Decisions)
    cpdef long long leave(self, long long d) except? -1

    @cython.locals(stack=Decisions, target="long long")
    cpdef long long give_up(self, long long d, bint is_explained) except? -1


cpdef bint is_rejection(Queues q, Decisions stack, long long d) except -1
