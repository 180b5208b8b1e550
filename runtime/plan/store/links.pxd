# The C types of `links.py`.

from runtime.plan.store.rows cimport Rows

cdef long long FREED, LISTS, NONE, SHORT, UNDO_BRANCH, UNDO_INPUTS, UNDO_LINK, UNDO_MERGED
cdef long long UNDO_NEW_CELLS, UNDO_NEW_HOLD, UNDO_NEW_PAIR, UNDO_NEW_SCOPE, UNDO_NEW_TOKEN, UNDO_STATUS, UNDO_UNLINK


cpdef int new_head(Rows rows, long long head) except -1


cpdef int link(Rows rows, long long t, long long kind, long long head, long long after) except -1


cpdef int link_by_key(Rows rows, long long t, long long kind, long long head) except -1


cpdef int unlink(Rows rows, long long t, long long kind) except -1


cpdef int _attach(Rows rows, long long t, long long kind, long long head, long long after) except -1


cpdef int _detach(Rows rows, long long t, long long kind) except -1


cpdef int undo(Rows rows, long long length) except -1


cpdef int _undo_token(Rows rows, long long t) except -1


cpdef int _undo_scope(Rows rows, long long s) except -1


cpdef int _undo_pair(Rows rows, long long p) except -1


cpdef int _undo_cells(Rows rows, long long start, long long size) except -1
