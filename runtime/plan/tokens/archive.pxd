# The C types of `archive.py`.

cimport cython
from runtime.constraints.domains.sparse_set cimport SparseSet
from runtime.plan.store.plan cimport Plan
from runtime.plan.tokens.retraction cimport remove_tokens
from runtime.plan.tokens.ties cimport ties_what_goes_on

cdef long long ACTIVE, BRANCH_WAITING, END, FLAG_FROZEN, HOLDS_CONSTRAINT, HOLDS_EDGE, HOLDS_RESTRICTION, HOLDS_VARIABLES
cdef long long KIND_FLOAT, MERGED, NONE, ROLE_LOCAL, ROLE_TOKEN, SCOPE_GUARD, START, SUPPORT_CONSTRAINT, SUPPORT_EDGE
cdef long long SUPPORT_RESTRICTION


cdef class Leaving:
    cdef public SparseSet variables, supports, near, tokens
    cdef public signed char[::1] doomed


@cython.locals(going=list, t="long long")
cpdef long long archive(Plan plan, list tokens, long long tick, Leaving leaving, object record) except? -1


@cython.locals(
    child="long long", doomed="signed char[::1]", i="long long", is_tied=bint, known=SparseSet, t="long long"
)
cpdef list _removable(Plan plan, list tokens, long long tick, Leaving leaving)


@cython.locals(changed=bint, i="long long", t="long long")
cpdef void _keep_needed(Plan plan, SparseSet known, signed char[::1] doomed, long long tick) except *


@cython.locals(is_planned=bint)
cpdef bint _is_free(Plan plan, long long t, signed char[::1] doomed, long long tick) except -1


cpdef bint _has_begun(Plan plan, long long t, long long tick) except -1


@cython.locals(s="long long")
cpdef bint _has_waiting_guard(Plan plan, long long t) except -1


@cython.locals(child="long long")
cpdef bint _has_child_that_goes_on(Plan plan, long long t, long long tick) except -1


@cython.locals(child="long long")
cpdef void _orphan(Plan plan, long long t, signed char[::1] doomed) except *


cpdef void detach(Plan plan, long long t) except *


@cython.locals(
    c="long long", going=SparseSet, gone=SparseSet, i="long long", k="long long", near=SparseSet, v="long long"
)
cpdef list _freeze(Plan plan, list doomed, Leaving leaving)


@cython.locals(lower=double, r="long long", upper=double)
cpdef list _outdone(Plan plan, long long v)


@cython.locals(
    c="long long", e="long long", h="long long", i="long long", k="long long", kind="long long",
    s="long long", slot="long long", t="long long", v="long long",
)
cpdef void _gather(Plan plan, list doomed, SparseSet gone, SparseSet going) except *


@cython.locals(is_lower_going=bint, is_real=bint, is_upper_going=bint, lower="long long", upper="long long")
cpdef bint _keep_domain(Plan plan, long long v, SparseSet going) except -1


cpdef long long _span_of(Plan plan, long long support) except? -1
