# The C types of `plan_reactor.py`.

cimport cython
from runtime.executive.clock cimport next_reading, next_within
from runtime.executive.deferral cimport Deferral
from runtime.executive.dispatch cimport Dispatch
from runtime.executive.goals cimport Goals
from runtime.executive.holding cimport is_blocked
from runtime.executive.lasting cimport last_until
from runtime.executive.past cimport Past
from runtime.executive.planning cimport Planner
from runtime.executive.reactor cimport TeleoReactor
from runtime.executive.synchronise cimport synchronise
from runtime.executive.timelines cimport TimelineState
from runtime.executive.workbench cimport Workbench

cdef long long EPISODE_DONE, EPISODE_EXHAUSTED, EPISODE_MOVED, EPISODE_TOO_DEEP, NOTHING


cdef class PlanReactor(TeleoReactor):
    cdef public long long reach, final_tick, tick, relaxes, relaxed_at, steps_made
    cdef public long long work_since
    cdef public Workbench bench
    cdef public Planner planner
    cdef public Dispatch dispatch
    cdef public object trace, draws, max_steps, broken
    cdef public Goals goals
    cdef public Deferral deferral
    cdef public Past past
    cdef public list timelines
    cdef public dict by_name
    cdef public bint is_stirred, is_halted

    cpdef object start_tick(self, long long tick)

    cpdef object notify(self, observation)

    @cython.locals(
        bench=Workbench, first="long long", is_due=bint, is_metered=bint, line=TimelineState,
        soonest=double, token="long long",
    )
    cpdef long long next_tick(self, long long tick) except? -1

    @cython.locals(
        attempt="long long", causes=tuple, events=list, failures=list, line=TimelineState, lines=tuple, watched=tuple
    )
    cpdef object synchronise(self, long long tick)

    cpdef object _prepare(self, long long tick)

    @cython.locals(mark="long long")
    cpdef object _synchronise(self, long long tick)

    cpdef tuple hangs_on(self, conflict)

    cpdef object why_it_lasts(self, long long token, long long key, double least)

    cpdef object why_asked(self, long long number, name, long long side)

    @cython.locals(line=TimelineState, published=list)
    cpdef list observations(self, long long tick)

    cpdef object record(self)

    @cython.locals(deadline="long long")
    cpdef double urgency(self, long long tick) except? -1.0

    cpdef object _rest(self, long long tick)

    cpdef bint is_out_of_steps(self) except -1

    cpdef bint has_work(self, long long tick) except -1

    cpdef object halt(self)

    @cython.locals(outcome="long long")
    cpdef bint step(self, long long tick) except -1

    cpdef object failure(self)

    cpdef list refusals(self)

    cpdef bint _replan(self, long long tick) except -1

    cpdef list requests(self, long long tick)

    cpdef list recalls(self)

    cpdef tuple _causes_of(self, TimelineState line)
