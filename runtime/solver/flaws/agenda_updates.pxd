# The C types of `agenda_updates.py`.

cimport cython
from runtime.constraints.domains.base_domain cimport is_base_single
from runtime.constraints.domains.narrow cimport is_single
from runtime.constraints.engine cimport Engine
from runtime.plan.store.rows cimport Rows
from runtime.solver.configuration.handler_table cimport HandlerTable
from runtime.solver.flaws.agenda cimport Agenda

cdef long long ACTIVE, BRANCH_WAITING, END, FLAG_EFFECT, FLAG_REJECTABLE, INACTIVE, _LAST_BIT, LISTS, LIST_ORDER, NONE, NO_KEY, _ONE
cdef long long OPEN_CONDITION, ROLE_GLOBAL, ROLE_INTERNAL, ROLE_LOCAL, ROLE_MEMBER, ROLE_TOKEN, START, THREAT
cdef long long TRAIL_CONSTRAINT, TRAIL_EDGE
cdef long long TRAIL_NARROWING, TRAIL_RESTRICTION, TRAIL_VARIABLE, UNBOUND_VARIABLE, UNDO_LINK
cdef long long UNDO_NEW_TOKEN, UNDO_STATUS


@cython.locals(
    after="long long", constant="signed char[::1]", count="long long", decided="signed char[::1]", each="long long",
    engine=Engine, exact=bint, first="long long", kinds="signed char[::1]", mask="long long", number="long long",
    owners="long long[::1]", role="long long", roles="long long[::1]", rows=Rows, s="long long", t="long long",
    v="long long",
)
cpdef int rebuild(Agenda agenda) except -1


cpdef int reopen(Agenda agenda) except -1


cpdef int _begin(Agenda agenda) except -1


@cython.locals(
    at="long long", code="long long", name="long long", slot="long long", t="long long"
)
cpdef int update(Agenda agenda, long long level) except -1


cpdef int note_levels(Agenda agenda, long long level) except -1

cpdef int _note_level(Agenda agenda, long long code, long long name, long long level) except -1


cpdef int _forget_slots(Agenda agenda, long long v) except -1


cpdef int _update_status(Agenda agenda, long long t) except -1


cpdef int _update_domain(Agenda agenda, long long v) except -1


cpdef long long _kind_of(Agenda agenda, long long t) except? -1


cpdef int _add_token(Agenda agenda, long long t, long long flaw) except -1


@cython.locals(is_ordered=bint)
cpdef int _add_threat(Agenda agenda, long long t) except -1


@cython.locals(kind="long long", mask="long long", manager="long long", number="long long", table=HandlerTable)
cpdef long long _unbound_mask(Agenda agenda, long long t) except? -1


cpdef int _add_variable(Agenda agenda, long long v) except -1
