# The C types of `entailment.py`.

cimport cython
from runtime.constraints.domains.store cimport Store
from runtime.constraints.stn.watch_lists cimport link_slot, restore_slot, unlink_slot

cdef long long MODE_DISTANCE, TRAIL_ENTAILED


@cython.locals(slot="long long")
cpdef int entail(Store s, long long c) except -1

@cython.locals(c="long long", slot="long long")
cpdef int entail_distance(Store s, long long distance) except -1

@cython.locals(slot="long long")
cpdef int undo_entailment(Store s, long long c) except -1

@cython.locals(slot="long long")
cpdef int revive(Store s, long long c) except -1
