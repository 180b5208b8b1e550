# The C types of `insertions.py`.

cimport cython
from runtime.constraints.domains.bitset cimport next_value
from runtime.solver.flaws.decisions cimport Decisions
from runtime.solver.flaws.agenda cimport Agenda
from runtime.constraints.stn.reach cimport Reach

cdef long long DURATION, END, FLAG_FACT, FLAG_GOAL, FLAG_SENT, HALF_INF, LISTS, LIST_ORDER, NEVER, OBJECT, START


cpdef int list_insertions(Agenda agenda, Decisions stack, long long d, long long t) except -1


cpdef int _list_insertions_on(Agenda agenda, Decisions stack, long long d, long long t, long long o) except -1


cpdef long long _origin(Agenda agenda, long long t) except -1

@cython.locals(before="long long", theirs="long long", begin=double, free=double, is_child=bint, is_first=bint, is_sent=bint)
cpdef int _list_behind_goals(Agenda agenda, Decisions stack, long long start, long long t) except -1

cpdef long long _first_apart(Agenda agenda, Reach reach, long long time, long long count, bint is_reversed) except? -1

cpdef long long _count_apart(Agenda agenda, Reach reach, long long time, long long count) except? -1

cpdef bint may_coincide(Agenda agenda, long long candidate) except -1

cpdef bint is_out_of_range(Agenda agenda, long long candidate) except -1

cpdef bint is_open_insertion(Agenda agenda, long long t, long long before, long long after) except -1
