# The C types of `cone.py`.

cimport cython
from runtime.constraints.domains.store cimport Store
from runtime.constraints.relaxation.support_cycles cimport is_self_supporting

cdef long long HALF_INF, OP_TEMPORAL_DISTANCE, OP_WATCH, SIDE_HOLES, SIDE_LOWER, SIDE_UPPER, SUPPORT_CONSTRAINT
cdef long long SUPPORT_EDGE, SUPPORT_RESTRICTION


@cython.locals(bound="long long")
cdef int _relax(Store s, long long v, long long side) except -1

@cython.locals(holder="long long")
cdef int _relax_bound(Store s, long long v, long long side, long long support) except -1

@cython.locals(entry="long long")
cpdef int relax_by(Store s, long long v, long long support) except -1

cpdef int relax_by_edge(Store s, long long e) except -1

@cython.locals(slot="long long")
cpdef int relax_by_constraint(Store s, long long c) except -1

@cython.locals(c="long long", e="long long", i="long long", is_upper=bint, slot="long long")
cpdef int close_cone(Store s) except -1

@cython.locals(d="long long")
cdef int _relax_by_distance(Store s, long long c, long long v, long long side) except -1
