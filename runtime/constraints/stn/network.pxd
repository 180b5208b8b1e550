# The C types of `network.py`.

cimport cython
from runtime.constraints.domains.store cimport Store

cdef long long CONFLICT_CYCLE, EVENT_LOWER, EVENT_UPPER, HALF_INF, MODE_DISTANCE, SIDE_LOWER, SIDE_UPPER, SUPPORT_EDGE
cdef long long TRAIL_EDGE, TRAIL_LINK, TRAIL_LOWER, TRAIL_UPPER, TRAIL_WEIGHT


cpdef long long _link_edge(
    Store s, long long source, long long target, long long weight, long long span, long long owner, long long link
) except? -1

@cython.locals(other="long long", source="long long", target="long long")
cpdef int attach_edge(Store s, long long e) except -1

@cython.locals(after="long long", before="long long")
cpdef int detach_edge(Store s, long long e) except -1

cpdef int free_edge(Store s, long long e) except -1

@cython.locals(c="long long")
cpdef bint is_followed(Store s, long long e, bint temporal_only) except -1

cpdef long long insert_edge(
    Store s, long long source, long long target, long long weight, long long span, long long owner, long long link
) except? -1

cpdef bint tighten_edge(Store s, long long e, long long weight) except -1

@cython.locals(u="long long", v="long long")
cpdef bint follow_edge(Store s, long long e) except -1

cpdef int _fail_cycle(Store s, long long v, long long side, long long e, long long new) except -1

@cython.locals(key="long long", v="long long")
cpdef bint propagate_edges(Store s, long long source, long long target, long long new) except -1

@cython.locals(count="long long", e="long long", u="long long")
cpdef bint _push_upper(Store s, long long v, long long source, long long new) except -1

@cython.locals(count="long long", e="long long", u="long long")
cpdef bint _push_lower(Store s, long long v, long long target, long long new) except -1

cpdef bint tie_edges(
    Store s, long long c, long long source, long long target, long long forth, long long back
) except -1

cpdef bint tie_edge(Store s, long long c, long long source, long long target, long long weight) except -1
