# The C types of `resting.py`.

cimport cython
from runtime.constraints.domains.store cimport Store

cdef long long MODE_DISTANCE, TRAIL_REST


@cython.locals(after="long long", before="long long", slot="long long")
cpdef void rest(Store s, long long c) except *

@cython.locals(after="long long", before="long long", slot="long long")
cpdef int relink(Store s, long long c) except -1

@cython.locals(after="long long", slot="long long", v="long long")
cpdef int waken(Store s, long long c) except -1

@cython.locals(c="long long", slot="long long")
cpdef void rest_distance(Store s, long long distance) except *
