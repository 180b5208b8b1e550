# The C types of `circles.py`.

cimport cython
from runtime.constraints.explanation.reasons cimport collect_reasons
from runtime.constraints.domains.store cimport Store

cdef long long DONE, ON_PATH, SIDE_HOLES, SIDE_LOWER, SIDE_UPPER, SUPPORT_RESTRICTION


@cython.locals(colour="long long", depth="long long", key="long long", start="long long")
cpdef bint holds_itself(Store s, long long v, long long side) except -1

cpdef int push(Store s, long long depth, long long key) except -1

@cython.locals(entry="long long")
cpdef long long push_supports(Store s, long long depth, long long v, long long side) except? -1

@cython.locals(i="long long")
cpdef long long push_reasons(Store s, long long depth, long long support, long long v, long long side) except? -1
