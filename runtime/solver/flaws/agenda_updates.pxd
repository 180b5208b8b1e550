# The C types of `agenda_updates.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.store.rows cimport Rows
from runtime.solver.flaws.agenda cimport Agenda

cdef long long ACTIVE, BRANCH_WAITING, END, FLAG_EFFECT, INACTIVE, LISTS, LIST_ORDER, NONE, NO_KEY, OPEN_CONDITION, ROLE_GLOBAL
cdef long long ROLE_INTERNAL, ROLE_LOCAL, ROLE_MEMBER, ROLE_TOKEN, START, THREAT, TRAIL_CONSTRAINT, TRAIL_EDGE
cdef long long TRAIL_NARROWING, TRAIL_RESTRICTION, TRAIL_VARIABLE, UNBOUND_VARIABLE, UNDO_LINK
cdef long long UNDO_NEW_TOKEN, UNDO_STATUS


cpdef long long rebuild(Agenda agenda) except? -1


@cython.locals(code="long long", name="long long")
cpdef long long update(Agenda agenda, long long level) except? -1


@cython.locals(code="long long", name="long long")
cpdef long long note_levels(Agenda agenda, long long level) except? -1


cpdef long long _forget_slots(Agenda agenda, long long v) except? -1


cpdef long long _update_status(Agenda agenda, long long t) except? -1


cpdef long long _update_domain(Agenda agenda, long long v) except? -1


cpdef long long _kind_of(Agenda agenda, long long t) except? -1


cpdef long long _add_open(Agenda agenda, long long t) except? -1


@cython.locals(is_ordered=bint)
cpdef long long _add_threat(Agenda agenda, long long t) except? -1


cpdef long long _add_variable(Agenda agenda, long long v) except? -1
