# The C types of `loosening.py`.

cimport cython
from runtime.constraints.relaxation.support_cycles cimport holds_itself
from runtime.constraints.domains.store cimport Store

cdef long long HALF_INF, OP_TEMPORAL_DISTANCE, OP_WATCH, SIDE_HOLES, SIDE_LOWER, SIDE_UPPER, SUPPORT_CONSTRAINT
cdef long long SUPPORT_EDGE, SUPPORT_RESTRICTION


@cython.locals(bit="long long", new="long long")
cpdef void loosen(Store s, long long v, long long side) except *

@cython.locals(entry="long long", holder="long long", side="long long")
cpdef void loosen_by(Store s, long long v, long long support) except *

@cython.locals(support="long long", v="long long")
cpdef int loosen_by_edge(Store s, long long e) except -1

@cython.locals(slot="long long", support="long long")
cpdef int loosen_by_constraint(Store s, long long c) except -1

@cython.locals(c="long long", e="long long", i="long long", slot="long long", u="long long", v="long long")
cpdef int follow_cone(Store s) except -1

@cython.locals(d="long long")
cpdef int loosen_by_distance(Store s, long long c, long long v, long long side) except -1
