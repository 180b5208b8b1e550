"""Make and drop variables; keep each one's restrictions, of which its base domain is the intersection."""

from math import inf

from runtime.constraints.domains.arrays import lengthen
from runtime.constraints.domains.bitset import (
    attach_table,
    attach_words,
    clear_bits,
    detach_words,
    drop_log,
    index_above,
    next_index,
    value_at,
)
from runtime.constraints.domains.narrow import (
    is_near,
    raise_to,
    reduce_to,
    round_bounds,
)
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    FLAG_VALUES,
    FLOAT_TOLERANCE,
    HALF_INF,
    INF,
    KIND_FLOAT,
    ONE_BIT,
    SIDE_HOLES,
    SUPPORT_RESTRICTION,
    TRAIL_OPEN,
    TRAIL_RESTRICTION,
    TRAIL_VARIABLE,
    WIDEST_SET,
)


def take_row(s: Store) -> int:
    """Take an id: the next of a reserved block, a freed one, or a new one."""
    if s.reserved_next < s.reserved_end:
        v = s.reserved_next
        s.reserved_next = v + 1
        s.block_left[s.block_first[v]] += 1
        return v
    return take_block(s, 1)


def take_block(s: Store, count: int) -> int:
    """Take `count` consecutive ids; freed blocks of up to 64 are used again."""
    if count <= 64 and s.block_free[count] >= 0:
        first = s.block_free[count]
        s.block_free[count] = s.block_next[first]
    else:
        first = s.variables
        while first + count > len(s.kind):
            s.grow_variables()
        s.variables = first + count
    for v in range(first, first + count):
        s.block_first[v] = first
        s.kind[v] = -1
    s.block_size[first] = count
    s.block_left[first] = 1 if count == 1 else 0
    return first


def clear_row(s: Store, v: int, kind: int) -> None:
    """Give a new variable the widest domain of its kind and put it on the trail."""
    s.kind[v] = kind
    s.lb[v] = -INF
    s.ub[v] = INF
    s.flo[v] = -inf
    s.fhi[v] = inf
    s.lower_support[v] = -1
    s.upper_support[v] = -1
    s.lower_when[v] = -1
    s.upper_when[v] = -1
    s.word[v] = -1
    s.words_of[v] = 0
    s.table[v] = -1
    s.hole_head[v] = -1
    s.is_open[v] = 0
    s.decided[v] = 0
    s.constant[v] = 0
    s.restriction_head[v] = -1
    s.watch_head[v] = -1
    s.mute_head[v] = -1
    s.out_head[v] = -1
    s.in_head[v] = -1
    s.queued[v] = 0
    s.save(v, TRAIL_VARIABLE, 0, 0)


def drop_variable(s: Store, v: int) -> None:
    """Free a variable that nothing names any more; its block is free when its last variable is."""
    drop_log(s, v)
    if s.word[v] >= 0:
        detach_words(s, v)
    s.kind[v] = -1
    first = s.block_first[v]
    s.block_left[first] -= 1
    if s.block_left[first] == 0:
        if s.reserved_next < s.reserved_end and s.block_first[s.reserved_next] == first:
            s.reserved_next = s.reserved_end
        count = s.block_size[first]
        if count <= 64:
            s.block_next[first] = s.block_free[count]
            s.block_free[count] = first


def add_restriction(s: Store, v: int, lo: float, hi: float, flags: int, span: int, owner: int) -> int:
    """Put a restriction at the head of the list of `v`, without narrowing `v`."""
    r = s.restriction_free
    if r >= 0:
        s.restriction_free = s.restriction_next[r]
    else:
        r = s.restrictions_used
        if r == len(s.restriction_lo):
            others = "restriction_variable restriction_next restriction_span restriction_owner"
            lengthen(s, "restriction_lo restriction_hi restriction_flags", others)
        s.restrictions_used = r + 1
    s.restriction_variable[r] = v
    s.restriction_lo[r] = lo
    s.restriction_hi[r] = hi
    s.restriction_flags[r] = flags
    s.restriction_span[r] = span
    s.restriction_owner[r] = owner
    s.restriction_next[r] = s.restriction_head[v]
    s.restriction_head[v] = r
    s.save(r, TRAIL_RESTRICTION, 0, 0)
    return r


def drop_restriction(s: Store, r: int) -> None:
    """Take a restriction out of its variable's list and free its row."""
    v = s.restriction_variable[r]
    if s.restriction_head[v] == r:
        s.restriction_head[v] = s.restriction_next[r]
    else:
        other = s.restriction_head[v]
        while s.restriction_next[other] != r:
            other = s.restriction_next[other]
        s.restriction_next[other] = s.restriction_next[r]
    if s.restriction_flags[r] & FLAG_VALUES:
        del s.restriction_values[r]
    s.restriction_variable[r] = -1
    s.restriction_next[r] = s.restriction_free
    s.restriction_free = r


def start_interval(s: Store, v: int, lo: float, hi: float, r: int) -> None:
    """Give a new variable its first bounds, without a trail of their own."""
    support = r * 4 + SUPPORT_RESTRICTION
    s.lower_support[v] = support
    s.upper_support[v] = support
    if s.kind[v] == KIND_FLOAT:
        s.flo[v] = lo if lo > -HALF_INF else -inf
        s.fhi[v] = hi if hi < HALF_INF else inf
        return
    s.lb[v] = int(lo) if lo > -HALF_INF else -INF
    s.ub[v] = int(hi) if hi < HALF_INF else INF


def start_values(s: Store, v: int, values: list[float], r: int) -> None:
    """Give a new variable its first set of values (sorted, each once)."""
    if not values:
        start_interval(s, v, 1, 0, r)
        s.fhi[v] = s.flo[v] - 1.0
        return
    start_interval(s, v, values[0], values[len(values) - 1], r)
    if len(values) == 1:
        return
    if s.kind[v] == KIND_FLOAT:
        attach_table(s, v, values)
        return
    width = s.ub[v] - s.lb[v] + 1
    if width == len(values):
        return
    if width > WIDEST_SET:
        attach_table(s, v, values)
        return
    attach_words(s, v, s.lb[v], width)
    for k in range(s.words_of[v]):
        s.bits[s.word[v] + k] = 0
    for value in values:
        index = int(value) - s.lb[v]
        s.bits[s.word[v] + (index >> 6)] |= ONE_BIT << (index & 63)


def constant_interval(s: Store, kind: int, lo: float, hi: float) -> int:
    """Make a constant value or interval; it stays out of the trail, so that it outlives every rewind."""
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


def is_untouched_set(s: Store, v: int) -> bool:
    """Tell whether a closed variable has all of the dense set of whole numbers that its only restriction lists."""
    r = s.restriction_head[v]
    if s.is_open[v] or r < 0 or s.restriction_next[r] >= 0 or not s.restriction_flags[r] & FLAG_VALUES:
        return False
    if s.kind[v] == KIND_FLOAT or s.table[v] >= 0 or s.hole_head[v] >= 0 or s.lb[v] > s.ub[v]:
        return False
    if s.word[v] < 0 and s.ub[v] - s.lb[v] + 1 != len(s.restriction_values[r]):
        return False
    return bool(s.lb[v] == s.restriction_lo[r] and s.ub[v] == s.restriction_hi[r])


def copy_words(s: Store, v: int, other: int) -> None:
    """Give a new variable the bit set of another one."""
    attach_words(s, v, s.bit_base[other], s.ub[other] - s.bit_base[other] + 1)
    for k in range(s.words_of[v]):
        s.bits[s.word[v] + k] = s.bits[s.word[other] + k]


def keep_values(s: Store, v: int, values: list[float], support: int) -> bool:
    """Narrow `v` to some of the listed values (sorted, each once)."""
    if not values:
        return s.fail(v, SIDE_HOLES, support)
    if not (raise_to(s, v, values[0], support) and reduce_to(s, v, values[len(values) - 1], support)):
        return False
    if s.kind[v] == KIND_FLOAT:
        return _keep_reals(s, v, values, support)
    if s.word[v] < 0:
        if s.lb[v] == s.ub[v]:
            return s.lb[v] in values or s.fail(v, SIDE_HOLES, support)
        inside = [x for x in values if s.lb[v] <= x <= s.ub[v]]
        if not inside:
            return s.fail(v, SIDE_HOLES, support)
        if s.ub[v] - s.lb[v] + 1 == len(inside):
            return True
        if s.ub[v] - s.lb[v] >= WIDEST_SET:
            attach_table(s, v, inside)
            return round_bounds(s, v, support)
        attach_words(s, v, s.lb[v], s.ub[v] - s.lb[v] + 1)
    # Bounds that stand in a hole now are rounded, but keep their support: the log of holes has this one.
    wanted = set(values)
    index = next_index(s, v, index_above(s, v, s.lb[v]))
    while index >= 0 and value_at(s, v, index) <= s.ub[v]:
        k = index >> 6
        mask = 0
        while index >= 0 and index >> 6 == k:
            x = value_at(s, v, index)
            if x <= s.ub[v] and x not in wanted:
                mask |= ONE_BIT << (index & 63)
            index = next_index(s, v, index + 1)
        if mask:
            clear_bits(s, v, k, mask, support)
    return round_bounds(s, v, support)


def _keep_reals(s: Store, v: int, values: list[float], support: int) -> bool:
    """Narrow a float to some of the listed values."""
    if s.word[v] < 0:
        inside = [x for x in values if s.flo[v] - FLOAT_TOLERANCE <= x <= s.fhi[v] + FLOAT_TOLERANCE]
        if not inside:
            return s.fail(v, SIDE_HOLES, support)
        if len(inside) > 1:
            attach_table(s, v, inside)
        return raise_to(s, v, inside[0], support) and reduce_to(s, v, inside[len(inside) - 1], support)
    index = next_index(s, v, 0)
    while index >= 0:
        x = s.table_values[s.table[v] + index]
        if not is_near(x, values):
            clear_bits(s, v, index >> 6, ONE_BIT << (index & 63), support)
        index = next_index(s, v, index + 1)
    index = next_index(s, v, 0)
    if index < 0:
        return s.fail(v, SIDE_HOLES, support)
    return raise_to(s, v, s.flo[v], support) and reduce_to(s, v, s.fhi[v], support)


def close_values(s: Store, v: int) -> bool:
    """End the growth of an open domain: from now on it is what was listed; false if propagation has excluded all."""
    r = s.restriction_head[v]
    while s.restriction_next[r] >= 0:
        r = s.restriction_next[r]
    s.save(v, TRAIL_OPEN, 0, r)
    s.is_open[v] = 0
    values = s.restriction_values[r]
    s.restriction_lo[r] = values[0] if values else 1.0
    s.restriction_hi[r] = values[len(values) - 1] if values else 0.0
    if not values and s.lb[v] <= -HALF_INF and s.ub[v] >= HALF_INF:
        # An empty closed domain is no conflict before a constraint needs a value.
        s.write_lower(v, 1, r * 4 + SUPPORT_RESTRICTION)
        s.write_upper(v, 0, r * 4 + SUPPORT_RESTRICTION)
        return True
    return keep_values(s, v, values, r * 4 + SUPPORT_RESTRICTION)
