# The C types of `sets.py`.

cimport cython
from runtime.constraints.domains.bitset cimport clear_bits, count_values, has_value, next_index, next_value
from runtime.constraints.propagators.comparison cimport equate, exclude_missing
from runtime.constraints.propagators.all_different cimport is_subset
from runtime.constraints.propagators.logic cimport may_be_equal
from runtime.constraints.domains.narrow cimport high, is_single, low, raise_to, reduce_to, remove_value, round_bounds
from runtime.constraints.domains.narrow cimport set_lower, set_upper
from runtime.constraints.domains.store cimport Store

cdef long long HALF_INF, KIND_FLOAT, MOST_VALUES, NEVER, OP_COMMON_ANCESTOR, OP_ELEMENT
cdef long long OP_EQ_UNION, OP_FREEZE, OP_HAS_ANCESTOR, OP_LOCK, OP_MEMBER_IMPLY, OP_SUBSET_OF, SIDE_HOLES, SUPPORT_CONSTRAINT
cdef unsigned long long ONE_BIT
cdef double FLOAT_TOLERANCE, inf


@cython.locals(a="long long", b="long long", first="long long", op="long long")
cpdef bint propagate_sets(Store s, long long c) except -1

cpdef bint _keep_inside(Store s, long long a, long long b, long long support) except -1

@cython.locals(_="long long", a="long long")
cpdef bint _keep_union(Store s, long long first, long long count, long long support) except -1

cpdef bint _remove_outside(Store s, long long a, long long first, long long count, long long support) except -1

@cython.locals(able="long long", index="long long", result="long long", v="long long")
cpdef bint _look_up(Store s, long long first, long long count, long long support) except -1

cpdef bint _remove_between(Store s, long long index, long long below, long long above, long long support) except -1

cpdef long long _row_of(Store s, long long first, long long end, long long key) except? -1

@cython.locals(index="long long", result="long long")
cpdef bint _remove_unsupported(Store s, long long first, long long count, long long support) except -1

cpdef int _note_served(Store s, long long v, long long base, long long last) except -1

cpdef bint _serves(Store s, long long v, long long x) except -1

cpdef bint _is_listed(Store s, long long v) except -1

cpdef bint _has_ancestor_in(Store s, long long value, long long p) except -1

cpdef bint _is_inside(Store s, long long value, long long ancestor) except -1

cpdef bint _lie_inside(Store s, long long x, long long p, long long support) except -1

cpdef long long _next_object(Store s, long long v, long long value) except? -1

@cython.locals(_="long long")
cpdef bint _share_ancestor(Store s, long long a, long long b, long long p, long long support) except -1
