"""Interval arithmetic of reals, rounded outward: pairs of bounds in, bounds of all results out."""

import math
import sys
from math import inf

from runtime.constraints.propagators.functions import sine as sine_of
from runtime.constraints.propagators.reals import product

Interval = tuple[float, float]

_LAST = sys.float_info.max
ROUGH = 1e-9  # more than sums, products, powers and sines of doubles are wrong by, relatively


def outward(lo: float, hi: float) -> Interval:
    """Widen by what computing may have cost; what lies beyond the doubles lies beyond the last of them at least."""
    lo, hi = min(lo, _LAST), max(hi, -_LAST)
    return lo - abs(lo) * ROUGH - ROUGH if lo > -inf else lo, hi + abs(hi) * ROUGH + ROUGH if hi < inf else hi


def added(x: Interval, y: Interval) -> Interval:
    """Give the interval of x + y."""
    return outward(x[0] + y[0], x[1] + y[1])


def taken(x: Interval, y: Interval) -> Interval:
    """Give the interval of x - y."""
    return outward(x[0] - y[1], x[1] - y[0])


def multiplied(x: Interval, y: Interval) -> Interval:
    """Give the interval of x * y."""
    corners = [product(a, b) for a in x for b in y]
    return outward(min(corners), max(corners))


def magnitude(x: Interval) -> Interval:
    """Give the interval of |x|."""
    return max(0.0, x[0], -x[1]), max(-x[0], x[1])


def sine(x: Interval) -> Interval:
    """Give the interval of the sine of degrees."""
    lo, hi = x
    if not hi - lo < 360.0:
        return -1.0, 1.0
    ends = [sine_of(a) for a in x]
    has_peak = 90.0 + 360.0 * math.ceil((lo - 90.0 - ROUGH) / 360.0) <= hi + ROUGH
    has_trough = -90.0 + 360.0 * math.ceil((lo + 90.0 - ROUGH) / 360.0) <= hi + ROUGH
    least, most = outward(min(ends), max(ends))
    return -1.0 if has_trough else max(-1.0, least), 1.0 if has_peak else min(1.0, most)


def cosine(x: Interval) -> Interval:
    """Give the interval of the cosine of degrees."""
    return sine((x[0] + 90.0, x[1] + 90.0))


def whole(x: Interval) -> Interval:
    """Move bounds inwards to whole numbers, where they are finite."""
    lo, hi = x
    return math.ceil(lo) if abs(lo) < inf else lo, math.floor(hi) if abs(hi) < inf else hi


def raised(x: float, y: float) -> float:
    """Raise a number that is not negative to a power; infinity where doubles end."""
    if x == 0.0:
        return inf if y < 0.0 else 1.0 if y == 0.0 else 0.0
    if x == inf:
        return inf if y > 0.0 else 1.0 if y == 0.0 else 0.0
    exponent = product(y, math.log(x))
    return math.exp(exponent) if exponent < 709.0 else inf
