"""Relations: what functions demand of intervals, for those that EUROPA evaluates only on known arguments.

The engine lets these wait, as EUROPA does, and computes them forward (`functions`, `reals`). Whether a set of
constraints contradicts itself does not depend on what is known, so a relational engine, in which explanations are
minimised, narrows their intervals at once, both ways where that is simple, with the tolerance of values on top.
Forward images of known arguments stay apart: they give one value, rounded as EUROPA rounds it, and not an interval.
"""

import math
from math import inf

from runtime.constraints.domains.tags import FLOAT_TOLERANCE
from runtime.constraints.propagators.arguments import Arguments, tolerant
from runtime.constraints.propagators.intervals import Interval, magnitude, outward, raised, whole
from runtime.constraints.propagators.reals import down, is_exact, lower_sum, product, up, upper_sum

_HAIR = 1e-9  # a way of so little more than whole ticks takes no further one
_Pairs = tuple[tuple[int, int], ...]  # of the coordinates of two points, by index


def square_difference(row: Arguments) -> bool:
    """Narrow: a, b, (a - b)^2, which is a square number where a and b are whole."""
    if not (row.is_whole(0) and row.is_whole(1)):
        return True
    return row.keep(2, *_square_numbers(tolerant(row.bounds(2))))


def _square_numbers(bounds: Interval) -> Interval:
    """Give the least and the greatest square number between two bounds, where there are such."""
    lo, hi = bounds
    least = math.ceil(math.sqrt(lo) - _HAIR) ** 2 if 0.0 < lo < inf else lo if lo == inf else -inf
    return least, math.floor(math.sqrt(hi) + _HAIR) ** 2 if 0.0 <= hi < inf else hi


def distance(row: Arguments) -> bool:
    """Narrow: distance, x1, y1, x2, y2."""
    pairs = ((1, 3), (2, 4))
    return row.keep(0, *_length(row, pairs)) and _keep_length(row, pairs, tolerant(row.bounds(0)))


def _squares(row: Arguments, pairs: _Pairs) -> list[Interval]:
    """Bound the squared differences of coordinates, exactly where they are exact in doubles."""
    found = []
    for i, j in pairs:
        a, b = row.bounds(i), row.bounds(j)
        least, most = magnitude((lower_sum(a[0], -b[1]), upper_sum(a[1], -b[0])))
        is_precise = is_exact(least) and is_exact(most)
        least, most = least * least, most * most
        found.append((least, most) if is_precise else (max(0.0, down(least)), up(most)))
    return found


def _root(x: Interval) -> Interval:
    """Give the interval of the square root."""
    lo, hi = (math.sqrt(max(0.0, a)) for a in x)
    return lo if lo * lo == x[0] else max(0.0, down(lo)), hi if hi * hi == x[1] else up(hi)


def _length(row: Arguments, pairs: _Pairs) -> Interval:
    """Bound the distance of two points."""
    (least, most), *others = _squares(row, pairs)
    for lo, hi in others:
        least, most = lower_sum(least, lo), upper_sum(most, hi)
    return _root((least, most))


def _keep_length(row: Arguments, pairs: _Pairs, length: Interval) -> bool:
    """Narrow the coordinates of two points whose distance lies between two bounds."""
    squares = _squares(row, pairs)
    are_whole = [row.is_whole(i) and row.is_whole(j) for i, j in pairs]
    least, most = max(0.0, length[0]), length[1]
    if most < 0.0:
        return row.refuse()
    total = (down(least * least), up(most * most))
    if all(are_whole):
        total = whole(total)
    for k in (0, 1, 0):
        other = squares[1 - k]
        room = lower_sum(total[0], -other[1]), upper_sum(total[1], -other[0])
        if are_whole[k]:
            room = _square_numbers((room[0], room[1] + FLOAT_TOLERANCE))
        squares[k] = max(squares[k][0], room[0]), min(squares[k][1], room[1])
        if squares[k][0] > squares[k][1] + FLOAT_TOLERANCE:
            return row.refuse()
    for (i, j), square in zip(pairs, squares, strict=True):
        apart = up(math.sqrt(max(0.0, square[1])))
        for k, other in ((i, row.bounds(j)), (j, row.bounds(i))):
            if not row.keep(k, other[0] - apart, other[1] + apart):
                return False
    return True


def root_of_sum(row: Arguments) -> bool:
    """Narrow: a, b, the root of a + b."""
    a, b = row.bounds(0), row.bounds(1)
    total = max(0.0, lower_sum(a[0], b[0])), upper_sum(a[1], b[1])
    if total[1] < 0.0:
        return row.refuse()
    if not row.keep(2, *_root(total)):
        return False
    least, most = tolerant(row.bounds(2))
    least = min(max(0.0, least), 1e154)  # the square of what is greater is no double
    total = max(total[0], down(least * least)), min(total[1], up(most * most))
    if row.is_whole(0) and row.is_whole(1):
        total = whole(total)
    if total[0] > total[1]:
        return row.refuse()
    if not row.keep(0, lower_sum(total[0], -b[1]), upper_sum(total[1], -b[0])):
        return False
    a = row.bounds(0)
    return row.keep(1, lower_sum(total[0], -a[1]), upper_sum(total[1], -a[0]))


def power(row: Arguments) -> bool:
    """Narrow: result, base, exponent."""
    x, y = row.bounds(1), row.bounds(2)
    if row.is_whole(1) and row.is_whole(2) and not _power_of_whole(row, y[0]):
        return False
    if y[0] == y[1]:
        return _known_power(row, y[0])
    corners = [raised(a, b) for a in magnitude(x) for b in (*y, max(y[0], min(y[1], 0.0)))]
    least, most = outward(min(corners), max(corners))
    if not row.keep(0, -most if x[0] < 0.0 else 0.0, most) or not row.keep_away(0, least):
        return False
    return _keep_exponent(row, magnitude(x), magnitude(tolerant(row.bounds(0))))


def _power_of_whole(row: Arguments, y: float) -> bool:
    """Narrow: the result of whole numbers is a whole number, or one over such; the least exponent is y."""
    lo, hi = tolerant(row.bounds(0))
    if y >= 0.0:
        return row.keep_whole(0)
    if hi - lo > 3.0 * FLOAT_TOLERANCE or math.floor(hi) >= lo:
        return True
    return 1.0 // lo >= 1.0 / hi or row.refuse()


def _keep_exponent(row: Arguments, x: Interval, result: Interval) -> bool:
    """Narrow the exponent, from what base and result are without their signs, where the base is on one side of 1."""
    if not (x[0] > 1.0 or 0.0 < x[0] <= x[1] < 1.0):
        return True
    logarithms = [math.log(a) if a > 0.0 else -inf for a in result]
    scale = [math.log(a) if a < inf else inf for a in x]
    corners = [a / b if abs(b) < inf else 0.0 for a in logarithms for b in scale]
    return row.keep(2, *outward(min(corners), max(corners)))


def _known_power(row: Arguments, y: float) -> bool:
    """Narrow: result, base, to a known exponent."""
    if y == 0.0:
        return row.keep(0, 1.0, 1.0)
    if y < 0.0 and not row.keep_off_zero(1):
        return False
    is_even = y == 2.0 * math.floor(y / 2.0)
    is_odd = not is_even and y == math.floor(y)
    if not (is_even or is_odd) and not row.keep(1, 0.0, inf):
        return False
    x = row.bounds(1)
    if is_odd and x[0] < 0.0:
        return _odd_power(row, x, y)
    ends = [raised(a, y) for a in magnitude(x)]
    if not row.keep(0, *outward(min(ends), max(ends))):
        return False
    result = row.bounds(0)
    roots = [raised(max(0.0, a), 1.0 / y) for a in (result[0] - FLOAT_TOLERANCE, result[1] + FLOAT_TOLERANCE)]
    least, most = outward(min(roots), max(roots))
    return row.keep(1, -most, most) and (least <= 0.0 or row.keep_away(1, least - FLOAT_TOLERANCE))


def _odd_power(row: Arguments, x: Interval, y: float) -> bool:
    """Narrow: result, base, to an odd exponent, where the base may be negative."""

    def signed(a: float, exponent: float) -> float:
        return math.copysign(raised(abs(a), exponent), a)

    if y > 0.0:
        result = row.bounds(0)
        if not row.keep(0, *outward(signed(x[0], y), signed(x[1], y))):
            return False
        result = row.bounds(0)
        return row.keep(1, *outward(*(signed(a, 1.0 / y) for a in tolerant(result))))
    if x[1] > 0.0:
        return True
    return row.keep(0, *outward(-raised(-x[1], y), -raised(-x[0], y)))


def remainder(row: Arguments) -> bool:
    """Narrow: rest, dividend, divisor; the rest has the sign of its dividend."""
    if not row.keep_off_zero(2):
        return False
    x, y = row.bounds(1), row.bounds(2)
    is_whole = row.is_whole(1) and row.is_whole(2)
    if is_whole and not row.keep_whole(0):
        return False
    most = min(magnitude(x)[1], magnitude(y)[1] - (1.0 if is_whole else 0.0))
    if not row.keep(0, -most if x[0] < 0.0 else 0.0, most if x[1] > 0.0 else 0.0):
        return False
    rest = tolerant(row.bounds(0))
    if (rest[0] > 0.0 and not row.keep(1, rest[0], inf)) or (rest[1] < 0.0 and not row.keep(1, -inf, rest[1])):
        return False
    least = magnitude(rest)[0]
    if least > 0.0 and not row.keep_away(2, least):
        return False
    if magnitude(x)[1] < magnitude(y)[0]:
        return row.keep(0, *x) and row.keep(1, *rest)
    if y[0] < y[1] or magnitude(x)[1] == inf:
        return True
    ends = [math.fmod(a, y[0]) for a in x]
    turns = [(a - end) / y[0] for a, end in zip(x, ends, strict=True)]
    if max(map(abs, turns)) == inf:
        return True
    turns = [round(turn) for turn in turns]
    return turns[0] != turns[1] or row.keep(0, *outward(*ends))


def travel_time(row: Arguments) -> bool:
    """Narrow: ticks, the coordinates of two points, speed; whoever stands still gets nowhere."""
    pairs = ((1, 3), (2, 4))
    if not (row.keep_whole(0) and row.keep(0, 1.0, inf)):
        return False
    distance, speed = _length(row, pairs), row.bounds(5)
    if speed[1] <= 0.0:
        return row.keep(0, 1.0, 1.0) and _keep_length(row, pairs, tolerant((0.0, 0.0)))
    quickest, slowest = outward(
        distance[0] / speed[1] if speed[1] < inf else 0.0,
        distance[1] / speed[0] if speed[0] > 0.0 and distance[1] < inf else inf,
    )
    if not row.keep(0, whole((quickest - _HAIR, inf))[0], inf):
        return False
    if slowest < inf and not row.keep(0, -inf, max(1.0, math.ceil(slowest))):
        return False
    ticks = tolerant(row.bounds(0))
    farthest = outward(0.0, product(ticks[1], speed[1]))[1] + FLOAT_TOLERANCE
    if distance[0] > FLOAT_TOLERANCE and ticks[1] < inf:
        if not row.keep(5, outward(distance[0] / ticks[1], inf)[0], inf):
            return False
    before = math.floor(ticks[0] + 2.0 * FLOAT_TOLERANCE) - 1.0
    nearest = 0.0
    if before >= 1.0:
        nearest = outward(before * max(0.0, speed[0]), inf)[0] - FLOAT_TOLERANCE
        distance = max(distance[0], nearest), min(distance[1], farthest)
        if distance[1] < inf and not row.keep(5, 0.0, outward(0.0, distance[1] / before)[1]):
            return False
    return _keep_length(row, pairs, tolerant((nearest, farthest)))


def unit_vector(row: Arguments) -> bool:
    """Narrow: the unit vector between two points, (0, 0) where they coincide; the coordinates of the points."""
    pairs = ((2, 4), (3, 5))
    distance = _length(row, pairs)
    for k, (i, j) in enumerate(pairs):
        share = _keep_share(row, k, i, j, distance)
        if share is None:
            return False
        distance = max(distance[0], share[0]), min(distance[1], share[1])
        if distance[0] > distance[1]:
            return row.refuse()
    return _keep_unit(row, distance) and _keep_length(row, pairs, tolerant(distance))


def _keep_unit(row: Arguments, distance: Interval) -> bool:
    """Narrow the first two arguments to a vector of length one, or of length 0 where the distance is 0."""
    for k, other in ((0, magnitude(row.bounds(1))), (1, magnitude(row.bounds(0)))):
        least = max(0.0, other[0] - FLOAT_TOLERANCE)
        most = math.sqrt(max(0.0, 1.0 - least * least))
        if not row.keep(k, *outward(-most, most)):
            return False
    slack = 3.0 * FLOAT_TOLERANCE
    if distance[0] > 0.0 or max(magnitude(row.bounds(k))[0] for k in (0, 1)) > slack:
        if distance[1] <= 0.0:
            return row.refuse()
        for k, other in ((0, magnitude(row.bounds(1))), (1, magnitude(row.bounds(0)))):
            most = other[1] + slack
            least = math.sqrt(max(0.0, 1.0 - most * most))
            if least > slack and not row.keep_away(k, least - slack):
                return False
    elif distance[1] <= 0.0:
        return row.keep(0, 0.0, 0.0) and row.keep(1, 0.0, 0.0)
    return True


def _keep_share(row: Arguments, k: int, i: int, j: int, distance: Interval) -> Interval | None:
    """Narrow one coordinate of a unit vector and those of its points; bound their distance; None on conflict."""
    start, end = row.bounds(i), row.bounds(j)
    lo, hi = outward(end[0] - start[1], end[1] - start[0])
    nearest, farthest = distance
    if nearest > 0.0:
        least = lo / (nearest if lo < 0.0 else farthest) if lo > -inf else -1.0
        most = hi / (nearest if hi > 0.0 else farthest) if hi < inf else 1.0
    else:
        least, most = -1.0 if lo < 0.0 else 0.0, 1.0 if hi > 0.0 else 0.0
    if not row.keep(k, *outward(max(-1.0, least), min(1.0, most))):
        return None
    share = tolerant(row.bounds(k))
    part, whole = magnitude(share), magnitude((lo, hi))
    shortest = part[0] and whole[0] / part[1] if part[1] > 0.0 else 0.0
    longest = whole[1] / part[0] if part[0] > 0.0 else inf
    least = product(share[0], nearest if share[0] > 0.0 else farthest)
    most = product(share[1], farthest if share[1] > 0.0 else nearest)
    lo, hi = outward(least, most)
    if not (row.keep(j, start[0] + lo, start[1] + hi) and row.keep(i, end[0] - hi, end[1] - lo)):
        return None
    return shortest - FLOAT_TOLERANCE, longest + FLOAT_TOLERANCE
