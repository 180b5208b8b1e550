"""Make the variables of constants: they stay out of the trail, so that they outlive every rewind."""

from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import FLAG_VALUES
from runtime.constraints.domains.variables import add_restriction, clear_row, start_interval, start_values, take_block


def constant_interval(s: Store, kind: int, lo: float, hi: float) -> int:
    """Make a constant value or interval."""
    size = s.trail_size
    v = take_block(s, 1)
    clear_row(s, v, kind)
    start_interval(s, v, lo, hi, add_restriction(s, v, lo, hi, 0, -1, -1))
    s.constant[v] = 1
    s.trail_size = size
    return v


def constant_set(s: Store, kind: int, values: list[float]) -> int:
    """Make a constant set of values (sorted, each once, at least one)."""
    size = s.trail_size
    v = take_block(s, 1)
    clear_row(s, v, kind)
    r = add_restriction(s, v, values[0], values[len(values) - 1], FLAG_VALUES, -1, -1)
    s.restriction_values[r] = values
    start_values(s, v, values, r)
    s.constant[v] = 1
    s.trail_size = size
    return v
