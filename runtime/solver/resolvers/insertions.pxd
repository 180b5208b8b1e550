# The C types of `insertions.py`.

cimport cython
from runtime.constraints.domains.bitset cimport next_value
from runtime.constraints.engine cimport Engine
from runtime.plan.store.rows cimport Rows
from runtime.solver.flaws.decisions cimport Decisions
from runtime.solver.flaws.sequence cimport TimelineSequence
from runtime.solver.flaws.agenda cimport Agenda
from runtime.constraints.stn.reach cimport Reach

cdef long long DURATION, END, FLAG_GOAL, HALF_INF, LISTS, LIST_ORDER, NEVER, OBJECT, START


@cython.locals(engine=Engine, o="long long", v="long long")
cpdef long long list_insertions(Agenda agenda, Decisions stack, long long d, long long t) except? -1


@cython.locals(
    behind="long long",
    count="long long",
    first="long long",
    gap="long long",
    sequence=TimelineSequence,
    start="long long",
)
cpdef long long _list_insertions_on(Agenda agenda, Decisions stack, long long d, long long t, long long o) except? -1


cpdef bint _is_for_goal(Agenda agenda, long long t) except -1

@cython.locals(
    after="long long", at="long long", end="long long", engine=Engine, first="long long", mine="long long"
)
cpdef long long _list_behind_goals(Agenda agenda, Decisions stack, long long start, long long t) except? -1

@cython.locals(
    high="long long", low="long long", middle="long long", step="long long", t="long long", tokens="long long[::1]"
)
cpdef long long _first_apart(Agenda agenda, Reach reach, long long time, long long count, bint is_reversed) except? -1

cpdef long long _count_apart(Agenda agenda, Reach reach, long long time, long long count) except? -1

@cython.locals(
    count="long long", end="long long", first="long long", o="long long", sequence=TimelineSequence, theirs="long long"
)
cpdef bint may_coincide(Agenda agenda, long long candidate) except -1

@cython.locals(sequence=TimelineSequence)
cpdef bint is_out_of_range(Agenda agenda, long long candidate) except -1

@cython.locals(end="long long", engine=Engine, need="long long", previous="long long", rows=Rows, start="long long")
cpdef bint is_open_insertion(Agenda agenda, long long t, long long before, long long after) except -1
