# The C types of `support_cycles.py`.

cimport cython
from runtime.constraints.explanation.reasons cimport collect_reasons
from runtime.constraints.domains.store cimport Store

cdef long long _DONE, _ON_PATH, SIDE_HOLES, SIDE_LOWER, SIDE_UPPER, SUPPORT_RESTRICTION


cpdef bint is_self_supporting(Store s, long long v, long long side) except -1

cdef int _push(Store s, long long depth, long long key) except -1

@cython.locals(entry="long long")
cdef long long _push_supports(Store s, long long depth, long long v, long long side) except? -1

cdef long long _push_reasons(Store s, long long depth, long long support, long long v, long long side) except? -1
