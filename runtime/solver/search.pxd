# The C types of `search.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.lifecycle cimport fire
from runtime.plan.store.marks cimport commit, mark, release, rewind
from runtime.plan.store.plan cimport Plan
from runtime.solver.learning.conflict_analysis cimport ConflictAnalysis
from runtime.solver.resolvers.choices cimport mend
from runtime.solver.learning.disjunctive cimport Disjunctive
from runtime.solver.flaws.decisions cimport Decisions
from runtime.solver.flaws.filters cimport Filters
from runtime.solver.flaws.resource_selection cimport is_resource_managed
from runtime.solver.flaws.agenda cimport Agenda
from runtime.solver.flaws.selection cimport select
from runtime.solver.learning.dead_end cimport explain_dead_end
from runtime.solver.flaws.agenda_updates cimport note_levels, rebuild, reopen, update

cdef long long ACTIVATE_ONLY, HANDLER_LISTED, KIND_FLOAT, MERGE_ONLY
cdef long long APPLIED, EVERYTHING, EXHAUSTED, FAILED, MOVED, NO_CHOICE, _NO_LIMIT, OPEN_CONDITION, PLAN
cdef long long TIMEOUT, UNBOUND_VARIABLE


cdef class Solver:
    cdef public object database, failure_log, nogoods, relief
    cdef public Plan plan
    cdef public Engine engine
    cdef public bint europa, has_active, is_exhausted, is_started, checks_overload, is_dead_end, is_partial, may_restart
    cdef public Filters filters
    cdef public Agenda agenda
    cdef public Decisions stack
    cdef public ConflictAnalysis analysis
    cdef public Disjunctive disjunctive
    cdef public long long steps, failures, steps_floor, depth_floor, max_steps, max_depth

    cpdef int set_scope(self, object scope) except -1

    cpdef int refresh(self) except -1

    cpdef int resume(self) except -1

    cpdef int keep(self) except -1

    cpdef int undo_all(self) except -1

    @cython.locals(count="long long")
    cpdef long long solve(self, long long max_steps, long long max_depth, object is_late=*) except? -1

    cpdef bint has_flaw(self) except -1

    cpdef bint _selects(self, long long d) except -1

    cpdef long long _step(self) except? -1

    cpdef long long step(self) except? -1

    cpdef bint _holds(self) except -1

    cpdef int fail(self, long long d) except -1

    @cython.locals(level="long long")
    cpdef bint _is_nogood(self, long long d) except -1

    cpdef int _retry(self, long long d) except -1

    cpdef bint _is_reordered(self, long long d) except -1

    cpdef int restart(self) except -1

    cpdef int check_overload(self) except -1

    cpdef bint _left_some(self, long long d, long long most) except -1

    cpdef int _undo(self, long long d) except -1

    cpdef int _backjump(self, long long d, bint is_explained) except -1
