"""Propagate what relates whole domains: subsets, unions, locks, the fields of objects, objects inside objects."""

from math import inf

from runtime.constraints.domains.bitset import clear_bits, count_values, has_value, next_index, next_value
from runtime.constraints.domains.narrow import (
    high,
    is_single,
    low,
    raise_to,
    reduce_to,
    remove_value,
    round_bounds,
    set_lower,
    set_upper,
)
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    FLOAT_TOLERANCE,
    HALF_INF,
    KIND_FLOAT,
    MOST_VALUES,
    NEVER,
    ONE_BIT,
    SIDE_HOLES,
    SUPPORT_CONSTRAINT,
)
from runtime.constraints.propagators.all_different import is_subset
from runtime.constraints.propagators.comparison import equate, exclude_missing
from runtime.constraints.propagators.logic import may_be_equal
from runtime.constraints.propagators.opcodes import (
    OP_COMMON_ANCESTOR,
    OP_ELEMENT,
    OP_EQ_UNION,
    OP_FREEZE,
    OP_HAS_ANCESTOR,
    OP_LOCK,
    OP_MEMBER_IMPLY,
    OP_SUBSET_OF,
)


def propagate_sets(s: Store, c: int) -> bool:
    """Run a constraint of this family."""
    op = s.op[c]
    first = s.first[c]
    a = s.slot_variable[first]
    b = s.slot_variable[first + 1]
    support = c * 4 + SUPPORT_CONSTRAINT
    if op == OP_ELEMENT:
        return _look_up(s, first, s.arity[c], support)
    if op == OP_SUBSET_OF:
        return _keep_inside(s, a, b, support)
    if op == OP_EQ_UNION:
        return _keep_union(s, first, s.arity[c], support)
    if op == OP_MEMBER_IMPLY:
        if not is_subset(s, b, s.slot_variable[first + 2]):
            return True
        return _keep_inside(s, a, s.slot_variable[first + 3], support)
    if op == OP_LOCK:
        return (is_subset(s, b, a) or s.fail(a, SIDE_HOLES, support)) and _keep_inside(s, a, b, support)
    if op == OP_FREEZE:
        if not is_subset(s, b, a):
            return s.fail(a, SIDE_HOLES, support)
        return s.is_open[a] != 0 or _keep_inside(s, a, b, support)
    if op == OP_HAS_ANCESTOR:
        return _lie_inside(s, a, b, support)
    assert op == OP_COMMON_ANCESTOR
    return _share_ancestor(s, a, b, s.slot_variable[first + 2], support)


def _keep_inside(s: Store, a: int, b: int, support: int) -> bool:
    """Narrow a to the values of b; b stays."""
    if not (raise_to(s, a, low(s, b), support) and reduce_to(s, a, high(s, b), support)):
        return False
    if s.kind[a] == KIND_FLOAT or s.kind[b] == KIND_FLOAT:
        return True
    return exclude_missing(s, b, a, support)


def _keep_union(s: Store, first: int, count: int, support: int) -> bool:
    """Narrow the first argument to the union of all others (intervals: to its hull), and them to its domain."""
    a = s.slot_variable[first]
    for _ in range(2):
        lo = inf
        hi = -inf
        for k in range(first + 1, first + count):
            lo = min(lo, low(s, s.slot_variable[k]))
            hi = max(hi, high(s, s.slot_variable[k]))
        if not (raise_to(s, a, lo, support) and reduce_to(s, a, hi, support)):
            return False
        if (s.word[a] >= 0 or s.kind[a] > KIND_FLOAT) and not _remove_outside(s, a, first + 1, count - 1, support):
            return False
        for k in range(first + 1, first + count):
            if not _keep_inside(s, s.slot_variable[k], a, support):
                return False
    return True


def _remove_outside(s: Store, a: int, first: int, count: int, support: int) -> bool:
    """Take from a discrete variable the values that none of the variables from slot `first` on has."""
    if s.kind[a] == KIND_FLOAT or not _is_listed(s, a):
        return True
    x = s.lb[a]
    while x <= s.ub[a]:
        found = False
        for k in range(first, first + count):
            if _serves(s, s.slot_variable[k], x):
                found = True
                break
        if not found and not remove_value(s, a, x, support):
            return False
        x = _next_object(s, a, x)
    return True


def _look_up(s: Store, first: int, count: int, support: int) -> bool:
    """Narrow result = the variable that the index's value selects, and the index to values whose variable can serve.

    An index without bounds (an open domain) waits. O(rows + values of the result).
    """
    result = s.slot_variable[first]
    index = s.slot_variable[first + 1]
    if s.lb[index] <= -HALF_INF or s.ub[index] >= HALF_INF:
        return True
    lo = inf
    hi = -inf
    last_key = NEVER
    able = -1
    for k in range(_row_of(s, first + 2, first + count, s.lb[index]), first + count):
        key = s.slot_key[k]
        v = s.slot_variable[k]
        if key > s.ub[index]:
            break
        if not (has_value(s, index, key) and may_be_equal(s, result, v)):
            continue
        # Rows stand in the order of their keys: values between two that can serve have no row, or one that cannot.
        if last_key == NEVER:
            if not set_lower(s, index, key, support):
                return False
        elif not _remove_between(s, index, last_key, key, support):
            return False
        last_key = key
        lo = min(lo, low(s, v))
        hi = max(hi, high(s, v))
        able = v if able == -1 else -2
    if able == -1:
        return s.fail(index, SIDE_HOLES, support)
    if not set_upper(s, index, last_key, support):
        return False
    if able >= 0:
        return equate(s, result, able, support)
    if not (raise_to(s, result, lo, support) and reduce_to(s, result, hi, support)):
        return False
    return s.kind[result] == KIND_FLOAT or _remove_unsupported(s, first, count, support)


def _row_of(s: Store, first: int, end: int, key: int) -> int:
    """Find by halving the first row whose key is at least `key`."""
    while first < end:
        middle = (first + end) >> 1
        if s.slot_key[middle] < key:
            first = middle + 1
        else:
            end = middle
    return first


def _remove_between(s: Store, index: int, below: int, above: int, support: int) -> bool:
    """Take from the index the values strictly between two keys."""
    x = max(below + 1, s.lb[index])
    while x < above and x <= s.ub[index]:
        if not remove_value(s, index, x, support):
            return False
        x += 1
    return True


def _remove_unsupported(s: Store, first: int, count: int, support: int) -> bool:
    """Take from the result of a look-up the values that no selectable variable has. O(rows + values)."""
    result = s.slot_variable[first]
    index = s.slot_variable[first + 1]
    base = s.lb[result]
    if s.ub[result] - base >= MOST_VALUES:
        return True
    for k in range(((s.ub[result] - base) >> 5) + 1):
        s.supported[k] = 0
    for k in range(first + 2, first + count):
        if has_value(s, index, s.slot_key[k]):
            _note_served(s, s.slot_variable[k], base, s.ub[result])
    x = base
    while x <= s.ub[result]:
        if not (s.supported[(x - base) >> 5] >> ((x - base) & 31)) & 1:
            if s.word[result] >= 0 and s.table[result] < 0:
                break
            if not remove_value(s, result, x, support):
                return False
        x += 1
    # From here on by words, so that the log of holes gets one entry for many values.
    bit = next_index(s, result, x - s.bit_base[result]) if x <= s.ub[result] else -1
    while bit >= 0:
        k = bit >> 6
        mask = 0
        while bit >= 0 and bit >> 6 == k:
            x = s.bit_base[result] + bit - base
            if base + x <= s.ub[result] and not (s.supported[x >> 5] >> (x & 31)) & 1:
                mask |= ONE_BIT << (bit & 63)
            bit = next_index(s, result, bit + 1)
        if mask:
            clear_bits(s, result, k, mask, support)
    return s.word[result] < 0 or round_bounds(s, result, support)


def _note_served(s: Store, v: int, base: int, last: int) -> None:
    """Mark in `supported` which whole numbers from `base` to `last` a variable may take."""
    if s.kind[v] != KIND_FLOAT:
        last = min(last, s.ub[v])
    for x in range(base if s.kind[v] == KIND_FLOAT else max(base, s.lb[v]), last + 1):
        if _serves(s, v, x):
            s.supported[(x - base) >> 5] |= ONE_BIT << ((x - base) & 31)


def _serves(s: Store, v: int, x: int) -> bool:
    """Tell whether any variable may take the whole number x."""
    if s.kind[v] == KIND_FLOAT:
        return s.flo[v] - FLOAT_TOLERANCE <= x <= s.fhi[v] + FLOAT_TOLERANCE
    return has_value(s, v, x)


def _is_listed(s: Store, v: int) -> bool:
    """Tell whether the values of a discrete variable can be gone through."""
    return s.lb[v] > -HALF_INF and s.ub[v] < HALF_INF and count_values(s, v) <= MOST_VALUES


def _has_ancestor_in(s: Store, value: int, p: int) -> bool:
    """Tell whether an object lies inside one that p may be."""
    value = s.object_parent.get(value, -1)
    while value >= 0 and not has_value(s, p, value):
        value = s.object_parent.get(value, -1)
    return value >= 0


def _is_inside(s: Store, value: int, ancestor: int) -> bool:
    """Tell whether an object lies inside another one."""
    value = s.object_parent.get(value, -1)
    while value >= 0 and value != ancestor:
        value = s.object_parent.get(value, -1)
    return value >= 0


def _lie_inside(s: Store, x: int, p: int, support: int) -> bool:
    """Narrow: the object x was created by the constructor of p, directly or not."""
    if not _is_listed(s, x):
        return True
    value = s.lb[x]
    while value <= s.ub[x]:
        if not _has_ancestor_in(s, value, p) and not remove_value(s, x, value, support):
            return False
        value = _next_object(s, x, value)
    if not _is_listed(s, p):
        return True
    ancestor = s.lb[p]
    while ancestor <= s.ub[p]:
        value = s.lb[x]
        while value <= s.ub[x] and not _is_inside(s, value, ancestor):
            value = _next_object(s, x, value)
        if value > s.ub[x] and not remove_value(s, p, ancestor, support):
            return False
        ancestor = _next_object(s, p, ancestor)
    return True


def _next_object(s: Store, v: int, value: int) -> int:
    """Give the next value of a discrete variable."""
    return value + 1 if s.word[v] < 0 else next_value(s, v, value + 1)


def _share_ancestor(s: Store, a: int, b: int, p: int, support: int) -> bool:
    """Narrow: a and b lie inside one of the objects of p; acts once a or b is known."""
    for _ in range(2):
        if is_single(s, a) and not _has_ancestor_in(s, s.lb[a], p):
            return s.fail(a, SIDE_HOLES, support)
        if is_single(s, a) and _is_listed(s, p):
            ancestor = s.lb[p]
            while ancestor <= s.ub[p]:
                if not _is_inside(s, s.lb[a], ancestor) and not remove_value(s, p, ancestor, support):
                    return False
                ancestor = _next_object(s, p, ancestor)
            if _is_listed(s, b):
                value = s.lb[b]
                while value <= s.ub[b]:
                    if not _has_ancestor_in(s, value, p) and not remove_value(s, b, value, support):
                        return False
                    value = _next_object(s, b, value)
        a, b = b, a
    return set_lower(s, p, s.lb[p], support) and set_upper(s, p, s.ub[p], support)
