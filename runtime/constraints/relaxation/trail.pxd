# The C types of `trail.py`.

cimport cython
from runtime.constraints.domains.bitset cimport detach_words, restore_bits
from runtime.constraints.stn.network cimport detach_edge, free_edge
from runtime.constraints.propagators.posting cimport release_constraint
from runtime.constraints.stn.entailment cimport revive, undo_entailment
from runtime.constraints.domains.store cimport Store
from runtime.constraints.domains.variables cimport drop_restriction, drop_variable

cdef long long CONFLICT_NONE, TRAIL_CONSTRAINT, TRAIL_DECIDED, TRAIL_EDGE, TRAIL_HOLES, TRAIL_LINK, TRAIL_LOWER
cdef long long TRAIL_OPEN, TRAIL_REAL_LOWER, TRAIL_REAL_UPPER, TRAIL_RESTRICTION, TRAIL_UPPER, TRAIL_VARIABLE
cdef long long TRAIL_ENTAILED, TRAIL_WEIGHT, TRAIL_WORDS
cdef double inf


cpdef int clear_queues(Store s) except -1

@cython.locals(code="long long", key="long long", name="long long")
cpdef int undo_to(Store s, long long size) except -1

cpdef int commit_trail(Store s) except -1
