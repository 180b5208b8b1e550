"""Propagate sums, products and extremes of whole numbers exactly; reals, and what doubles do as exactly, by `reals`."""

from runtime.constraints.domains.narrow import remove_value, set_lower, set_upper
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import HALF_INF, INF, MODE_REAL, SUPPORT_CONSTRAINT
from runtime.constraints.propagators.opcodes import (
    OP_ADD_EQ,
    OP_DIV_EQ,
    OP_EQ_MAXIMUM,
    OP_EQ_MINIMUM,
    OP_EQ_PRODUCT,
    OP_EQ_SUM,
    OP_MUL_EQ,
)
from runtime.constraints.propagators.reals import propagate_reals


def propagate_arithmetic(s: Store, c: int) -> bool:
    """Run a constraint of this family."""
    if s.mode[c] == MODE_REAL:
        return propagate_reals(s, c)
    op = s.op[c]
    first = s.first[c]
    a = s.slot_variable[first]
    b = s.slot_variable[first + 1]
    support = c * 4 + SUPPORT_CONSTRAINT
    if op == OP_ADD_EQ:
        return _add(s, a, b, s.slot_variable[first + 2], support)
    if op == OP_MUL_EQ:
        return _multiply(s, a, b, s.slot_variable[first + 2], support)
    if op == OP_EQ_SUM:
        return _add_all(s, first, s.arity[c], support)
    if op == OP_EQ_PRODUCT:
        return _multiply_all(s, first, s.arity[c], support)
    if op == OP_EQ_MAXIMUM or op == OP_EQ_MINIMUM:
        return _hold_extreme(s, first, s.arity[c], op == OP_EQ_MAXIMUM, support)
    if op == OP_DIV_EQ:
        return remove_value(s, b, 0, support) and _multiply(s, s.slot_variable[first + 2], b, a, support)
    return propagate_reals(s, c)


def _clipped(x: int) -> int:
    """Bring what counts as infinite to infinity."""
    if x >= HALF_INF:
        return INF
    if x <= -HALF_INF:
        return -INF
    return x


def _floor_of(x: int, y: int) -> int:
    """Divide by a positive y, rounding down; C rounds towards zero."""
    q = x // y
    return q - 1 if q * y > x else q


def _ceiling_of(x: int, y: int) -> int:
    """Divide by a positive y, rounding up."""
    return -_floor_of(-x, y)


def _product(x: int, y: int) -> int:
    """Multiply, saturating at infinity; infinity times 0 is 0, as the limit of a finite bound."""
    if x == 0 or y == 0:
        return 0
    p = float(x) * float(y)
    if p >= HALF_INF:
        return INF
    if p <= -HALF_INF:
        return -INF
    return x * y


def _add(s: Store, a: int, b: int, r: int, support: int) -> bool:
    """Narrow a + b = r."""
    if s.lb[a] > -HALF_INF:
        if s.lb[b] > -HALF_INF and not set_lower(s, r, _clipped(s.lb[a] + s.lb[b]), support):
            return False
        if s.ub[r] < HALF_INF and not set_upper(s, b, _clipped(s.ub[r] - s.lb[a]), support):
            return False
    if s.ub[a] < HALF_INF:
        if s.ub[b] < HALF_INF and not set_upper(s, r, _clipped(s.ub[a] + s.ub[b]), support):
            return False
        if s.lb[r] > -HALF_INF and not set_lower(s, b, _clipped(s.lb[r] - s.ub[a]), support):
            return False
    if s.lb[b] > -HALF_INF and s.ub[r] < HALF_INF and not set_upper(s, a, _clipped(s.ub[r] - s.lb[b]), support):
        return False
    if s.ub[b] < HALF_INF and s.lb[r] > -HALF_INF:
        return set_lower(s, a, _clipped(s.lb[r] - s.ub[b]), support)
    return True


def _within(s: Store, v: int, lo: int, hi: int, support: int) -> bool:
    """Narrow a discrete variable to an interval whose ends may be infinite."""
    if lo > -HALF_INF and not set_lower(s, v, lo, support):
        return False
    return hi >= HALF_INF or set_upper(s, v, hi, support)


def _multiply(s: Store, a: int, b: int, r: int, support: int) -> bool:
    """Narrow a * b = r, forwards by the four corners, backwards by dividing."""
    p = _product(s.lb[a], s.lb[b])
    q = _product(s.lb[a], s.ub[b])
    x = _product(s.ub[a], s.lb[b])
    y = _product(s.ub[a], s.ub[b])
    if not _within(s, r, min(min(p, q), min(x, y)), max(max(p, q), max(x, y)), support):
        return False
    return _divide(s, r, b, a, support) and _divide(s, r, a, b, support)


def _divide(s: Store, r: int, b: int, a: int, support: int) -> bool:
    """Narrow a, where a * b = r."""
    lo = s.lb[b]
    hi = s.ub[b]
    if s.lb[r] > 0 or s.ub[r] < 0:
        if not remove_value(s, b, 0, support):
            return False
        lo = s.lb[b]
        hi = s.ub[b]
        if lo < 0 < hi:
            # b is at least 1 away from 0, so a is no larger than r.
            x = max(-s.lb[r], s.ub[r])
            return _within(s, a, -x, x, support)
    elif lo <= 0 <= hi:
        return True
    return _divide_apart(s, r, lo, hi, a, support)


def _divide_apart(s: Store, r: int, lo: int, hi: int, a: int, support: int) -> bool:
    """Narrow a, where a * b = r and b lies within lo and hi, on one side of 0."""
    # The extremes stand at the ends of b; a bound of r that is infinite says nothing about its side.
    least = s.lb[r]
    most = s.ub[r]
    if hi < 0:
        least, most = -most, -least
        lo, hi = -hi, -lo
    if least > -HALF_INF:
        x = _ceiling_of(least, lo if least < 0 else hi) if hi < HALF_INF or least < 0 else (1 if least > 0 else 0)
        if not set_lower(s, a, _clipped(x), support):
            return False
    if most < HALF_INF:
        x = _floor_of(most, lo if most > 0 else hi) if hi < HALF_INF or most > 0 else (-1 if most < 0 else 0)
        return set_upper(s, a, _clipped(x), support)
    return True


def _add_all(s: Store, first: int, count: int, support: int) -> bool:
    """Narrow x1 + x2 + ... = r; r stands first. One pass over the sums of all bounds, O(count)."""
    r = s.slot_variable[first]
    least = 0
    most = 0
    open_below = 0
    open_above = 0
    for k in range(first + 1, first + count):
        v = s.slot_variable[k]
        if s.lb[v] <= -HALF_INF:
            open_below += 1
        else:
            least += s.lb[v]
        if s.ub[v] >= HALF_INF:
            open_above += 1
        else:
            most += s.ub[v]
    if open_below == 0 and not set_lower(s, r, _clipped(least), support):
        return False
    if open_above == 0 and not set_upper(s, r, _clipped(most), support):
        return False
    for k in range(first + 1, first + count):
        v = s.slot_variable[k]
        lo = s.lb[v]
        hi = s.ub[v]
        if s.ub[r] < HALF_INF and open_below - (1 if lo <= -HALF_INF else 0) == 0:
            x = s.ub[r] - (least if lo <= -HALF_INF else least - lo)
            if not set_upper(s, v, _clipped(x), support):
                return False
        if s.lb[r] > -HALF_INF and open_above - (1 if hi >= HALF_INF else 0) == 0:
            x = s.lb[r] - (most if hi >= HALF_INF else most - hi)
            if not set_lower(s, v, _clipped(x), support):
                return False
        # Later terms use the sums of before: still sound, and the constraint runs again if one has changed.
    return True


def _multiply_all(s: Store, first: int, count: int, support: int) -> bool:
    """Narrow x1 * x2 * ... = r; r stands first. Each factor is divided out of r, O(count^2)."""
    r = s.slot_variable[first]
    for skip in range(count):
        lo = 1
        hi = 1
        for k in range(1, count):
            if k != skip:
                v = s.slot_variable[first + k]
                p = _product(lo, s.lb[v])
                q = _product(lo, s.ub[v])
                x = _product(hi, s.lb[v])
                y = _product(hi, s.ub[v])
                lo = min(min(p, q), min(x, y))
                hi = max(max(p, q), max(x, y))
        if skip == 0:
            if not _within(s, r, lo, hi, support):
                return False
        elif lo > 0 or hi < 0:
            if not _divide_apart(s, r, lo, hi, s.slot_variable[first + skip], support):
                return False
        elif s.lb[r] > 0 or s.ub[r] < 0:
            x = max(-s.lb[r], s.ub[r])
            if not _within(s, s.slot_variable[first + skip], -x, x, support):
                return False
    return True


def _hold_extreme(s: Store, first: int, count: int, is_most: bool, support: int) -> bool:
    """Narrow max(x1, x2, ...) = r, or the minimum; r stands first."""
    r = s.slot_variable[first]
    lo = -INF if is_most else INF
    hi = lo
    for k in range(first + 1, first + count):
        v = s.slot_variable[k]
        lo = max(lo, s.lb[v]) if is_most else min(lo, s.lb[v])
        hi = max(hi, s.ub[v]) if is_most else min(hi, s.ub[v])
    if not (set_lower(s, r, lo, support) and set_upper(s, r, hi, support)):
        return False
    able = -1
    for k in range(first + 1, first + count):
        v = s.slot_variable[k]
        if not (set_upper(s, v, s.ub[r], support) if is_most else set_lower(s, v, s.lb[r], support)):
            return False
        if s.ub[v] >= s.lb[r] if is_most else s.lb[v] <= s.ub[r]:
            able = v if able == -1 else -2
    # Only one of them can reach the extreme: it must.
    if able < 0:
        return True
    return set_lower(s, able, s.lb[r], support) if is_most else set_upper(s, able, s.ub[r], support)
