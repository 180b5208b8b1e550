"""Narrow one variable by one bound or value, with its support; the trail, the holes and the watches follow."""

import math
from math import inf

from runtime.constraints.domains.bitset import (
    attach_words,
    clear_bits,
    has_value,
    index_above,
    next_index,
    next_value,
    previous_index,
    previous_value,
    table_index,
)
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    EVENT_LOWER,
    EVENT_UPPER,
    FLOAT_TOLERANCE,
    HALF_INF,
    INF,
    KIND_FLOAT,
    KIND_INT,
    MOST_VALUES,
    ONE_BIT,
    SIDE_HOLES,
    SIDE_LOWER,
    SIDE_UPPER,
)


def set_lower(s: Store, v: int, x: int, support: int) -> bool:
    """Raise the lower bound of a discrete variable to x; false if no value is left."""
    if x <= s.lb[v]:
        return True
    if s.word[v] >= 0:
        x = next_value(s, v, x)
        s.running = -1  # who made the bound jump over holes may have more to do
    if x > s.ub[v]:
        return s.fail(v, SIDE_LOWER, support)
    if s.coarse and x - s.lb[v] < (s.ub[v] - s.lb[v]) >> 7:
        return True
    s.write_lower(v, x, support)
    s.queue_edges(v, 0)
    s.wake(v, EVENT_LOWER)
    return True


def set_upper(s: Store, v: int, x: int, support: int) -> bool:
    """Reduce the upper bound of a discrete variable to x; false if no value is left."""
    if x >= s.ub[v]:
        return True
    if s.word[v] >= 0:
        x = previous_value(s, v, x)
        s.running = -1
    if x < s.lb[v]:
        return s.fail(v, SIDE_UPPER, support)
    if s.coarse and s.ub[v] - x < (s.ub[v] - s.lb[v]) >> 7:
        return True
    s.write_upper(v, x, support)
    s.queue_edges(v, 1)
    s.wake(v, EVENT_UPPER)
    return True


def assign(s: Store, v: int, x: int, support: int) -> bool:
    """Leave a discrete variable only the value x."""
    if not has_value(s, v, x):
        return s.fail(v, SIDE_LOWER if x > s.ub[v] else SIDE_UPPER if x < s.lb[v] else SIDE_HOLES, support)
    return set_lower(s, v, x, support) and set_upper(s, v, x, support)


def remove_value(s: Store, v: int, x: int, support: int) -> bool:
    """Take the value x from a discrete variable; an interval of many values keeps what is not at its ends."""
    if x < s.lb[v] or x > s.ub[v]:
        return True
    if s.word[v] < 0:
        if x == s.lb[v]:
            return set_lower(s, v, x + 1, support)
        if x == s.ub[v]:
            return set_upper(s, v, x - 1, support)
        if s.ub[v] - s.lb[v] >= MOST_VALUES or (s.kind[v] == KIND_INT and not s.holes):
            return True
        attach_words(s, v, s.lb[v], s.ub[v] - s.lb[v] + 1)
    elif not has_value(s, v, x):
        return True
    index = index_above(s, v, x)
    clear_bits(s, v, index >> 6, ONE_BIT << (index & 63), support)
    return round_bounds(s, v, support)


def round_bounds(s: Store, v: int, support: int) -> bool:
    """Move bounds that stand in a hole to the next value; they keep their support, the log of holes has the rest."""
    x = next_value(s, v, s.lb[v])
    if x > s.ub[v]:
        return s.fail(v, SIDE_HOLES, support)
    if x > s.lb[v] and not set_lower(s, v, x, s.lower_support[v]):
        return False
    x = previous_value(s, v, s.ub[v])
    return x >= s.ub[v] or set_upper(s, v, x, s.upper_support[v])


def _set_real_lower(s: Store, v: int, x: float, support: int) -> bool:
    """Raise the lower bound of a float to x; a bound within the tolerance above the upper one means equality."""
    if x <= s.flo[v]:
        return True
    if s.word[v] >= 0:
        index = next_index(s, v, table_index(s, v, x))
        x = s.table_values[s.table[v] + index] if index >= 0 else inf
        if x <= s.flo[v]:
            return True
    if x > s.fhi[v]:
        if x > s.fhi[v] + FLOAT_TOLERANCE:
            return s.fail(v, SIDE_LOWER, support)
        x = s.fhi[v]
        if x <= s.flo[v]:
            return True
    if s.coarse and x - s.flo[v] < 0.01 * (s.fhi[v] - s.flo[v]):
        return True
    s.write_real_lower(v, x, support)
    s.wake(v, EVENT_LOWER)
    return True


def _set_real_upper(s: Store, v: int, x: float, support: int) -> bool:
    """Reduce the upper bound of a float to x; a bound within the tolerance below the lower one means equality."""
    if x >= s.fhi[v]:
        return True
    if s.word[v] >= 0:
        index = previous_index(s, v, table_index(s, v, x + 3 * FLOAT_TOLERANCE))
        while index >= 0 and s.table_values[s.table[v] + index] > x + FLOAT_TOLERANCE:
            index = previous_index(s, v, index - 1)
        x = s.table_values[s.table[v] + index] if index >= 0 else -inf
        if x >= s.fhi[v]:
            return True
    if x < s.flo[v]:
        if x < s.flo[v] - FLOAT_TOLERANCE:
            return s.fail(v, SIDE_UPPER, support)
        x = s.flo[v]
        if x >= s.fhi[v]:
            return True
    if s.coarse and s.fhi[v] - x < 0.01 * (s.fhi[v] - s.flo[v]):
        return True
    s.write_real_upper(v, x, support)
    s.wake(v, EVENT_UPPER)
    return True


def low(s: Store, v: int) -> float:
    """Give the lower bound of any variable as a float, -inf where there is none."""
    if s.kind[v] == KIND_FLOAT:
        return s.flo[v]
    if s.lb[v] <= -HALF_INF:
        return -inf
    return float(s.lb[v])


def high(s: Store, v: int) -> float:
    """Give the upper bound of any variable as a float, inf where there is none."""
    if s.kind[v] == KIND_FLOAT:
        return s.fhi[v]
    if s.ub[v] >= HALF_INF:
        return inf
    return float(s.ub[v])


def raise_to(s: Store, v: int, x: float, support: int) -> bool:
    """Raise the lower bound of any variable to x; a whole number is rounded inwards, within the tolerance."""
    if s.kind[v] == KIND_FLOAT:
        return _set_real_lower(s, v, x, support)
    if x <= s.lb[v]:
        return True
    if x >= HALF_INF:
        return set_lower(s, v, INF, support)
    return set_lower(s, v, int(math.ceil(x - FLOAT_TOLERANCE)), support)


def reduce_to(s: Store, v: int, x: float, support: int) -> bool:
    """Reduce the upper bound of any variable to x; a whole number is rounded inwards, within the tolerance."""
    if s.kind[v] == KIND_FLOAT:
        return _set_real_upper(s, v, x, support)
    if x >= s.ub[v]:
        return True
    if x <= -HALF_INF:
        return set_upper(s, v, -INF, support)
    return set_upper(s, v, int(math.floor(x + FLOAT_TOLERANCE)), support)


def is_single(s: Store, v: int) -> bool:
    """Tell whether only one value is left."""
    if s.kind[v] == KIND_FLOAT:
        return s.fhi[v] - s.flo[v] <= FLOAT_TOLERANCE
    return s.lb[v] == s.ub[v]


def is_near(x: float, values: list[float]) -> bool:
    """Tell whether one of some values equals x within the tolerance."""
    for y in values:  # noqa: SIM110 (a generator cannot be compiled here)
        if abs(x - y) <= FLOAT_TOLERANCE:
            return True
    return False
