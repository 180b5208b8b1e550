# The C types of `store.py`.

cimport cython
from runtime.constraints.domains.sparse_set cimport SparseSet

cdef long long CONFLICT_DOMAIN, EVENT_DECIDED, _FIRST_ROOM, PRIORITY_CHEAP, PRIORITY_WATCH, TRAIL_DECIDED
cdef long long TRAIL_LOWER, TRAIL_REAL_LOWER, TRAIL_REAL_UPPER, TRAIL_UPPER


cdef class Store:
    cdef public long long variables, reserved_next, reserved_end, bits_used
    cdef public long long table_used, hole_free, holes_used, trail_size
    cdef public long long trail_room, trail_most, trail_base, marks, slots_used
    cdef public long long edges_used, edge_free, constraints_used, constraint_free
    cdef public long long epoch, restrictions_used, restriction_free, seed
    cdef public long long reason_count, visits_begun, cone_count, edge_mask
    cdef public long long edge_first, edge_last, hull_mask, hull_first
    cdef public long long hull_last, cheap_mask, cheap_first, cheap_last
    cdef public long long dear_mask, dear_first, dear_last, woken_count
    cdef public long long running, conflict_kind, conflict_variable, conflict_side
    cdef public long long conflict_support, conflict_edge, updates, visits
    cdef public long long runs, real_bounds_used, entailed_count
    cdef public signed char[::1] kind, is_open, decided, constant
    cdef public signed char[::1] queued, slot_mask, mode, restriction_flags
    cdef public signed char[::1] relaxed, scheduled, priority, idempotent, entailed
    cdef public long long[::1] lb, ub, lower_when, upper_when
    cdef public long long[::1] bit_base, hole_when, trail_value
    cdef public long long[::1] trail_when, slot_key, edge_weight, drawn
    cdef public long long[::1] run_epoch, reasons, visit, cone
    cdef public long long[::1] support_stack, supported
    cdef public double[::1] flo, fhi, table_values, real_bounds
    cdef public double[::1] restriction_lo, restriction_hi
    cdef public int[::1] lower_support, upper_support, word, words_of
    cdef public int[::1] table, table_length, hole_head, restriction_head
    cdef public int[::1] watch_head, mute_head, out_head, in_head
    cdef public int[::1] block_first, block_size, block_left, block_next
    cdef public int[::1] block_free, word_free, table_free
    cdef public int[::1] hole_word, hole_support, hole_next, trail_key, trail_support
    cdef public int[::1] slot_variable, slot_constraint, slot_next, slot_prev
    cdef public int[::1] edge_source, edge_target, out_next, out_prev
    cdef public int[::1] in_next, in_prev, edge_span, edge_owner
    cdef public int[::1] edge_link, op, first, arity
    cdef public int[::1] span, owner, link_a, link_b
    cdef public int[::1] run_count, constraint_next, slot_free, restriction_variable
    cdef public int[::1] restriction_next, restriction_span, restriction_owner, edge_queue
    cdef public int[::1] hull_queue, cheap_queue, dear_queue, woken
    cdef public unsigned long long[::1] bits, hole_mask
    cdef public dict restriction_values, externals, object_parent
    cdef public bint holes, coarse, relational, consistent
    cdef public double tick_seconds, tick_epoch
    cdef public list suspects
    cdef public SparseSet doomed, gone

    @cython.locals(room="long long")
    cpdef int grow_variables(self) except -1

    cpdef int grow_constraints(self) except -1

    @cython.locals(room="long long")
    cpdef int grow_trail(self) except -1

    cpdef long long save_real(self, double x) except -1

    cpdef int save(self, long long name, long long code, long long value, long long support) except -1

    cpdef int write_lower(self, long long v, long long x, long long support) except -1

    cpdef int write_upper(self, long long v, long long x, long long support) except -1

    cpdef int write_real_lower(self, long long v, double x, long long support) except -1

    cpdef int write_real_upper(self, long long v, double x, long long support) except -1

    cpdef int note_conflict(self, long long kind, long long v, long long side, long long support) except -1

    cpdef bint fail(self, long long v, long long side, long long support) except -1

    @cython.locals(slot="long long")
    cpdef int wake(self, long long v, long long event) except -1

    cpdef int schedule(self, long long constraint) except -1

    cpdef int queue_edges(self, long long v, long long side) except -1

    cpdef int queue_hull(self, long long v) except -1

    cpdef int clear_woken(self) except -1

    cpdef int set_decided(self, long long v, long long flag) except -1
