# The C types of `retraction.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.constraints.relaxation.retract cimport edges_of
from runtime.plan.store.links cimport link_by_key, unlink
from runtime.plan.store.plan cimport Plan
from runtime.plan.store.rows cimport Rows
from runtime.plan.tokens.timelines cimport await_order, drop_pair, has_any_pair, leave_sequence

cdef long long ACTIVE, BRANCH_WAITING, FLAG_DECISION, FREED, HEAD_OPEN, HOLDS_CONSTRAINT, HOLDS_EDGE
cdef long long HOLDS_RESTRICTION, HOLDS_USE, HOLDS_VARIABLES, INACTIVE, LISTS, LIST_OPEN, LIST_ORDER
cdef long long LIST_PREDICATE, LIST_THREAT, MERGED, NONE, OP_WATCH, SCOPE_BODY, SCOPE_MERGE, SCOPE_PLACE
cdef long long STATE


cdef class _Sweep:
    cdef public list edges, constraints, restrictions, variables, undecided, scopes, tokens, reopened


@cython.locals(sweep=_Sweep)
cpdef bint cancel(Plan plan, long long t) except -1


@cython.locals(sweep=_Sweep)
cpdef bint remove_tokens(Plan plan, list tokens) except -1


@cython.locals(doomed=set, rows=Rows, sweep=_Sweep, t="long long")
cpdef bint retract_branch(Plan plan, long long s) except -1


@cython.locals(sweep=_Sweep)
cpdef bint reset(Plan plan, long long v) except -1


@cython.locals(after="long long", p="long long", rows=Rows, sweep=_Sweep)
cpdef bint free(Plan plan, long long first, long long second, long long span) except -1


@cython.locals(found=list, rows=Rows, s="long long")
cpdef list scopes_of(Plan plan, long long t)


@cython.locals(rows=Rows, status="long long", v="long long")
cpdef void _deactivate(Plan plan, long long t, _Sweep sweep) except *


@cython.locals(c="long long")
cpdef void wake_guards(Plan plan, long long v) except *


@cython.locals(child="long long", following="long long", last="long long", rows=Rows, s="long long")
cpdef void _drop_scopes(Plan plan, long long t, set doomed, _Sweep sweep) except *


@cython.locals(c="long long", h="long long", kind="long long", rows=Rows)
cpdef int _collect_holds(Plan plan, long long s, _Sweep sweep) except -1


cpdef list _decisions_of(Plan plan, long long v)


@cython.locals(
    done="long long", freed=list, gone=set, r="long long", restrictions=list, rows=Rows, s="long long", t="long long",
    v="long long",
)
cpdef bint _finish(Plan plan, _Sweep sweep) except -1


@cython.locals(
    c="long long", constraints=set, e="long long", edges=set, engine=Engine, owner="long long", owners=dict,
    r="long long", restrictions=set, rows=Rows, s="long long", slot="long long", t="long long", v="long long",
)
cpdef int _forget_foreign(Plan plan, list gone) except -1


@cython.locals(
    following="long long", h="long long", identity="long long", kind="long long", last="long long", rows=Rows,
    v="long long", watch="long long",
)
cpdef int _drop_held(Plan plan, long long s, set edges, set constraints, set restrictions) except -1
