# The C types of `watch_lists.py`.

cimport cython
from runtime.constraints.domains.store cimport Store


@cython.locals(v="long long")
cpdef int link_slot(Store s, long long slot) except -1

@cython.locals(after="long long")
cpdef int unlink_slot(Store s, long long slot) except -1

@cython.locals(after="long long")
cpdef int restore_slot(Store s, long long slot) except -1

@cython.locals(head="long long", slot="long long")
cpdef list watchers_of(Store s, long long v)

@cython.locals(before="long long")
cdef int _follow_up(Store s, long long slot, long long after) except -1
