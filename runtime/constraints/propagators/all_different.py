"""Compare whole domains: which lies inside which, and whether some are too small to differ from each other."""

from runtime.constraints.domains.bitset import count_values, has_value, next_value
from runtime.constraints.domains.narrow import high, low
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import FLOAT_TOLERANCE, HALF_INF, KIND_FLOAT


def is_subset(s: Store, a: int, b: int) -> bool:
    """Tell whether every value of a is one of b."""
    if s.kind[a] == KIND_FLOAT or s.kind[b] == KIND_FLOAT:
        return low(s, a) >= low(s, b) - FLOAT_TOLERANCE and high(s, a) <= high(s, b) + FLOAT_TOLERANCE
    if s.lb[a] < s.lb[b] or s.ub[a] > s.ub[b]:
        return False
    if s.word[b] < 0:
        return True
    if s.word[a] < 0 and s.ub[a] - s.lb[a] > 64 * s.words_of[b]:
        return False
    x = s.lb[a]
    while x <= s.ub[a]:
        if not has_value(s, b, x):
            return False
        x = x + 1 if s.word[a] < 0 else next_value(s, a, x + 1)
    return True


def has_hall_violation(s: Store, first: int, count: int) -> bool:
    """Tell whether arguments that must differ have too few values: all together, or those inside the domain of one.

    Floats and domains without bounds count as having enough. O(count^2) where domains are smaller than their number.
    """
    if _has_few_values(s, first, count):
        return True
    for k in range(first, first + count):
        v = s.slot_variable[k]
        if s.kind[v] == KIND_FLOAT or s.ub[v] - s.lb[v] >= HALF_INF:
            continue
        size = count_values(s, v)
        if size >= count:
            continue
        inside = 0
        for j in range(first, first + count):
            u = s.slot_variable[j]
            if s.kind[u] != KIND_FLOAT and is_subset(s, u, v):
                inside += 1
        if inside > size:
            return True
    return False


def _has_few_values(s: Store, first: int, count: int) -> bool:
    """Tell whether all arguments together have fewer values than their number."""
    lo = HALF_INF
    hi = -HALF_INF
    for k in range(first, first + count):
        v = s.slot_variable[k]
        if s.kind[v] == KIND_FLOAT:
            return False
        lo = min(lo, s.lb[v])
        hi = max(hi, s.ub[v])
    if hi - lo >= 4 * count:
        return False
    found = 0
    for x in range(lo, hi + 1):
        for k in range(first, first + count):
            if has_value(s, s.slot_variable[k], x):
                found += 1
                break
        if found >= count:
            return False
    return True
