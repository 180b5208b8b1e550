# The C types of `dead_end.py`.

cimport cython
from runtime.constraints.engine cimport Engine
from runtime.constraints.propagators.logic cimport may_be_equal
from runtime.plan.tokens.predicate_hierarchy cimport first_active, next_active
from runtime.solver.learning.conflict_analysis cimport ConflictAnalysis

cdef long long DURATION, END, EVERYTHING, FILTER_GUARD, FILTER_HORIZON, FILTER_HORIZON_VARIABLE, FILTER_PARENT_NOT_ASSIGNED
cdef long long FILTER_NOT_GUARD, FILTER_NOT_ASSIGNED, HANDLER_HSTS, INITIAL, LIMITS, LISTS, LIST_ORDER, MAXIMUM, MINIMUM, _MOST_SEEDS
cdef long long NOW, OBJECT, OPEN_CONDITION, POLICY_PARTIAL, PRECEDES_ONLY, RESOURCE_THREAT
cdef long long SIDE_LOWER, SIDE_UPPER, START, STATE, THREAT, UNBOUND_VARIABLE
cdef double FLOAT_TOLERANCE, inf


cpdef int explain_dead_end(ConflictAnalysis analysis, long long d) except -1

cpdef bint _explain_variable(ConflictAnalysis analysis, long long d, long long v) except -1

cpdef bint _explain_scope(ConflictAnalysis analysis, long long row, long long t) except -1

cpdef bint _may_leave(ConflictAnalysis analysis, long long t) except -1

cpdef int _explain_times(ConflictAnalysis analysis, long long t) except -1

cpdef int _explain_assigned(ConflictAnalysis analysis, long long t) except -1

cpdef int _explain_merging(ConflictAnalysis analysis, long long d, long long t) except -1

cpdef int _explain_difference(ConflictAnalysis analysis, long long mine, long long theirs, long long width) except -1

cpdef int _explain_insertions(ConflictAnalysis analysis, long long t) except -1

cpdef int _explain_insertion(ConflictAnalysis analysis, long long t, long long other, long long after) except -1

@cython.locals(engine=Engine, level=double, sign="long long", u="long long")
cpdef bint _explain_resource(ConflictAnalysis analysis, long long d, long long o) except -1

@cython.locals(engine=Engine, k="long long", v="long long")
cpdef bint _is_behind(ConflictAnalysis analysis, long long point, long long u, list givers, list owners) except -1

@cython.locals(u="long long", w="long long")
cpdef list _unordered(ConflictAnalysis analysis, list takers, long long first)
