"""Ask what a base domain allows: the intersection of a variable's declaration and assignments, decisions aside."""

from bisect import bisect_left
from math import inf

from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import FLAG_DECISION, FLAG_VALUES, FLOAT_TOLERANCE, HALF_INF, KIND_FLOAT


def base_low(s: Store, v: int) -> float:
    """Give the lower bound of the base domain: what declaration and assignments allow, decisions aside."""
    x = -inf
    r = s.restriction_head[v]
    while r >= 0:
        if not s.restriction_flags[r] & FLAG_DECISION and s.restriction_lo[r] > x:
            x = s.restriction_lo[r]
        r = s.restriction_next[r]
    return x


def base_high(s: Store, v: int) -> float:
    """Give the upper bound of the base domain."""
    x = inf
    r = s.restriction_head[v]
    while r >= 0:
        if not s.restriction_flags[r] & FLAG_DECISION and s.restriction_hi[r] < x:
            x = s.restriction_hi[r]
        r = s.restriction_next[r]
    return x


def is_growing(s: Store, v: int) -> bool:
    """Tell whether further values may join the domain: an open one that nothing has narrowed to known values."""
    return s.is_open[v] != 0 and (s.lb[v] <= -HALF_INF or s.ub[v] >= HALF_INF)


def is_base_growing(s: Store, v: int) -> bool:
    """Tell whether further values may join the base domain: an open one that no assignment has restricted."""
    return s.is_open[v] != 0 and base_low(s, v) == -inf


def is_listing(s: Store, r: int) -> bool:
    """Tell whether a restriction only lists what is known of an open domain."""
    return (s.restriction_flags[r] & FLAG_VALUES) != 0 and s.restriction_lo[r] == -inf


def base_set(s: Store, v: int) -> list[float] | None:
    """Give the values of a base domain that is a set, sorted; None if it is an interval. The list is not to change.

    Of a base domain that is growing, these are the values that are listed so far.
    """
    lo = base_low(s, v)
    hi = base_high(s, v)
    listed: list[float] | None = None
    values: list[float] | None = None
    r = s.restriction_head[v]
    while r >= 0:
        if is_listing(s, r):
            listed = s.restriction_values[r]
        elif s.restriction_flags[r] == FLAG_VALUES:
            others = s.restriction_values[r]
            values = others if values is None else sorted(set(values).intersection(others))
        r = s.restriction_next[r]
    if values is None:
        values = [lo] if listed is not None and lo == hi else listed
    if values and (values[0] < lo or values[len(values) - 1] > hi):
        values = [x for x in values if lo <= x <= hi]
    return values


def in_order(values: list[float]) -> list[float]:
    """Copy a list of values, sorted and each once."""
    for k in range(1, len(values)):
        x = values[k]
        if values[k - 1] >= x:
            return sorted(set(values))
    return list(values)


def insert_value(values: list[float], value: float) -> None:
    """Insert a value into a sorted list, unless it is there; the greatest, as a rule, goes to the end."""
    index = len(values)
    if index and values[index - 1] >= value:
        index = bisect_left(values, value)
    if index == len(values) or values[index] != value:
        values.insert(index, value)


def is_base_single(s: Store, v: int) -> bool:
    """Tell whether the base domain is a single value."""
    lo, hi = -inf, inf
    has_values = False
    r = s.restriction_head[v]
    while r >= 0:
        if not s.restriction_flags[r] & FLAG_DECISION:
            lo = max(lo, s.restriction_lo[r])
            hi = min(hi, s.restriction_hi[r])
            if lo == hi and s.consistent:
                return True  # what the others allow has this value
            has_values = has_values or (s.restriction_flags[r] == FLAG_VALUES and not is_listing(s, r))
        r = s.restriction_next[r]
    if lo == hi or (s.kind[v] == KIND_FLOAT and hi - lo <= FLOAT_TOLERANCE):
        return True
    if not has_values:
        return False
    values = base_set(s, v)
    return values is not None and len(values) == 1
