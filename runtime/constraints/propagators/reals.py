"""Propagate arithmetic in which a float takes part: intervals of doubles, rounded outward so that no solution is lost.

A sum or product that is exact in doubles stays as it is; any other bound is widened by one unit in the last place. What
follows from values that are known is one value too, the nearest double: it is within the tolerance of all that it might
be, and what has happened in a mission is a value, however long the chain that led to it.
"""

import math
from math import inf

from runtime.constraints.domains.narrow import high, is_single, low, raise_to, reduce_to, remove_value
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import FLOAT_TOLERANCE, KIND_FLOAT, SIDE_HOLES, SUPPORT_CONSTRAINT, ULP
from runtime.constraints.propagators.opcodes import (
    OP_ABS_VAL,
    OP_ADD_EQ,
    OP_CALC_DISTANCE,
    OP_DIFF_SQUARE,
    OP_DISTANCE_SQUARES,
    OP_DIV_EQ,
    OP_EQ_MAXIMUM,
    OP_EQ_MINIMUM,
    OP_EQ_PRODUCT,
    OP_EQ_SUM,
    OP_MUL_EQ,
    OP_NEG,
)

_TINY = 5e-324


def propagate_reals(s: Store, c: int) -> bool:
    """Run an arithmetic constraint in which a float takes part; absolute values and negation of any numbers."""
    op = s.op[c]
    first = s.first[c]
    a = s.slot_variable[first]
    b = s.slot_variable[first + 1]
    support = c * 4 + SUPPORT_CONSTRAINT
    if op == OP_ADD_EQ:
        return _add(s, a, b, s.slot_variable[first + 2], support)
    if op == OP_MUL_EQ:
        return _multiply(s, a, b, s.slot_variable[first + 2], support)
    if op == OP_DIV_EQ:
        return _divide_by(s, a, b, s.slot_variable[first + 2], support)
    if op == OP_EQ_SUM:
        return _add_all(s, first, s.arity[c], support)
    if op == OP_EQ_PRODUCT:
        return _multiply_all(s, first, s.arity[c], support)
    if op == OP_EQ_MAXIMUM or op == OP_EQ_MINIMUM:
        return hold_extreme(s, first, s.arity[c], 1.0 if op == OP_EQ_MAXIMUM else -1.0, support)
    if op == OP_ABS_VAL:
        return hold_absolute(s, a, b, support)
    if op == OP_NEG:
        if not (raise_to(s, a, -high(s, b), support) and reduce_to(s, a, -low(s, b), support)):
            return False
        return raise_to(s, b, -high(s, a), support) and reduce_to(s, b, -low(s, a), support)
    if op == OP_DIFF_SQUARE:
        return _square_difference(s, a, b, s.slot_variable[first + 2], support)
    if op == OP_DISTANCE_SQUARES:
        return _root_of_sum(s, a, b, s.slot_variable[first + 2], support)
    assert op == OP_CALC_DISTANCE
    return _measure_distance(s, first, support)


def lower_sum(x: float, y: float) -> float:
    """Add, rounding down: Knuth's two-sum tells whether the double nearest to the sum lies above it."""
    z = x + y
    if z == inf or z == -inf:
        return -inf if x == -inf or y == -inf or z == -inf else z
    t = z - x
    if (x - (z - t)) + (y - t) < 0.0:
        return z - abs(z) * ULP - _TINY
    return z


def upper_sum(x: float, y: float) -> float:
    """Add, rounding up."""
    return -lower_sum(-x, -y)


def product(x: float, y: float) -> float:
    """Multiply; infinity times 0 is 0, as the limit of a finite bound."""
    if x == 0.0 or y == 0.0:
        return 0.0
    return x * y


def is_exact(x: float) -> bool:
    """Tell whether a double is a small enough whole number (or half, quarter ...) that products of two are exact."""
    x *= 1024.0
    return -67108864.0 < x < 67108864.0 and x == math.floor(x)


def down(x: float) -> float:
    """Step at least one unit in the last place down."""
    return x - abs(x) * ULP - _TINY if -inf < x < inf else x


def up(x: float) -> float:
    """Step at least one unit in the last place up."""
    return x + abs(x) * ULP + _TINY if -inf < x < inf else x


def within(s: Store, v: int, lo: float, hi: float, support: int) -> bool:
    """Narrow any variable to an interval."""
    return raise_to(s, v, lo, support) and reduce_to(s, v, hi, support)


def _add(s: Store, a: int, b: int, r: int, support: int) -> bool:
    """Narrow a + b = r."""
    if _is_known(s, a) and _is_known(s, b):
        x = low(s, a) + low(s, b)
        return within(s, r, x, x, support)
    if _is_known(s, r) and _is_known(s, a):
        x = low(s, r) - low(s, a)
        return within(s, b, x, x, support)
    if _is_known(s, r) and _is_known(s, b):
        x = low(s, r) - low(s, b)
        return within(s, a, x, x, support)
    if not within(s, r, lower_sum(low(s, a), low(s, b)), upper_sum(high(s, a), high(s, b)), support):
        return False
    if not within(s, a, lower_sum(low(s, r), -high(s, b)), upper_sum(high(s, r), -low(s, b)), support):
        return False
    return within(s, b, lower_sum(low(s, r), -high(s, a)), upper_sum(high(s, r), -low(s, a)), support)


def _multiply(s: Store, a: int, b: int, r: int, support: int) -> bool:
    """Narrow a * b = r."""
    if _is_known(s, a) and _is_known(s, b):
        p = low(s, a) * low(s, b)
        return within(s, r, p, p, support)
    lo = low(s, a)
    hi = high(s, a)
    p = product(lo, low(s, b))
    q = product(lo, high(s, b))
    x = product(hi, low(s, b))
    y = product(hi, high(s, b))
    least = min(min(p, q), min(x, y))
    most = max(max(p, q), max(x, y))
    if not (is_exact(lo) and is_exact(hi) and is_exact(low(s, b)) and is_exact(high(s, b))):
        least = down(least)
        most = up(most)
    if not within(s, r, least, most, support):
        return False
    # A float that is known is not narrowed by a quotient, which makes more of what cancelled out than the product does.
    if not (_is_known(s, a) or _divide(s, r, low(s, b), high(s, b), a, support)):
        return False
    return _is_known(s, b) or _divide(s, r, low(s, a), high(s, a), b, support)


def _is_known(s: Store, v: int) -> bool:
    """Tell whether v has one value, to the last bit."""
    return low(s, v) == high(s, v)


def _divide(s: Store, r: int, lo: float, hi: float, a: int, support: int) -> bool:
    """Narrow a, where a * b = r and b lies within lo and hi."""
    least = low(s, r)
    most = high(s, r)
    if least == most and lo == hi and lo != 0.0:
        x = least / lo
        return within(s, a, x, x, support)
    # A product within the tolerance of 0 may be 0, whatever the other factor is.
    if lo <= 0.0 <= hi:
        if least <= FLOAT_TOLERANCE and most >= -FLOAT_TOLERANCE:
            return True
        if lo < 0.0 < hi:
            return True
    if hi <= 0.0:
        least, most = -most, -least
        lo, hi = -hi, -lo
    if least > -inf:
        x = least / hi if least > 0.0 else (least / lo if lo > 0.0 else (0.0 if least == 0.0 else -inf))
        if not raise_to(s, a, down(x), support):
            return False
    if most < inf:
        x = most / hi if most < 0.0 else (most / lo if lo > 0.0 else (0.0 if most == 0.0 else inf))
        return reduce_to(s, a, up(x), support)
    return True


def _divide_by(s: Store, a: int, b: int, q: int, support: int) -> bool:
    """Narrow a / b = q."""
    if s.kind[b] != KIND_FLOAT:
        if not remove_value(s, b, 0, support):
            return False
    elif s.flo[b] == 0.0 and s.fhi[b] == 0.0:
        return s.fail(b, SIDE_HOLES, support)
    if not _divide(s, a, low(s, b), high(s, b), q, support):
        return False
    return (_is_known(s, a) and _is_known(s, b)) or _multiply(s, q, b, a, support)


def _add_all(s: Store, first: int, count: int, support: int) -> bool:
    """Narrow x1 + x2 + ... = r; r stands first. Each term is taken out of r by the sum of the others, O(count^2)."""
    for skip in range(count):
        lo = 0.0
        hi = 0.0
        for k in range(1, count):
            if k != skip:
                v = s.slot_variable[first + k]
                lo = lower_sum(lo, low(s, v))
                hi = upper_sum(hi, high(s, v))
        v = s.slot_variable[first]
        if skip:
            least = lo
            lo = lower_sum(low(s, v), -hi)
            hi = upper_sum(high(s, v), -least)
        if not within(s, s.slot_variable[first + skip], lo, hi, support):
            return False
    return True


def _multiply_all(s: Store, first: int, count: int, support: int) -> bool:
    """Narrow x1 * x2 * ... = r; r stands first, O(count^2)."""
    for skip in range(count):
        lo = 1.0
        hi = 1.0
        for k in range(1, count):
            if k != skip:
                v = s.slot_variable[first + k]
                p = product(lo, low(s, v))
                q = product(lo, high(s, v))
                x = product(hi, low(s, v))
                y = product(hi, high(s, v))
                exact = is_exact(lo) and is_exact(hi) and is_exact(low(s, v)) and is_exact(high(s, v))
                lo = min(min(p, q), min(x, y))
                hi = max(max(p, q), max(x, y))
                # A bound of 0 comes from a factor of 0: it is exact.
                if not exact:
                    lo = down(lo) if lo != 0.0 else lo
                    hi = up(hi) if hi != 0.0 else hi
        if skip:
            if not _divide(s, s.slot_variable[first], lo, hi, s.slot_variable[first + skip], support):
                return False
        elif not within(s, s.slot_variable[first], lo, hi, support):
            return False
    return True


def _top(s: Store, v: int, sign: float) -> float:
    """Give the upper bound of v, or of -v for the sign -1."""
    return high(s, v) if sign > 0.0 else -low(s, v)


def _bottom(s: Store, v: int, sign: float) -> float:
    """Give the lower bound of v, or of -v for the sign -1."""
    return low(s, v) if sign > 0.0 else -high(s, v)


def _press(s: Store, v: int, hi: float, sign: float, support: int) -> bool:
    """Reduce the upper bound of v, or of -v for the sign -1."""
    return reduce_to(s, v, hi, support) if sign > 0.0 else raise_to(s, v, -hi, support)


def _lift(s: Store, v: int, lo: float, sign: float, support: int) -> bool:
    """Raise the lower bound of v, or of -v for the sign -1."""
    return raise_to(s, v, lo, support) if sign > 0.0 else reduce_to(s, v, -lo, support)


def hold_extreme(s: Store, first: int, count: int, sign: float, support: int) -> bool:
    """Narrow max(x1, x2, ...) = r, or the minimum for the sign -1; r stands first."""
    r = s.slot_variable[first]
    lo = -inf
    hi = -inf
    for k in range(first + 1, first + count):
        lo = max(lo, _bottom(s, s.slot_variable[k], sign))
        hi = max(hi, _top(s, s.slot_variable[k], sign))
    if not (_lift(s, r, lo, sign, support) and _press(s, r, hi, sign, support)):
        return False
    able = -1
    for k in range(first + 1, first + count):
        v = s.slot_variable[k]
        if not _press(s, v, _top(s, r, sign), sign, support):
            return False
        if _top(s, v, sign) >= _bottom(s, r, sign) - FLOAT_TOLERANCE:
            able = v if able == -1 else -2
    return able < 0 or _lift(s, able, _bottom(s, r, sign), sign, support)


def hold_absolute(s: Store, r: int, x: int, support: int) -> bool:
    """Narrow |x| = r."""
    if not raise_to(s, r, 0.0, support):
        return False
    lo = low(s, x)
    hi = high(s, x)
    least = lo if lo > 0.0 else -hi if hi < 0.0 else 0.0
    if not within(s, r, least, max(-lo, hi), support):
        return False
    if not within(s, x, -high(s, r), high(s, r), support):
        return False
    if low(s, x) > -low(s, r) + FLOAT_TOLERANCE and not raise_to(s, x, low(s, r), support):
        return False
    return high(s, x) >= low(s, r) - FLOAT_TOLERANCE or reduce_to(s, x, -low(s, r), support)


def _square_difference(s: Store, a: int, b: int, r: int, support: int) -> bool:
    """Narrow (a - b)^2 = r."""
    lo = lower_sum(low(s, a), -high(s, b))
    hi = upper_sum(high(s, a), -low(s, b))
    most = max(-lo, hi)
    least = lo if lo > 0.0 else -hi if hi < 0.0 else 0.0
    exact = is_exact(least) and is_exact(most)
    least = least * least
    most = most * most
    if not within(s, r, least if exact else down(least), most if exact else up(most), support):
        return False
    if high(s, r) == inf or high(s, r) < 0.0:
        return True
    most = up(up(math.sqrt(high(s, r))))
    if not within(s, a, lower_sum(low(s, b), -most), upper_sum(high(s, b), most), support):
        return False
    return within(s, b, lower_sum(low(s, a), -most), upper_sum(high(s, a), most), support)


def _root_of_sum(s: Store, a: int, b: int, r: int, support: int) -> bool:
    """Set r to the root of a + b, once both are known."""
    if not (is_single(s, a) and is_single(s, b)):
        return True
    x = low(s, a) + low(s, b)
    if x < 0.0:
        return x > -FLOAT_TOLERANCE or s.fail(r, SIDE_HOLES, support)
    x = math.sqrt(x)
    return within(s, r, x, x, support)


def _gap(least: float, most: float) -> float:
    """Give the smallest absolute value between two bounds."""
    return least if least > 0.0 else -most if most < 0.0 else 0.0


def _measure_distance(s: Store, first: int, support: int) -> bool:
    """Narrow d to the possible distances of two points."""
    x = s.slot_variable[first + 1]
    y = s.slot_variable[first + 2]
    u = s.slot_variable[first + 3]
    v = s.slot_variable[first + 4]
    if _is_known(s, x) and _is_known(s, y) and _is_known(s, u) and _is_known(s, v):
        p = low(s, x) - low(s, u)
        q = low(s, y) - low(s, v)
        least = math.sqrt(p * p + q * q)
        return within(s, s.slot_variable[first], least, least, support)
    left = low(s, x) - high(s, u)
    right = high(s, x) - low(s, u)
    under = low(s, y) - high(s, v)
    over = high(s, y) - low(s, v)
    p = _gap(left, right)
    q = _gap(under, over)
    least = math.sqrt(p * p + q * q)
    p = max(-left, right)
    q = max(-under, over)
    most = math.sqrt(p * p + q * q)
    if not (is_exact(least) and is_exact(most)):
        least = max(0.0, down(down(least)))
        most = up(up(most))
    return within(s, s.slot_variable[first], least, most, support)
