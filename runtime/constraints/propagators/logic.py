"""Propagate truth: comparisons as values, and, or, counting; a truth that is known enforces its condition."""

from runtime.constraints.domains.base_domain import is_base_single
from runtime.constraints.domains.bitset import has_value, next_value
from runtime.constraints.domains.narrow import high, is_single, low, raise_to, reduce_to, remove_value
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import FLOAT_TOLERANCE, KIND_FLOAT, SIDE_HOLES, STRICT_STEP, SUPPORT_CONSTRAINT
from runtime.constraints.propagators.all_different import has_hall_violation
from runtime.constraints.propagators.comparison import differ, differ_all, equate, equate_all, precede
from runtime.constraints.propagators.opcodes import (
    OP_COND_ALL_DIFF,
    OP_COND_EQ,
    OP_COUNT_NON_ZEROES,
    OP_COUNT_ZEROES,
    OP_OR,
    OP_TEST_AND,
    OP_TEST_EQ,
    OP_TEST_LEQ,
    OP_TEST_LT,
    OP_TEST_NEQ,
    OP_TEST_OR,
    OP_TEST_SINGLETON,
    OP_TEST_SPECIFIED,
)

_UNKNOWN = -1


def propagate_logic(s: Store, c: int) -> bool:
    """Run a constraint of this family."""
    op = s.op[c]
    first = s.first[c]
    count = s.arity[c]
    t = s.slot_variable[first]
    support = c * 4 + SUPPORT_CONSTRAINT
    if op == OP_OR:
        return _need_one(s, first, count, support)
    if op == OP_COUNT_ZEROES or op == OP_COUNT_NON_ZEROES:
        return _count_zeroes(s, first, count, op == OP_COUNT_ZEROES, support)
    a = s.slot_variable[first + 1]
    if op == OP_TEST_SINGLETON:
        return not is_single(s, a) or _be_true(s, t, support)
    if op == OP_TEST_SPECIFIED:
        return not _is_specified(s, a) or _be_true(s, t, support)
    if op == OP_COND_EQ or op == OP_COND_ALL_DIFF:
        return _run_condition(s, op, t, first + 1, count - 1, support)
    b = s.slot_variable[first + 2]
    if op == OP_TEST_EQ:
        return _test_equal(s, t, a, b, True, support)
    if op == OP_TEST_NEQ:
        return _test_equal(s, t, a, b, False, support)
    if op == OP_TEST_LEQ:
        return _test_order(s, t, a, b, False, support)
    if op == OP_TEST_LT:
        return _test_order(s, t, a, b, True, support)
    assert op == OP_TEST_AND or op == OP_TEST_OR
    return _test_both(s, t, a, b, 0 if op == OP_TEST_AND else 1, support)


def _truth(s: Store, v: int) -> int:
    """Give 1 for true (not zero), 0 for false (zero), -1 while both are possible."""
    if low(s, v) > 0.0 or high(s, v) < 0.0:
        return 1
    if low(s, v) == 0.0 and high(s, v) == 0.0:
        return 0
    if s.kind[v] != KIND_FLOAT and s.word[v] >= 0 and not has_value(s, v, 0):
        return 1
    return _UNKNOWN


def _be_true(s: Store, v: int, support: int) -> bool:
    """Take 0 from a variable."""
    if s.kind[v] != KIND_FLOAT:
        return remove_value(s, v, 0, support)
    if s.flo[v] == 0.0 and s.fhi[v] == 0.0:
        return s.fail(v, SIDE_HOLES, support)
    return True


def _be_false(s: Store, v: int, support: int) -> bool:
    """Leave a variable only 0."""
    return raise_to(s, v, 0.0, support) and reduce_to(s, v, 0.0, support)


def _is_specified(s: Store, v: int) -> bool:
    """Tell whether a variable was given a value, by its base domain or by a decision."""
    if s.decided[v] or s.constant[v]:
        return is_single(s, v)
    return is_base_single(s, v)


def may_be_equal(s: Store, a: int, b: int) -> bool:
    """Tell whether two variables may still be equal."""
    if s.kind[a] == KIND_FLOAT or s.kind[b] == KIND_FLOAT:
        return low(s, a) <= high(s, b) + FLOAT_TOLERANCE and low(s, b) <= high(s, a) + FLOAT_TOLERANCE
    lo = max(s.lb[a], s.lb[b])
    hi = min(s.ub[a], s.ub[b])
    if s.word[a] < 0 and s.word[b] < 0:
        return lo <= hi
    if s.word[a] < 0:
        a, b = b, a
    while lo <= hi:
        lo = next_value(s, a, lo)
        if lo > hi or s.word[b] < 0:
            break
        x = next_value(s, b, lo)
        if x == lo:
            return True
        lo = x
    return lo <= hi


def _test_equal(s: Store, t: int, a: int, b: int, equal: bool, support: int) -> bool:
    """Narrow t = (a == b), or t = (a != b)."""
    known = _truth(s, t)
    if known == _UNKNOWN:
        if not may_be_equal(s, a, b):
            return _be_false(s, t, support) if equal else _be_true(s, t, support)
        if is_single(s, a) and is_single(s, b):
            return _be_true(s, t, support) if equal else _be_false(s, t, support)
        return True
    if (known == 1) == equal:
        return equate(s, a, b, support)
    return differ(s, a, b, support)


def _test_order(s: Store, t: int, a: int, b: int, strict: bool, support: int) -> bool:
    """Narrow t = (a <= b), or t = (a < b)."""
    known = _truth(s, t)
    if known == 1:
        return precede(s, a, b, strict, support)
    if known == 0:
        return precede(s, b, a, not strict, support)
    if s.kind[a] != KIND_FLOAT and s.kind[b] != KIND_FLOAT:
        step = 1 if strict else 0
        if s.ub[a] + step <= s.lb[b]:
            return _be_true(s, t, support)
        return s.lb[a] + step <= s.ub[b] or _be_false(s, t, support)
    if strict:
        if high(s, a) + STRICT_STEP <= low(s, b):
            return _be_true(s, t, support)
        return low(s, a) + FLOAT_TOLERANCE < high(s, b) or _be_false(s, t, support)
    if high(s, a) <= low(s, b):
        return _be_true(s, t, support)
    if low(s, a) > high(s, b) + FLOAT_TOLERANCE:
        return _be_false(s, t, support)
    return not (is_single(s, a) and is_single(s, b)) or _be_true(s, t, support)


def _test_both(s: Store, t: int, a: int, b: int, sway: int, support: int) -> bool:
    """Narrow t = (a and b), of which 0 is enough to sway it, or t = (a or b), of which 1 is."""
    x = _truth(s, a)
    y = _truth(s, b)
    if x == sway or y == sway:
        return _be(s, t, sway, support)
    if x == 1 - sway and y == 1 - sway:
        return _be(s, t, 1 - sway, support)
    known = _truth(s, t)
    if known == 1 - sway:
        return _be(s, a, 1 - sway, support) and _be(s, b, 1 - sway, support)
    if known == sway:
        if x == 1 - sway:
            return _be(s, b, sway, support)
        if y == 1 - sway:
            return _be(s, a, sway, support)
    return True


def _be(s: Store, v: int, value: int, support: int) -> bool:
    """Make a variable true or false."""
    return _be_true(s, v, support) if value else _be_false(s, v, support)


def _need_one(s: Store, first: int, count: int, support: int) -> bool:
    """Make the last candidate true when all others are false."""
    last = -1
    for k in range(first, first + count):
        known = _truth(s, s.slot_variable[k])
        if known == 1:
            return True
        if known == _UNKNOWN:
            if last >= 0:
                return True
            last = s.slot_variable[k]
    if last < 0:
        return s.fail(s.slot_variable[first], SIDE_HOLES, support)
    return _be_true(s, last, support)


def _count_zeroes(s: Store, first: int, count: int, zeroes: bool, support: int) -> bool:
    """Narrow n = how many are zero (or not zero); a count at its limit decides the others."""
    n = s.slot_variable[first]
    sure = 0
    unsure = 0
    for k in range(first + 1, first + count):
        known = _truth(s, s.slot_variable[k])
        if known == _UNKNOWN:
            unsure += 1
        elif (known == 0) == zeroes:
            sure += 1
    if not (raise_to(s, n, sure, support) and reduce_to(s, n, sure + unsure, support)):
        return False
    if unsure == 0:
        return True
    if high(s, n) < sure + 0.5:
        none_left = True
    elif low(s, n) > sure + unsure - 0.5:
        none_left = False
    else:
        return True
    for k in range(first + 1, first + count):
        v = s.slot_variable[k]
        if _truth(s, v) == _UNKNOWN:
            if none_left == zeroes:
                if not _be_true(s, v, support):
                    return False
            elif not _be_false(s, v, support):
                return False
    return True


def _run_condition(s: Store, op: int, t: int, first: int, count: int, support: int) -> bool:
    """Narrow t = (all equal), or t = (all different)."""
    known = _truth(s, t)
    if known == 1:
        if op == OP_COND_EQ:
            return equate_all(s, first, count, support)
        return differ_all(s, first, count, support)
    if op == OP_COND_EQ:
        return _test_all_equal(s, t, known, first, count, support)
    return _test_all_different(s, t, known, first, count, support)


def _test_all_equal(s: Store, t: int, known: int, first: int, count: int, support: int) -> bool:
    """Narrow t = (all equal) while t is not true; the last open variable must differ when t is false."""
    a = -1
    undecided = -1
    for k in range(first, first + count):
        v = s.slot_variable[k]
        if not is_single(s, v):
            undecided = v if undecided == -1 else -2
        elif a < 0:
            a = v
        elif not may_be_equal(s, a, v):
            return known == 0 or _be_false(s, t, support)
    if undecided == -1:
        return s.fail(t, SIDE_HOLES, support) if known == 0 else _be_true(s, t, support)
    if known == 0:
        return undecided < 0 or a < 0 or differ(s, a, undecided, support)
    for k in range(first, first + count):
        for j in range(first, k):
            if not may_be_equal(s, s.slot_variable[j], s.slot_variable[k]):
                return _be_false(s, t, support)
    return True


def _test_all_different(s: Store, t: int, known: int, first: int, count: int, support: int) -> bool:
    """Narrow t = (all different) while t is not true."""
    open_pairs = 0
    a = -1
    b = -1
    for k in range(first, first + count):
        for j in range(first, k):
            x = s.slot_variable[j]
            y = s.slot_variable[k]
            if not may_be_equal(s, x, y):
                continue
            if is_single(s, x) and is_single(s, y):
                return known == 0 or _be_false(s, t, support)
            open_pairs += 1
            a = x
            b = y
    if open_pairs == 0:
        return s.fail(t, SIDE_HOLES, support) if known == 0 else _be_true(s, t, support)
    if known != 0 and has_hall_violation(s, first, count):
        return _be_false(s, t, support)
    # One pair is left that may be equal, and one must be.
    return known != 0 or open_pairs > 1 or equate(s, a, b, support)
