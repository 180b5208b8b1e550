# The C types of `synchronise.py`.

cimport cython
from runtime.executive.dispatch cimport Dispatch
from runtime.executive.lasting cimport go_on, persist
from runtime.executive.planning cimport Planner
from runtime.executive.timelines cimport TimelineState
from runtime.executive.workbench cimport Workbench

cdef long long EPISODE_DONE, EPISODE_EXHAUSTED, EPISODE_TOO_DEEP, NOTHING, SPAN_CLOCK, SPAN_EXECUTIVE
cdef long long SPAN_OBSERVATION, _EXTEND, _FACT, _FREE_TRIES, _MEET, _MOST_TRIES, _NEW, _NEXT


@cython.locals(line=TimelineState, mark="long long")
cpdef object synchronise(
    Workbench bench, Planner planner, list timelines, long long tick, long long final_tick, Dispatch asked
)


cdef class _Search:
    cdef public Workbench bench
    cdef public Planner planner
    cdef public Dispatch asked
    cdef public list timelines, lines, made
    cdef public object first, relief
    cdef public dict tried
    cdef public long long tick, first_depth
    cdef public bint explains, is_last, is_out_of_budget

    @cython.locals(
        bench=Workbench, choice=tuple, depth="long long", marks=list, open_choices=list, tries="long long",
    )
    cpdef object _walk(self, long long max_tries, dict stuck)

    cpdef bint _back(self, list marks) except -1

    @cython.locals(
        bench=Workbench, current="long long", extend=list, forced=list, found=list, is_asked=bint, new=list,
        predicate="long long", starts=list, tick="long long", token="long long",
    )
    cpdef list choices(self, TimelineState line)

    @cython.locals(bench=Workbench, found=list, token="long long")
    cpdef list _observing(self, TimelineState line, long long predicate)

    cpdef bint _misfit(self, TimelineState line, tuple choice) except -1

    @cython.locals(start="long long")
    cpdef bint _may_start(self, long long token) except -1

    @cython.locals(bench=Workbench, fits=bint, mark="long long", predicate="long long", token="long long")
    cpdef long long fitting(self, TimelineState line, news) except? -1

    @cython.locals(
        bench=Workbench, holds=bint, kind="long long", predicate="long long", tick="long long", token="long long"
    )
    cpdef bint apply(self, TimelineState line, tuple choice) except -1

    @cython.locals(bench=Workbench, fact="long long", holds=bint, tick="long long")
    cpdef long long _observe(
        self, TimelineState line, news, long long kind, long long token, long long predicate
    ) except? -1

    @cython.locals(bench=Workbench, outcome="long long", tick="long long", token="long long")
    cpdef bint _finish(self) except -1

    cpdef int _postpone(self) except -1

    @cython.locals(
        bench=Workbench, found=dict, k="long long", line=TimelineState, other=TimelineState, token="long long"
    )
    cpdef list waiting(self)

    @cython.locals(k="long long", line=TimelineState)
    cpdef int _note(self) except -1

    @cython.locals(kind="long long", predicate="long long", token="long long")
    cpdef object _note_failure(self, TimelineState line, tuple choice)

    cpdef int _fail(self, str code, tuple timelines, what) except -1

    cpdef object explained(self, failure)
