# The C types of `posting.py`.

cimport cython
from runtime.constraints.domains.store cimport Store
from runtime.constraints.stn.watch_lists cimport link_slot, unlink_slot

cdef long long KIND_BOOL, KIND_FLOAT, KIND_INT, MODE_DISTANCE, MODE_EDGES, MODE_REAL, MODE_WHOLE
cdef long long OP_ADD_EQ, OP_EXTERNAL, OP_PLUS, OP_RAND, OP_TEMPORAL_DISTANCE, TRAIL_CONSTRAINT
cdef const short[:] EDGES_UP_TO, IDEMPOTENT_UP_TO, POSTED_AS, PRIORITIES, TWINS, WAKES_BESIDE_EDGES, WAKES_FIRST
cdef const short[:] WAKES_OTHERS
cdef unsigned long long _MASK


cpdef long long _allocate_slots(Store s, long long count) except? -1

cpdef long long _new_constraint(Store s, long long op, long long arity, long long span, long long owner) except? -1

cpdef void _watch(Store s, long long c, long long position, long long v, long long mask) except *

@cython.locals(count="long long", first="long long", slot="long long")
cpdef int release_constraint(Store s, long long c) except -1

@cython.locals(position="long long")
cpdef long long post_constraint(Store s, long long op, list arguments, long long span, long long owner) except? -1

cpdef bint _repeats(Store s, long long c) except -1

@cython.locals(op="long long")
cpdef long long _events_of(Store s, long long c, long long position) except? -1

@cython.locals(edges=bint, op="long long", v="long long")
cpdef bint _choose_mode(Store s, long long c, list arguments) except -1

cpdef bint _is_offset(Store s, long long a, long long k, long long b) except -1

@cython.locals(x="unsigned long long")
cpdef long long _random_whole(long long seed, long long span, long long owner) except? -1
