"""Propagate equality, order and difference, on whole numbers, reals and sets."""

import math

from runtime.constraints.domains.bitset import (
    attach_words,
    clear_bits,
    has_value,
    next_index,
    value_at,
)
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
    ALL_BITS,
    FLOAT_TOLERANCE,
    HALF_INF,
    KIND_FLOAT,
    KIND_INT,
    MODE_EDGES,
    MODE_REAL,
    MOST_VALUES,
    NEVER,
    ONE_BIT,
    SIDE_HOLES,
    SIDE_LOWER,
    STRICT_STEP,
    SUPPORT_CONSTRAINT,
)
from runtime.constraints.propagators.all_different import has_hall_violation
from runtime.constraints.propagators.opcodes import (
    OP_ALL_DIFF,
    OP_EQ,
    OP_LEQ,
    OP_LT,
    OP_NEQ,
    OP_PLUS,
    OP_TEMPORAL_DISTANCE,
    OP_WITHIN_BOUNDS,
)
from runtime.constraints.propagators.strict_cycles import is_in_strict_cycle
from runtime.constraints.stn.entailment import entail
from runtime.constraints.stn.network import tie_edge, tie_edges, tighten_edge


def propagate_comparison(s: Store, c: int) -> bool:
    """Run a constraint of this family."""
    op = s.op[c]
    first = s.first[c]
    a = s.slot_variable[first]
    b = s.slot_variable[first + 1]
    support = c * 4 + SUPPORT_CONSTRAINT
    if op == OP_TEMPORAL_DISTANCE:
        return _keep_distance(s, c, a, b, s.slot_variable[first + 2], support)
    if s.coarse and (op == OP_LEQ or op == OP_LT or op == OP_EQ) and is_in_strict_cycle(s, c):
        return s.fail(b, SIDE_LOWER, support)
    if op == OP_LEQ or op == OP_LT:
        if s.mode[c] == MODE_EDGES:
            return s.link_a[c] >= 0 or tie_edge(s, c, b, a, -1 if op == OP_LT else 0)
        if not precede(s, a, b, op == OP_LT, support):
            return False
        if s.mode[c] != MODE_REAL and s.ub[a] + (op == OP_LT) <= s.lb[b]:
            entail(s, c)  # neither bound will come back
        return True
    if op == OP_EQ:
        if s.mode[c] == MODE_EDGES and s.link_a[c] < 0 and not tie_edges(s, c, a, b, 0, 0):
            return False
        if s.arity[c] == 2:
            return equate(s, a, b, support)
        return equate_all(s, first, s.arity[c], support)
    if op == OP_NEQ:
        return differ(s, a, b, support)
    if op == OP_PLUS:
        x = s.lb[b]  # a constant
        return s.link_a[c] >= 0 or tie_edges(s, c, a, s.slot_variable[first + 2], x, -x)
    if op == OP_ALL_DIFF:
        return differ_all(s, first, s.arity[c], support)
    assert op == OP_WITHIN_BOUNDS
    last = s.slot_variable[first + 2]
    if not (raise_to(s, a, low(s, b), support) and reduce_to(s, a, high(s, last), support)):
        return False
    return precede(s, b, last, False, support)


def precede(s: Store, a: int, b: int, strict: bool, support: int) -> bool:
    """Narrow a <= b, or a < b; a whole number is never pushed off a fraction by more than to the next whole one."""
    if s.kind[a] != KIND_FLOAT and s.kind[b] != KIND_FLOAT:
        step = 1 if strict else 0
        if s.ub[b] < HALF_INF and not set_upper(s, a, s.ub[b] - step, support):
            return False
        return s.lb[a] <= -HALF_INF or set_lower(s, b, s.lb[a] + step, support)
    x = high(s, b)
    if strict and x != math.inf and low(s, a) + FLOAT_TOLERANCE >= x:
        # Bounds that touch would count as equal to those that the step moves them to.
        return s.fail(b, SIDE_LOWER, support)
    if strict and x != math.inf:
        x = math.ceil(x - FLOAT_TOLERANCE) - 1 if s.kind[a] != KIND_FLOAT else x - STRICT_STEP
    if not reduce_to(s, a, x, support):
        return False
    x = low(s, a)
    if strict and x != -math.inf:
        x = math.floor(x + FLOAT_TOLERANCE) + 1 if s.kind[b] != KIND_FLOAT else x + STRICT_STEP
    return raise_to(s, b, x, support)


def equate(s: Store, a: int, b: int, support: int) -> bool:
    """Leave two variables only the values that both have."""
    if s.kind[a] != KIND_FLOAT and s.kind[b] != KIND_FLOAT:
        while True:
            if not (set_lower(s, a, s.lb[b], support) and set_lower(s, b, s.lb[a], support)):
                return False
            if not (set_upper(s, a, s.ub[b], support) and set_upper(s, b, s.ub[a], support)):
                return False
            if (s.word[a] < 0 and s.word[b] < 0) or s.lb[a] == s.ub[b]:
                return True
            if not (exclude_missing(s, a, b, support) and exclude_missing(s, b, a, support)):
                return False
            if s.coarse or (s.lb[a] == s.lb[b] and s.ub[a] == s.ub[b]):
                return True
    for _ in range(2):
        if not (raise_to(s, a, low(s, b), support) and raise_to(s, b, low(s, a), support)):
            return False
        if not (reduce_to(s, a, high(s, b), support) and reduce_to(s, b, high(s, a), support)):
            return False
    return True


def equate_all(s: Store, first: int, count: int, support: int) -> bool:
    """Leave many variables only the values that all of them have."""
    a = s.slot_variable[first]
    for _ in range(2):
        for k in range(1, count):
            if not equate(s, a, s.slot_variable[first + k], support):
                return False
    return True


def _chunk(s: Store, v: int, start: int) -> int:
    """Give, as 64 bits, which of the values from `start` on a variable with a dense bit set has."""
    index = start - s.bit_base[v]
    if index <= -64 or index >= 64 * s.words_of[v]:
        return 0
    if index < 0:
        return (s.bits[s.word[v]] << -index) & ALL_BITS
    k = index >> 6
    x = s.bits[s.word[v] + k] >> (index & 63)
    if index & 63 and k + 1 < s.words_of[v]:
        x |= (s.bits[s.word[v] + k + 1] << (64 - (index & 63))) & ALL_BITS
    return x


def exclude_missing(s: Store, a: int, b: int, support: int) -> bool:
    """Take from discrete b the values that are holes of a."""
    if s.word[a] < 0:
        return True
    if s.word[b] < 0:
        if s.lb[b] == s.ub[b]:
            return has_value(s, a, s.lb[b]) or s.fail(b, SIDE_HOLES, support)
        if s.ub[b] - s.lb[b] >= MOST_VALUES or (s.kind[b] == KIND_INT and not s.holes):
            return True
        attach_words(s, b, s.lb[b], s.ub[b] - s.lb[b] + 1)
    if s.table[a] < 0 and s.table[b] < 0:
        for k in range(s.words_of[b]):
            mask = s.bits[s.word[b] + k] & (ALL_BITS ^ _chunk(s, a, s.bit_base[b] + 64 * k))
            if mask:
                clear_bits(s, b, k, mask, support)
    else:
        index = next_index(s, b, 0)
        while index >= 0:
            if not has_value(s, a, value_at(s, b, index)):
                clear_bits(s, b, index >> 6, ONE_BIT << (index & 63), support)
            index = next_index(s, b, index + 1)
    return round_bounds(s, b, support)


def differ(s: Store, a: int, b: int, support: int) -> bool:
    """Take a known value of the one from the other."""
    if s.kind[a] != KIND_FLOAT and s.kind[b] != KIND_FLOAT:
        if s.lb[a] == s.ub[a] and not remove_value(s, b, s.lb[a], support):
            return False
        return s.lb[b] != s.ub[b] or remove_value(s, a, s.lb[b], support)
    if is_single(s, a) and is_single(s, b) and abs(low(s, a) - low(s, b)) <= FLOAT_TOLERANCE:
        return s.fail(a, SIDE_HOLES, support)
    return True


def differ_all(s: Store, first: int, count: int, support: int) -> bool:
    """Take the known values from all other variables, until no new one becomes known."""
    k = 0
    while k < count:
        a = s.slot_variable[first + k]
        following = k + 1
        if is_single(s, a):
            for j in range(count):
                if j != k:
                    b = s.slot_variable[first + j]
                    was_single = is_single(s, b)
                    if not differ(s, a, b, support):
                        return False
                    # A value that becomes known behind us is looked at from the start.
                    if j < k and not was_single and is_single(s, b):
                        following = 0
        k = following
    return not has_hall_violation(s, first, count) or s.fail(s.slot_variable[first], SIDE_HOLES, support)


def _keep_distance(s: Store, c: int, start: int, distance: int, end: int, support: int) -> bool:
    """Hold `end - start` within a variable's bounds, by two edges whose weights follow them, and narrow it in turn."""
    is_known = s.lb[distance] == s.ub[distance] and s.kind[distance] != KIND_FLOAT
    # A bound that comes from those of start and end tells them nothing, unless it was rounded to a value.
    is_telling = is_known or s.word[distance] >= 0 or s.link_a[c] < 0
    if is_telling or s.upper_support[distance] != support or s.lower_support[distance] != support:
        if not _follow_distance(s, c, start, distance, end, is_telling):
            return False
    if is_known:  # the edges say all that there is to say
        entail(s, c)
        return True
    if s.ub[end] < HALF_INF and s.lb[start] > -HALF_INF:
        x = s.ub[end] - s.lb[start]
        if (x < s.ub[distance] or s.kind[distance] == KIND_FLOAT) and not reduce_to(s, distance, x, support):
            return False
    if s.lb[end] > -HALF_INF and s.ub[start] < HALF_INF:
        x = s.lb[end] - s.ub[start]
        if (x > s.lb[distance] or s.kind[distance] == KIND_FLOAT) and not raise_to(s, distance, x, support):
            return False
    return True


def _follow_distance(s: Store, c: int, start: int, distance: int, end: int, wholly: bool) -> bool:
    """Have the edges between start and end say what the distance says, if not wholly, but for what comes from them."""
    longest = NEVER
    shortest = -NEVER
    if s.kind[distance] == KIND_FLOAT:
        if high(s, distance) < HALF_INF:
            longest = int(math.floor(max(high(s, distance), -HALF_INF) + FLOAT_TOLERANCE))
        if low(s, distance) > -HALF_INF:
            shortest = int(math.ceil(min(low(s, distance), HALF_INF) - FLOAT_TOLERANCE))
    else:
        if s.ub[distance] < HALF_INF:
            longest = s.ub[distance]
        if s.lb[distance] > -HALF_INF:
            shortest = s.lb[distance]
    if s.link_a[c] < 0:
        return tie_edges(s, c, start, end, longest, -shortest)
    support = c * 4 + SUPPORT_CONSTRAINT
    if wholly or s.upper_support[distance] != support:
        if not tighten_edge(s, s.link_a[c], longest):
            return False
    return (not wholly and s.lower_support[distance] == support) or tighten_edge(s, s.link_b[c], -shortest)
