# The C types of `agenda.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows
from runtime.constraints.domains.base_domain cimport is_base_single
from runtime.constraints.domains.narrow cimport is_single
from runtime.constraints.domains.sparse_set cimport SparseSet
from runtime.constraints.stn.distances cimport Distances
from runtime.solver.flaws.filters cimport Filters
from runtime.constraints.stn.heap cimport Heap
from runtime.solver.flaws.sequence cimport TimelineSequence
from runtime.solver.flaws.supports cimport Supports
from runtime.solver.configuration.handler_table cimport HandlerTable
from runtime.solver.flaws.uses cimport Uses
from runtime.solver.flaws.restarts cimport Restarts

cdef long long DROPPED_TOKEN, DROPPED_VARIABLE, END, FLAG_GOAL, FREED, _LATEST, NONE, NO_KEY, OBJECT, ROLE_TOKEN
cdef long long START, UNBOUND_VARIABLE, UNDO_BRANCH, UNDO_INPUTS, _YOUNGEST


cdef class Agenda:
    cdef public Plan plan
    cdef public Rows rows
    cdef public Engine engine
    cdef public HandlerTable table
    cdef public Filters filters
    cdef public Supports supports
    cdef public object relief
    cdef public bint earliest, exact, probing
    cdef public Distances distances
    cdef public TimelineSequence sequence
    cdef public Uses uses
    cdef public Restarts restarts
    cdef public long long found_at, found_low, managers, level, found_manager, found_kind, found_item, found_handler
    cdef public long long dynamic_count, dropped_count, rows_seen, engine_seen
    cdef public long long tokens_used, variables_used, edges_used, constraints_used, restrictions_used
    cdef public list heaps, effects
    cdef public long long[::1] sorted_by_size, token_row, token_key, token_deferred, token_waiting
    cdef public long long[::1] token_level, active_level, order_level, variable_row, variable_key, variable_deferred
    cdef public long long[::1] variable_level, waits_for, waiting_next, waiting_before, edge_level, constraint_level
    cdef public long long[::1] restriction_level, dynamic_slot, dynamic_is_variable, dropped_slot, dropped_kind
    cdef public long long[::1] fired_scope, fired_end, unbound_masks, waiting_guards
    cdef public signed char[::1] watched
    cdef public SparseSet touched
    cdef public double found_priority

    @cython.locals(i="long long", slot="long long", slots="long long", used="long long", v="long long")
    cpdef int _empty_tables(self) except -1

    cpdef int _forget_levels(self) except -1

    cpdef int reserve(self) except -1

    cpdef int note_fired(self, long long level) except -1

    cpdef bint is_decided(self, long long v) except -1

    cpdef long long handler_now(self, long long row, long long t) except? -1

    cpdef int note_flaw(self, long long manager, long long item, long long handler, double priority) except -1

    @cython.locals(heap=Heap)
    cpdef int clear(self) except -1

    @cython.locals(target=Heap)
    cpdef int offer_token(self, long long slot) except -1

    cpdef long long earliness(self, long long t) except? -1

    @cython.locals(target=Heap)
    cpdef int offer_effect(self, long long slot) except -1

    @cython.locals(target=Heap)
    cpdef int offer_variable(self, long long slot) except -1

    cpdef long long rank(self, long long v) except? -1

    cpdef int resize(self, long long v) except -1

    cpdef int _add_dynamic(self, long long slot, long long is_variable) except -1

    cpdef int drop(self, long long slot, long long kind) except -1

    cpdef int defer_token(self, long long slot) except -1

    cpdef int defer_variable(self, long long slot, long long t) except -1

    cpdef int _watch_times(self, long long t) except -1

    cpdef int forget_waiting(self, long long v) except -1

    cpdef int resume_token(self, long long t) except -1

    cpdef int resume_variable(self, long long v) except -1

    cpdef int backtrack(
        self, long long dropped, long long dynamic, long long rows_seen, long long engine_seen
    ) except -1


cpdef int _fill(long long[::1] row, long long value, long long count) except -1
