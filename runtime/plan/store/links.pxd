# The C types of `links.py`.

cimport cython
from runtime.plan.store.rows cimport Rows

cdef long long FREED, LISTS, NONE, SHORT, UNDO_BRANCH, UNDO_INPUTS, UNDO_LINK, UNDO_MERGED
cdef long long UNDO_NEW_CELLS, UNDO_NEW_HOLD, UNDO_NEW_PAIR, UNDO_NEW_SCOPE, UNDO_NEW_TOKEN, UNDO_STATUS, UNDO_UNLINK


@cython.locals(old="long long", position="long long")
cpdef int new_head(Rows rows, long long head) except -1


cpdef int link(Rows rows, long long t, long long kind, long long head, long long after) except -1


@cython.locals(after="long long")
cpdef int link_by_key(Rows rows, long long t, long long kind, long long head) except -1


@cython.locals(head="long long")
cpdef int unlink(Rows rows, long long t, long long kind) except -1


@cython.locals(at="long long", before="long long")
cpdef int attach(Rows rows, long long t, long long kind, long long head, long long after) except -1


@cython.locals(after="long long", at="long long", before="long long", head="long long")
cpdef int detach(Rows rows, long long t, long long kind) except -1


@cython.locals(at="long long", code="long long", index="long long", old="long long")
cpdef int undo(Rows rows, long long length) except -1


@cython.locals(parent="long long")
cpdef int undo_token(Rows rows, long long t) except -1


cpdef int undo_scope(Rows rows, long long s) except -1


cpdef int undo_pair(Rows rows, long long p) except -1


cpdef int undo_cells(Rows rows, long long start, long long size) except -1
