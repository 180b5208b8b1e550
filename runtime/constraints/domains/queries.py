"""List and test the values of derived domains."""

from runtime.constraints.domains.base_domain import base_set, is_growing
from runtime.constraints.domains.bitset import count_values, has_value, index_above, index_below, next_index, value_at
from runtime.constraints.domains.narrow import is_near, is_single
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import FLOAT_TOLERANCE, HALF_INF, KIND_FLOAT


def may_be(s: Store, v: int, x: float) -> bool:
    """Tell whether a variable may still take a value."""
    if s.kind[v] != KIND_FLOAT:
        return -HALF_INF < x < HALF_INF and x == int(x) and has_value(s, v, int(x))
    if s.word[v] >= 0:
        return is_near(x, _listed_reals(s, v))
    return s.flo[v] - FLOAT_TOLERANCE <= x <= s.fhi[v] + FLOAT_TOLERANCE


def has_finitely_many(s: Store, v: int) -> bool:
    """Tell whether a variable is closed and has finitely many values."""
    if is_growing(s, v):
        return False
    if s.kind[v] == KIND_FLOAT:
        return s.word[v] >= 0 or is_single(s, v)
    return s.lb[v] > -HALF_INF and s.ub[v] < HALF_INF


def number_of_values(s: Store, v: int) -> int:
    """Count the values of a finite domain."""
    if s.kind[v] == KIND_FLOAT:
        return len(_listed_reals(s, v)) if s.word[v] >= 0 else 1
    return count_values(s, v)


def listed(s: Store, v: int) -> list[float]:
    """List the values of a finite domain in ascending order; of an open one, those listed that are possible."""
    if is_growing(s, v):
        return [x for x in base_set(s, v) or [] if has_value(s, v, int(x))]
    if s.kind[v] == KIND_FLOAT:
        return _listed_reals(s, v) if s.word[v] >= 0 else [s.flo[v] + (s.fhi[v] - s.flo[v]) * 0.5]
    if s.word[v] < 0:
        return list(range(s.lb[v], s.ub[v] + 1))
    found: list[float] = []
    last = index_below(s, v, s.ub[v])
    index = next_index(s, v, index_above(s, v, s.lb[v]))
    while 0 <= index <= last:
        found.append(value_at(s, v, index))
        index = next_index(s, v, index + 1)
    return found


def _listed_reals(s: Store, v: int) -> list[float]:
    """List the values of a float that has a set."""
    found: list[float] = []
    index = next_index(s, v, 0)
    while index >= 0:
        x = s.table_values[s.table[v] + index]
        if s.flo[v] - FLOAT_TOLERANCE <= x <= s.fhi[v] + FLOAT_TOLERANCE:
            found.append(x)
        index = next_index(s, v, index + 1)
    return found
