# The C types of `retract.py`.

cimport cython
from libc cimport math
from runtime.constraints.domains.base_domain cimport is_listing
from runtime.constraints.domains.bitset cimport detach_words, drop_log
from runtime.constraints.relaxation.cone cimport close_cone, relax_by, relax_by_constraint, relax_by_edge
from runtime.constraints.domains.narrow cimport raise_to, reduce_to
from runtime.constraints.stn.network cimport attach_edge, detach_edge, follow_edge, free_edge, propagate_edges
from runtime.constraints.propagators.posting cimport release_constraint
from runtime.constraints.domains.sparse_set cimport SparseSet
from runtime.constraints.domains.store cimport Store
from runtime.constraints.relaxation.trail cimport clear_queues, commit_trail
from runtime.constraints.domains.variables cimport drop_restriction, drop_variable, keep_values

cdef long long FLAG_DECISION, FLAG_VALUES, HALF_INF, INF, KIND_FLOAT, MODE_EDGES, NEVER, OP_TEMPORAL_DISTANCE, SIDE_LOWER
cdef long long SIDE_UPPER, SUPPORT_EDGE, SUPPORT_RESTRICTION, _WHOLE
cdef double FLOAT_TOLERANCE, inf


@cython.locals(
    c="long long", doomed=SparseSet, e="long long", gone=SparseSet, i="long long", is_decision="long long",
    r="long long", v="long long",
)
cpdef list retract(Store s, list constraints, list edges, list restrictions, list variables)

@cython.locals(e="long long", k="long long", slot="long long", v="long long")
cpdef int _gather(Store s, list variables, SparseSet doomed) except -1

@cython.locals(e="long long")
cpdef list edges_of(Store s, long long v)

@cython.locals(c="long long", slot="long long")
cpdef int _reset_cone(Store s) except -1

@cython.locals(r="long long")
cpdef int _reset_bound(Store s, long long v, long long side) except -1

cpdef int _set_base(Store s, long long v, long long side, double x, long long support) except -1

cpdef int _reset_set(Store s, long long v) except -1

@cython.locals(r="long long")
cpdef void _uncross(Store s, long long v, long long side) except *

@cython.locals(c="long long", head="long long", slot="long long")
cpdef int _renew_cone(Store s) except -1

cpdef int _restrict_to_sets(Store s, long long v) except -1

@cython.locals(e="long long")
cpdef int _pull_lower(Store s, long long v) except -1

@cython.locals(e="long long")
cpdef int _pull_upper(Store s, long long v) except -1

cpdef int _schedule_all(Store s) except -1

@cython.locals(e="long long")
cpdef bint follow_again(Store s, list edges) except -1

@cython.locals(r="long long")
cpdef bint _has_decision(Store s, long long v) except -1
