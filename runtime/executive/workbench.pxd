# The C types of `workbench.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.executive.timelines cimport TimelineState
from runtime.executive.view cimport PlanView
from runtime.plan.lifecycle cimport activate, fire, merge
from runtime.plan.store.marks cimport commit, mark, release, rewind
from runtime.plan.store.rows cimport Rows
from runtime.plan.tokens.archive cimport Leaving, archive, detach
from runtime.plan.tokens.retraction cimport cancel, remove_tokens, wake_guards
from runtime.plan.tokens.timelines cimport order
from runtime.plan.tokens.tokens cimport make_token

cdef long long ACTIVE, END, FIRST_PARAMETER, FLAG_DECISION, FLAG_FROZEN, FLAG_FACT, FLAG_GOAL, FLAG_REJECTABLE, INACTIVE, KIND_FLOAT, LISTS
cdef long long LIST_ORDER, MERGED, NONE, OBJECT
cdef double INFINITY, inf


cdef class Workbench(PlanView):
    cdef public tuple goals
    cdef public dict defaults, goal_numbers, lasting
    cdef public Leaving leaving

    cpdef long long mark(self) except? -1

    cpdef int rewind_to(self, long long mark) except -1

    cpdef int release(self, long long mark) except -1

    cpdef int commit(self) except -1

    cpdef bint is_consistent(self) except -1

    cpdef bint at_least(self, long long v, double bound, long long span, long long t) except -1

    cpdef bint at_most(self, long long v, double bound, long long span, long long t) except -1

    cpdef bint within(self, long long v, tuple bounds, long long span, long long t) except -1

    cpdef bint fix(self, long long v, double value, long long span, long long t) except -1

    cpdef bint is_kept(self, long long t) except -1

    @cython.locals(was_decided=bint)
    cpdef bint _narrow(self, long long v, double lower, double upper, long long span, long long t) except -1

    @cython.locals(found=dict)
    cpdef dict _parameter_numbers(self, long long predicate)

    @cython.locals(names=dict, v="long long")
    cpdef bint restrict_parameters(self, long long t, tuple arguments, long long span) except -1

    @cython.locals(lower=double, upper=double)
    cpdef bint _restrict(self, long long v, domain, long long span, long long t) except -1

    @cython.locals(engine=Engine, k="long long", v="long long")
    cpdef int make_values(self, long long t) except -1

    cpdef bint start_clock(self, long long final_tick) except -1

    cpdef bint set_clock(self, long long tick) except -1

    cpdef bint set_global(self, str name, double value) except -1

    @cython.locals(flags="long long")
    cpdef long long new_token(self, long long predicate, long long o, bint is_fact) except? -1

    cpdef long long new_goal(self, long long predicate, long long o) except? -1

    @cython.locals(given="long long")
    cpdef long long _make(self, long long predicate, long long o, long long flags, long long span) except? -1

    cpdef bint activate(self, long long t) except -1

    cpdef bint merge(self, long long t, long long other) except -1

    @cython.locals(following="long long")
    cpdef bint place_after(self, long long o, long long t, long long current) except -1

    cpdef bint _order(self, long long o, long long before, long long after) except -1

    cpdef bint cancel(self, long long t) except -1

    @cython.locals(engine=Engine, first="long long", made=list, r="long long", v="long long")
    cpdef bint _undecide(self, long long t) except -1

    @cython.locals(before="long long", holds=bint, o="long long")
    cpdef bint renew(self, long long t) except -1

    cpdef int note_kept(self, long long t) except -1

    @cython.locals(
        kept_key="long long[::1]", known="long long", latest="long long[::1]", line=TimelineState, over=list, rows=Rows,
        status="long long", staying=set, t="long long",
    )
    cpdef long long archive(self, list timelines, long long tick) except? -1

    @cython.locals(engine=Engine, lowest=list, needless=list, r="long long", span="long long", v="long long")
    cpdef int tidy(self) except -1

    cpdef int detach(self, long long t) except -1

    cpdef bint remove(self, list tokens) except -1

    @cython.locals(other="long long")
    cpdef long long fact_of(self, long long t) except? -1

    @cython.locals(fact="long long")
    cpdef bint end_observed(self, long long t, long long tick) except -1

    @cython.locals(before="long long", t="long long")
    cpdef bint stand_alone(self, long long fact, long long o) except -1
