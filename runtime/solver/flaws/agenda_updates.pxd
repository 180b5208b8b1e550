# The C types of `agenda_updates.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.store.rows cimport Rows
from runtime.solver.flaws.agenda cimport Agenda

cdef long long ACTIVE, BRANCH_WAITING, END, FLAG_EFFECT, INACTIVE, LISTS, LIST_ORDER, NONE, NO_KEY, OPEN_CONDITION, ROLE_GLOBAL
cdef long long ROLE_INTERNAL, ROLE_LOCAL, ROLE_MEMBER, ROLE_TOKEN, START, THREAT, TRAIL_CONSTRAINT, TRAIL_EDGE
cdef long long TRAIL_NARROWING, TRAIL_RESTRICTION, TRAIL_VARIABLE, UNBOUND_VARIABLE, UNDO_LINK
cdef long long UNDO_NEW_TOKEN, UNDO_STATUS


@cython.locals(t="long long", v="long long")
cpdef long long rebuild(Agenda agenda) except? -1


cpdef long long reopen(Agenda agenda) except? -1


cpdef long long _begin(Agenda agenda) except? -1


@cython.locals(
    at="long long", code="long long", engine=Engine, name="long long", rows=Rows, slot="long long", t="long long"
)
cpdef long long update(Agenda agenda, long long level) except? -1


@cython.locals(at="long long", code="long long", engine=Engine, name="long long")
cpdef long long note_levels(Agenda agenda, long long level) except? -1


@cython.locals(slot="long long")
cpdef long long _forget_slots(Agenda agenda, long long v) except? -1


@cython.locals(first="long long", v="long long")
cpdef long long _update_status(Agenda agenda, long long t) except? -1


@cython.locals(after="long long", number="long long", role="long long", t="long long", waiting="long long")
cpdef long long _update_domain(Agenda agenda, long long v) except? -1


@cython.locals(asker="long long", parent="long long", rows=Rows)
cpdef long long _kind_of(Agenda agenda, long long t) except? -1


@cython.locals(kind="long long", manager="long long", slot="long long")
cpdef long long _add_open(Agenda agenda, long long t) except? -1


@cython.locals(is_ordered=bint, kind="long long", manager="long long", slot="long long")
cpdef long long _add_threat(Agenda agenda, long long t) except? -1


@cython.locals(
    kind="long long", manager="long long", name="long long", owner="long long", role="long long", row="long long",
    slot="long long"
)
cpdef long long _add_variable(Agenda agenda, long long v) except? -1
