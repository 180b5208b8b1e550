"""Propagate what T-REX and its users add: angles, roots, dates, positions on the earth.

Angles, roots, exponentials and extremes narrow both ways; dates, distances and displacements act once their inputs are
known. Tolerances: results of trigonometry are widened by 1e-9, distances by 0.5 m, positions by 5e-7 degrees, and by
what is not known of the inputs.
"""

import math
from math import inf

from runtime.constraints.domains.narrow import high, low, raise_to, reduce_to
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import FLOAT_TOLERANCE, KIND_FLOAT, STRICT_STEP, SUPPORT_CONSTRAINT
from runtime.constraints.propagators.earth import date_of_tick, displaced, displacement, great_circle, tick_of_date
from runtime.constraints.propagators.functions import are_known, half_width, middle, rounded, sine, whole
from runtime.constraints.propagators.opcodes import (
    OP_ABSF,
    OP_CEILF,
    OP_CIRCLE_MOD,
    OP_COSF,
    OP_DEG_TO_RAD,
    OP_EXPF,
    OP_FLOORF,
    OP_LL_DIST,
    OP_LOGF,
    OP_MAXF,
    OP_MINF,
    OP_SIN,
    OP_SINF,
    OP_SQRTF,
    OP_TICK_DATE,
    OP_WGS_DISPLACE,
    OP_WGS_DISPLACEMENT,
)
from runtime.constraints.propagators.reals import down, hold_absolute, hold_extreme, up, within

_SLACK = 1e-9
_LEAST = 1.0  # what a number without a logarithm is narrowed to: nothing is left
_POSITION_TOLERANCE = 5e-7
_DISTANCE_TOLERANCE = 0.5
_DEGREE = math.pi / 180.0
_METRES_PER_DEGREE = 111700.0  # at most
_LEAST_METRES_PER_DEGREE = 110500.0  # along a meridian


def propagate_geodesy(s: Store, c: int) -> bool:
    """Run a constraint of this family."""
    op = s.op[c]
    first = s.first[c]
    r = s.slot_variable[first]
    x = s.slot_variable[first + 1]
    support = c * 4 + SUPPORT_CONSTRAINT
    if op == OP_MAXF or op == OP_MINF:
        return hold_extreme(s, first, s.arity[c], 1.0 if op == OP_MAXF else -1.0, support)
    if op == OP_SIN:
        if not within(s, x, -90.0, 90.0, support):
            return False
        return within(s, r, sine(low(s, x)) - _SLACK, sine(high(s, x)) + _SLACK, support)
    if op == OP_SINF:
        return _turn(s, r, x, 0.0, support)
    if op == OP_COSF:
        return _turn(s, r, x, 90.0, support)
    if op == OP_SQRTF:
        return _hold_root(s, r, x, support)
    if op == OP_ABSF:
        return hold_absolute(s, r, x, support)
    if op == OP_FLOORF or op == OP_CEILF:
        return _hold_rounded(s, r, x, op == OP_FLOORF, support)
    if op == OP_EXPF:
        return _hold_exponential(s, r, x, support)
    if op == OP_LOGF:
        if high(s, x) <= 0.0:  # within the tolerance of the exponential, but no logarithm
            return bool(raise_to(s, x, _LEAST, support))
        return _hold_exponential(s, x, r, support)
    if op == OP_DEG_TO_RAD:
        return _scale(s, r, x, _DEGREE, support)
    if op == OP_CIRCLE_MOD:
        return _bring_within_turn(s, r, x, support)
    if op == OP_TICK_DATE:
        return _relate_date(s, first, support)
    if op == OP_LL_DIST:
        return _measure(s, first, support)
    assert op == OP_WGS_DISPLACE or op == OP_WGS_DISPLACEMENT
    return _displace(s, first, op == OP_WGS_DISPLACE, support)


def _turn(s: Store, r: int, x: int, ahead: float, support: int) -> bool:
    """Narrow r = sin(x + ahead) in degrees, x within half a turn; backwards where the sine is monotone."""
    if not within(s, x, -180.0, 180.0, support):
        return False
    lo = low(s, x) + ahead
    hi = high(s, x) + ahead
    least = -1.0 if _passes(lo, hi, -90.0) else min(sine(lo), sine(hi)) - _SLACK
    most = 1.0 if _passes(lo, hi, 90.0) else max(sine(lo), sine(hi)) + _SLACK
    if not within(s, r, max(-1.0, least), min(1.0, most), support):
        return False
    # The half turn around `centre` in which x lies, if there is one: -180, 0 or 180, or none.
    centre = 180.0 * math.floor((lo + 90.0) / 180.0)
    if hi > centre + 90.0:
        return True
    sign = -1.0 if math.fmod(centre, 360.0) != 0.0 else 1.0
    # The sine is known to the tolerance only; near its extremes that is a wide range of angles.
    a = _angle_of(low(s, r) - FLOAT_TOLERANCE)
    b = _angle_of(high(s, r) + FLOAT_TOLERANCE)
    if sign < 0.0:
        a, b = -b, -a
    return within(s, x, centre + a - ahead - _SLACK, centre + b - ahead + _SLACK, support)


def _passes(lo: float, hi: float, peak: float) -> bool:
    """Tell whether an interval of degrees contains peak plus a multiple of a turn."""
    return peak + 360.0 * math.ceil((lo - peak) / 360.0) <= hi


def _angle_of(x: float) -> float:
    """Give the angle in degrees within a quarter turn whose sine is x."""
    return rounded(math.asin(min(max(x, -1.0), 1.0)) / _DEGREE)


def _hold_root(s: Store, r: int, x: int, support: int) -> bool:
    """Narrow r = sqrt(x)."""
    if not (raise_to(s, r, 0.0, support) and raise_to(s, x, 0.0, support)):
        return False
    lo = max(0.0, low(s, x))
    hi = high(s, x)
    root = math.sqrt(lo)
    if not raise_to(s, r, root if root * root == lo else down(root), support):
        return False
    if hi < inf:
        root = math.sqrt(max(0.0, hi))
        if not reduce_to(s, r, root if root * root == hi else up(root), support):
            return False
    # The result is known to the tolerance only, which its square magnifies.
    least = max(0.0, low(s, r) - FLOAT_TOLERANCE)
    most = high(s, r) + FLOAT_TOLERANCE
    return raise_to(s, x, down(least * least), support) and reduce_to(s, x, up(most * most), support)


def _hold_rounded(s: Store, r: int, x: int, is_down: bool, support: int) -> bool:
    """Narrow r = x rounded down, or up; x within the tolerance of a whole number counts as that number."""
    lo = low(s, x)
    hi = high(s, x)
    if lo > -inf and not raise_to(s, r, math.floor(lo) if is_down else math.ceil(lo - FLOAT_TOLERANCE), support):
        return False
    if hi < inf and not reduce_to(s, r, math.floor(hi + FLOAT_TOLERANCE) if is_down else math.ceil(hi), support):
        return False
    below = FLOAT_TOLERANCE if is_down else 1.0
    above = 1.0 if is_down else FLOAT_TOLERANCE
    return _be_whole(s, r, support) and within(s, x, low(s, r) - below, high(s, r) + above, support)


def _be_whole(s: Store, r: int, support: int) -> bool:
    """Move the bounds of r inwards to whole numbers."""
    if low(s, r) > -inf and not raise_to(s, r, math.ceil(low(s, r) - FLOAT_TOLERANCE), support):
        return False
    return high(s, r) == inf or reduce_to(s, r, math.floor(high(s, r) + FLOAT_TOLERANCE), support)


def _hold_exponential(s: Store, r: int, x: int, support: int) -> bool:
    """Narrow r = e to the power of x, both ways, to 12 digits."""
    if not within(s, r, _exponential(low(s, x), -1e-12), _exponential(high(s, x), 1e-12), support):
        return False
    lo = low(s, r) - FLOAT_TOLERANCE
    hi = high(s, r) + FLOAT_TOLERANCE
    if lo > 0.0 and not raise_to(s, x, rounded(math.log(lo)) - _SLACK, support):
        return False
    return hi <= 0.0 or hi == inf or reduce_to(s, x, rounded(math.log(hi)) + _SLACK, support)


def _exponential(x: float, slack: float) -> float:
    """Give e to the power of x, moved by a relative slack; 0 and infinity beyond the range of doubles."""
    if x > 700.0:
        return inf if slack > 0.0 else 1e304
    if x < -700.0:
        return 0.0 if slack < 0.0 else 1e-304
    return rounded(math.exp(x)) * (1.0 + slack)


def _scale(s: Store, r: int, x: int, factor: float, support: int) -> bool:
    """Narrow r = factor * x, for a positive factor."""
    if not within(s, r, down(low(s, x) * factor), up(high(s, x) * factor), support):
        return False
    return within(s, x, down(low(s, r) / factor), up(high(s, r) / factor), support)


def _bring_within_turn(s: Store, r: int, x: int, support: int) -> bool:
    """Narrow r = x less whole turns, within -180 (included) and 180 degrees (not included)."""
    if not within(s, r, -180.0, 180.0 - (STRICT_STEP if s.kind[r] == KIND_FLOAT else 1.0), support):
        return False
    lo = low(s, x)
    hi = high(s, x)
    if lo == -inf or hi == inf:
        return True
    turns = math.floor((lo + 180.0) / 360.0)
    if turns != math.floor((hi + 180.0) / 360.0):
        return True
    if not within(s, r, lo - 360.0 * turns - _SLACK, hi - 360.0 * turns + _SLACK, support):
        return False
    return within(s, x, low(s, r) + 360.0 * turns - _SLACK, high(s, r) + 360.0 * turns + _SLACK, support)


def _relate_date(s: Store, first: int, support: int) -> bool:
    """Relate a tick to the second of the day, the day of the year and the year, once one side is known."""
    tick = s.slot_variable[first]
    if are_known(s, first, first + 1):
        date = date_of_tick(whole(s, tick), s.tick_seconds, s.tick_epoch)
        for k in range(3):
            v = s.slot_variable[first + 1 + k]
            if not within(s, v, date[k], date[k], support):
                return False
        return True
    if not are_known(s, first + 1, first + 4):
        return True
    seconds = whole(s, s.slot_variable[first + 1])
    day = whole(s, s.slot_variable[first + 2])
    year = whole(s, s.slot_variable[first + 3])
    x = tick_of_date(seconds, int(day), int(year), s.tick_seconds, s.tick_epoch)
    return within(s, tick, x, x, support)


def _measure(s: Store, first: int, support: int) -> bool:
    """Set the distance of two known positions."""
    if not are_known(s, first + 1, first + 5):
        return True
    x = great_circle(
        middle(s, s.slot_variable[first + 1]),
        middle(s, s.slot_variable[first + 2]),
        middle(s, s.slot_variable[first + 3]),
        middle(s, s.slot_variable[first + 4]),
    )
    slack = _DISTANCE_TOLERANCE + _METRES_PER_DEGREE * _blur(s, first + 1, first + 5)
    return within(s, s.slot_variable[first], max(0.0, x - slack), x + slack, support)


def _blur(s: Store, first: int, last: int) -> float:
    """Add up how far the values of known variables may be from their middles."""
    total = 0.0
    for k in range(first, last):
        total += half_width(s, s.slot_variable[k])
    return total


def _displace(s: Store, first: int, is_position: bool, support: int) -> bool:
    """Set the position that lies north and east of a known one, or the way between two known ones."""
    if not are_known(s, first, first + 4):
        return True
    lat = middle(s, s.slot_variable[first])
    lon = middle(s, s.slot_variable[first + 1])
    x = middle(s, s.slot_variable[first + 2])
    y = middle(s, s.slot_variable[first + 3])
    found = displaced(lat, lon, x, y) if is_position else displacement(lat, lon, x, y)
    slack = _DISTANCE_TOLERANCE + _METRES_PER_DEGREE * _blur(s, first, first + 4)
    if is_position:
        # A degree of longitude is shorter away from the equator, so what is not known grows with it.
        slack = 2.0 * _blur(s, first, first + 2) + _blur(s, first + 2, first + 4) / _LEAST_METRES_PER_DEGREE
        slack = _POSITION_TOLERANCE + 1.0 / max(0.01, math.cos(lat * _DEGREE)) * slack
    for k in range(2):  # noqa: SIM110 (a generator cannot be compiled here)
        if not within(s, s.slot_variable[first + 4 + k], found[k] - slack, found[k] + slack, support):
            return False
    return True
