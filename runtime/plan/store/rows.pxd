# The C types of `rows.py`.

cimport cython

cdef long long FREED, INACTIVE, NONE, SHORT, UNDO_BRANCH, UNDO_INPUTS, UNDO_MERGED, UNDO_NEW_CELLS
cdef long long UNDO_NEW_HOLD, UNDO_NEW_PAIR, UNDO_NEW_SCOPE, UNDO_NEW_TOKEN, UNDO_STATUS


cpdef int take_off(long long[::1] heads, long long[::1] following, long long owner, long long item) except -1


cdef class Rows:
    cdef public long long hold_count, free_hold, pair_count, free_pair
    cdef public long long cell_count, level, trail_length, token_count
    cdef public long long free_token, next_key, live, scope_count, free_scope
    cdef public long long[::1] hold_kind, hold_id, hold_next
    cdef public long long[::1] pair_edge, pair_first, pair_second, pair_next_out
    cdef public long long[::1] pair_next_in, cells, free_cells, head_first
    cdef public long long[::1] head_last, head_length, trail_code, trail_index
    cdef public long long[::1] trail_old, status, predicate, var0
    cdef public long long[::1] width, flags, parent, relation
    cdef public long long[::1] origin, label, key, span
    cdef public long long[::1] creator, scopes, children, sibling
    cdef public long long[::1] merged_into, merged, merged_next, pairs_out
    cdef public long long[::1] pairs_in, link_head, link_before, link_after
    cdef public long long[::1] scope_kind, scope_token, scope_rule, scope_parent
    cdef public long long[::1] scope_frame, scope_size, scope_slots, scope_holds
    cdef public long long[::1] scope_next, scope_at, scope_branch, scope_watch
    cdef public long long[::1] scope_inputs

    @cython.locals(at="long long")
    cpdef long long new_token(
        self, long long predicate, long long flags, long long parent, long long creator, long long span
    ) except? -1

    cpdef int release_token(self, long long t) except -1

    cpdef int detach(self, long long t) except -1

    cpdef int set_status(self, long long t, long long status) except -1

    cpdef int set_merged(self, long long t, long long other) except -1

    cpdef int unset_merged(self, long long t) except -1

    cpdef long long new_scope(
        self, long long kind, long long token, long long rule, long long parent, long long slots, long long size
    ) except? -1

    cpdef int release_scope(self, long long s) except -1

    cpdef int set_branch(self, long long s, long long branch) except -1

    cpdef int set_guard(self, long long s, long long at, long long inputs, long long watch) except -1

    cpdef int forget_watch(self, long long s) except -1

    cpdef int set_slot(self, long long s, long long slot, long long value) except -1

    cpdef int set_variables(self, long long t, long long first, long long width) except -1

    cpdef int set_asking(self, long long t, long long label, long long relation, long long origin) except -1

    cpdef int hold(self, long long s, long long kind, long long identity) except -1

    cpdef int drop_hold(self, long long s) except -1

    cpdef int take_hold(self, long long s, long long h) except -1

    cpdef int new_pair(self, long long first, long long second, long long edge) except -1

    cpdef int drop_pair(self, long long p) except -1

    cpdef long long new_cells(self, long long size) except? -1

    cpdef int _release_cells(self, long long start, long long size) except -1

    cpdef int log(self, long long code, long long index, long long old) except -1
