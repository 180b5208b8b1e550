# The C types of `queues.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows
from runtime.solver.flaws.custom cimport CustomManager
from runtime.constraints.stn.distances cimport Distances
from runtime.solver.flaws.filters cimport Filters
from runtime.constraints.stn.heap cimport Heap
from runtime.constraints.stn.reach cimport Reach
from runtime.solver.flaws.supports cimport Supports
from runtime.solver.configuration.handler_table cimport Treatments
from runtime.solver.flaws.uses cimport Uses
from runtime.solver.flaws.restarts cimport Weights

cdef long long DROPPED_TOKEN, DROPPED_VARIABLE, END, FLAG_GOAL, FREED, LATEST, LISTS, LIST_ORDER, NONE, NO_KEY, OBJECT, ROLE_TOKEN
cdef long long START, UNBOUND_VARIABLE, UNDO_BRANCH, UNDO_INPUTS, YOUNGEST


cdef class Queues:
    cdef public Plan plan
    cdef public Rows rows
    cdef public Engine engine
    cdef public Treatments treatments
    cdef public Filters filters
    cdef public Supports supports
    cdef public bint earliest, exact, has_custom, probing
    cdef public Distances distances
    cdef public Reach from_start, to_start, from_end, to_end
    cdef public Uses uses
    cdef public Heap takers
    cdef public Weights weights
    cdef public CustomManager custom
    cdef public long long found_at, found_low, managers, level, found_manager, found_kind, found_item, found_handler
    cdef public long long token_room, variable_room, edge_room, constraint_room, restriction_room, loose_count
    cdef public long long dropped_count, rows_seen, engine_seen, range_object, range_first, range_end
    cdef public list heaps, effects
    cdef public long long[::1] sorted_by_size, sequence, token_row, token_key, token_parked, token_waiting
    cdef public long long[::1] token_level, active_level, order_level, place_of, variable_row, variable_key, variable_parked
    cdef public long long[::1] variable_level, waits_for, waiting_next, waiting_before, edge_level, constraint_level
    cdef public long long[::1] restriction_level, loose_slot, loose_is_variable, dropped_slot, dropped_what
    cdef public long long[::1] fired_scope, fired_end, waiting_guards
    cdef public signed char[::1] stirs
    cdef public double found_priority

    cpdef int make_tables(self) except -1

    @cython.locals(room="long long")
    cpdef long long reserve(self) except? -1

    @cython.locals(at="long long", count="long long", waiting="long long")
    cpdef long long note_fired(self, long long level) except? -1

    @cython.locals(objects="long long", t="long long")
    cpdef bint is_decided(self, long long v) except -1

    @cython.locals(at="long long", last="long long")
    cpdef long long handler_now(self, long long row, long long t) except? -1

    @cython.locals(count="long long", t="long long")
    cpdef long long take_sequence(self, long long o) except? -1

    @cython.locals(v="long long")
    cpdef int look_around(self, long long t) except -1

    @cython.locals(heap=Heap)
    cpdef int clear(self) except -1

    @cython.locals(heap="long long", key="long long", queue=Heap)
    cpdef long long offer_token(self, long long slot) except? -1

    @cython.locals(start="long long")
    cpdef long long earliness(self, long long t) except? -1

    @cython.locals(queue=Heap, t="long long")
    cpdef long long offer_effect(self, long long slot) except? -1

    @cython.locals(heap="long long", key="long long", queue=Heap, v="long long")
    cpdef long long offer_variable(self, long long slot) except? -1

    cpdef long long rank(self, long long v) except? -1

    @cython.locals(heap="long long", slot="long long")
    cpdef long long resize(self, long long v) except? -1

    cpdef long long add_loose(self, long long slot, long long is_variable) except? -1

    cpdef long long drop(self, long long slot, long long what) except? -1

    cpdef long long park_token(self, long long slot) except? -1

    @cython.locals(first="long long", v="long long")
    cpdef long long park_variable(self, long long slot, long long t) except? -1

    cpdef int stir_times(self, long long t) except -1

    @cython.locals(after="long long", before="long long", t="long long")
    cpdef long long forget_waiting(self, long long v) except? -1

    @cython.locals(slot="long long")
    cpdef long long unpark_token(self, long long t) except? -1

    @cython.locals(slot="long long")
    cpdef long long unpark_variable(self, long long v) except? -1

    @cython.locals(at="long long", slot="long long", what="long long")
    cpdef long long go_back(
        self, long long dropped, long long loose, long long rows_seen, long long engine_seen
    ) except? -1
