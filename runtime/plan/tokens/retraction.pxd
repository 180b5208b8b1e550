# The C types of `retraction.py`.

cimport cython
from runtime.constraints.domains.sparse_set cimport SparseSet
from runtime.plan.store.links cimport link_by_key, unlink
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport take_off
from runtime.plan.tokens.timelines cimport await_order, has_any_pair, leave_sequence

cdef long long ACTIVE, BRANCH_WAITING, FLAG_DECISION, FREED, HEAD_OPEN, HOLDS_CONSTRAINT, HOLDS_EDGE
cdef long long HOLDS_RESTRICTION, HOLDS_USE, HOLDS_VARIABLES, INACTIVE, LISTS, LIST_OPEN, LIST_ORDER
cdef long long LIST_PREDICATE, LIST_THREAT, MERGED, NONE, OP_WATCH, SCOPE_BODY, SCOPE_MERGE
cdef long long STATE, _LAST_KIND


cdef class _Sweep:
    cdef public list edges, constraints, restrictions, variables, undecided, scopes, tokens, reopened


cpdef bint cancel(Plan plan, long long t) except -1


cpdef bint remove_tokens(Plan plan, list tokens) except -1


@cython.locals(doomed=SparseSet)
cpdef bint retract_branch(Plan plan, long long s) except -1


cpdef bint reset(Plan plan, long long v) except -1


cpdef bint free(Plan plan, long long first, long long second, long long span) except -1


cpdef list _scopes_of(Plan plan, long long t)


cpdef void _deactivate(Plan plan, long long t, _Sweep sweep) except *


@cython.locals(c="long long")
cpdef void wake_guards(Plan plan, long long v) except *


@cython.locals(doomed=SparseSet)
cpdef int _doom_scopes(Plan plan, long long t, long long least, long long most) except -1


@cython.locals(creator="long long", doomed=SparseSet)
cpdef void _drop_scopes(Plan plan, long long t, _Sweep sweep) except *


cpdef int _collect_holds(Plan plan, long long s, _Sweep sweep) except -1


@cython.locals(
    done="long long", gone=SparseSet, limits=SparseSet, r="long long", s="long long", t="long long", v="long long"
)
cpdef bint _finish(Plan plan, _Sweep sweep) except -1


@cython.locals(
    c="long long", e="long long", k="long long", owner="long long", r="long long", s="long long", slot="long long",
    t="long long", v="long long",
)
cpdef int _forget_foreign(Plan plan, list gone) except -1


cpdef int _drop_held(Plan plan, long long s, set edges, set constraints, set restrictions) except -1
