# The C types of `logic.py`.

cimport cython
from runtime.constraints.domains.base_domain cimport is_base_single
from runtime.constraints.domains.bitset cimport has_value, next_value
from runtime.constraints.propagators.comparison cimport differ, differ_all, equate, equate_all, precede
from runtime.constraints.propagators.all_different cimport has_hall_violation
from runtime.constraints.domains.narrow cimport high, is_single, low, raise_to, reduce_to, remove_value
from runtime.constraints.domains.store cimport Store

cdef long long KIND_FLOAT, OP_COND_ALL_DIFF, OP_COND_EQ, OP_COUNT_NON_ZEROES, OP_COUNT_ZEROES, OP_OR, OP_TEST_AND
cdef long long OP_TEST_EQ, OP_TEST_LEQ, OP_TEST_LT, OP_TEST_NEQ, OP_TEST_OR, OP_TEST_SINGLETON
cdef long long OP_TEST_SPECIFIED, SIDE_HOLES, SUPPORT_CONSTRAINT, _UNKNOWN
cdef double FLOAT_TOLERANCE, STRICT_STEP


@cython.locals(a="long long", b="long long", count="long long", first="long long", op="long long", t="long long")
cpdef bint propagate_logic(Store s, long long c) except -1

cpdef long long _truth(Store s, long long v) except? -1

cpdef bint _be_true(Store s, long long v, long long support) except -1

cpdef bint _be_false(Store s, long long v, long long support) except -1

cpdef bint _is_specified(Store s, long long v) except -1

cpdef bint may_be_equal(Store s, long long a, long long b) except -1

cpdef bint _test_equal(Store s, long long t, long long a, long long b, bint equal, long long support) except -1

@cython.locals(step="long long")
cpdef bint _test_order(Store s, long long t, long long a, long long b, bint strict, long long support) except -1

cpdef bint _test_both(Store s, long long t, long long a, long long b, long long sway, long long support) except -1

cpdef bint _be(Store s, long long v, long long value, long long support) except -1

@cython.locals(last="long long")
cpdef bint _need_one(Store s, long long first, long long count, long long support) except -1

@cython.locals(n="long long", sure="long long", unsure="long long", v="long long")
cpdef bint _count_zeroes(Store s, long long first, long long count, bint zeroes, long long support) except -1

cpdef bint _run_condition(
    Store s, long long op, long long t, long long first, long long count, long long support
) except -1

@cython.locals(a="long long", undecided="long long", v="long long")
cpdef bint _test_all_equal(
    Store s, long long t, long long known, long long first, long long count, long long support
) except -1

@cython.locals(a="long long", b="long long", open_pairs="long long", x="long long", y="long long")
cpdef bint _test_all_different(
    Store s, long long t, long long known, long long first, long long count, long long support
) except -1
