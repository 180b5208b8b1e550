# The C types of `selection.py`.

cimport cython
from runtime.constraints.stn.heap cimport Heap
from runtime.solver.flaws.resource_selection cimport select_resource
from runtime.solver.flaws.agenda cimport Agenda

cdef long long ACTIVE, DROPPED_EFFECT, DROPPED_TOKEN, DROPPED_VARIABLE, INACTIVE, LISTS, LIST_ORDER, NONE
cdef long long OPEN_CONDITION, RESOURCE_THREAT, THREAT, UNBOUND_VARIABLE
cdef double BEST_PRIORITY, NO_PRIORITY


cpdef bint select(Agenda agenda) except -1


@cython.locals(heap=Heap, is_stale=bint, slot="long long", t="long long")
cpdef bint _select_effect(Agenda agenda, long long manager) except -1


cpdef int _select_from_heaps(Agenda agenda, long long manager) except -1


@cython.locals(heap=Heap, slot="long long", t="long long")
cpdef long long _first_token(Agenda agenda, long long number, long long kind) except? -1


@cython.locals(heap=Heap, row="long long", slot="long long", v="long long")
cpdef long long _first_variable(Agenda agenda, long long number) except? -1


cpdef bint _is_token_flaw(Agenda agenda, long long t, long long kind) except -1


cpdef bint _is_variable_flaw(Agenda agenda, long long v) except -1


@cython.locals(is_mine=bint)
cpdef int _select_dynamic(Agenda agenda, long long manager) except -1


cpdef long long _tie(Agenda agenda, long long item, long long kind, double priority) except? -1
