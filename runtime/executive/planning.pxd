# The C types of `planning.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.executive.planning_table cimport LeftOut
from runtime.executive.workbench cimport Workbench
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows
from runtime.solver.flaws.filters cimport PlanningScope
from runtime.solver.search cimport Solver

cdef double INFINITY, _EXPLAINING
cdef long long EXHAUSTED, FLAG_NATIVE, FLAG_REJECTABLE, HEAD_OPEN, INACTIVE, LISTS, LIST_OPEN, LIST_ORDER, LIST_THREAT, NONE, _DEEPEST, _MOST_CHANGES, _MOST_EXPLAINED
cdef long long _MOST_STEPS, _NEVER, _NO_LIMIT, PLAN, ROLE_LOCAL, ROLE_TOKEN, SPAN_CLOCK


cdef class _Window(PlanningScope):
    cdef public dict undrawn
    cdef public Workbench bench
    cdef public LeftOut left_out
    cdef public long long tick, end, final
    cdef public bint is_present, is_reactive
    cdef public set ignored, observed
    cdef public list left_open
    cdef public dict overtaken
    cdef public set behind

    cpdef bint admits_token(self, long long t) except -1

    @cython.locals(bench=Workbench, earliest=double, start="long long")
    cpdef bint _is_in_scope(self, long long t) except -1

    cpdef bint _waits_behind(self, long long t) except -1

    @cython.locals(before="long long", bench=Workbench, first="long long")
    cpdef double _is_free_at(self, long long t) except? -1

    @cython.locals(found=double, free=double, rows=Rows, t="long long")
    cpdef double next_freed(self, long long tick, long long reach) except? -1

    cpdef bint _waits_for_others(self, long long t) except -1

    @cython.locals(bench=Workbench, o="long long", start="long long")
    cpdef bint may_begin(self, long long t) except -1

    cpdef bint begins_in_time(self, long long t) except -1

    @cython.locals(bench=Workbench)
    cpdef bint may_overtake(self, long long t, long long other) except -1

    @cython.locals(bench=Workbench, found=bint, key=tuple, other="long long", t="long long")
    cpdef bint has_delayed(self) except -1

    @cython.locals(rows=Rows)
    cpdef bint _is_left_over(self, long long t) except -1

    @cython.locals(bench=Workbench, parent="long long")
    cpdef bint _is_of_before(self, long long t) except -1

    @cython.locals(plan=Plan, role="long long")
    cpdef bint admits_variable(self, long long v) except -1

    @cython.locals(c="long long", engine=Engine, other="long long")
    cpdef bint _is_free(self, long long v) except -1

    @cython.locals(found=bint, v="long long")
    cpdef bint is_any_bound(self) except -1


cdef class Planner:
    cdef public Workbench bench
    cdef public _Window window
    cdef public Solver solver
    cdef public object max_steps, max_depth, missed
    cdef public bint is_fresh, plans_ahead
    cdef public dict rejections
    cdef public long long deepest, kept_depth, resolved

    @cython.locals(is_deep=bint, outcome="long long")
    cpdef long long deliberate(self, long long tick, long long end) except? -1

    cpdef bint has_flaw(self, long long tick, long long end) except -1

    cpdef object _begin(self, long long tick, long long end)

    cpdef int pause(self) except -1

    cpdef int keep(self) except -1

    @cython.locals(depth="long long", is_deep=bint, made="long long", outcome="long long", solver=Solver, steps="long long")
    cpdef long long resolve_present(self, long long tick) except? -1

    cpdef object deadlock(self)

    @cython.locals(solver=Solver)
    cpdef object _logged(self)

    @cython.locals(bench=Workbench, mark="long long", t="long long")
    cpdef tuple reason(self)
