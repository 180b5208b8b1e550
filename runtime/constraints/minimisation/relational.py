"""Say what functions that wait for their arguments demand before these are known: relations of intervals.

The engine lets them wait, as EUROPA does. Whether a set of constraints contradicts itself does not hang on what is
known, so the scratch engine of `minimise` posts these instead: sound narrowing, both ways where that is simple, with
the tolerance of values on top.
"""

import math
from math import inf

from runtime.constraints.domains import tags
from runtime.constraints.domains.tags import FLOAT_TOLERANCE, KIND_FLOAT, KIND_INT
from runtime.constraints.engine import Engine
from runtime.constraints.minimisation.intervals import Interval, magnitude, outward, raised, times
from runtime.constraints.minimisation.positions import (
    angle_bound,
    arcs_apart,
    displacement_bounds,
    distance_bounds,
    tick_bounds,
    turn_bound,
    year_bounds,
)
from runtime.constraints.minimisation.relation import Relation, Row, Rule, tolerant

SIBLINGS = {
    tags.OP_ABS: tags.OP_ABSF,
    tags.OP_SQRT: tags.OP_SQRTF,
    tags.OP_FLOOR: tags.OP_FLOORF,
    tags.OP_CEIL: tags.OP_CEILF,
    tags.OP_MAX: tags.OP_MAXF,
    tags.OP_MIN: tags.OP_MINF,
    tags.OP_SIN: tags.OP_SINF,
}  # they say the same and narrow both ways
FOR_KNOWN = (
    tags.OP_DIFF_SQUARE,
    tags.OP_TICK_DATE,
    tags.OP_LL_DIST,
    tags.OP_WGS_DISPLACE,
    tags.OP_WGS_DISPLACEMENT,
)
HAIR = 1e-9  # a way of so little more than whole ticks takes no further one
METRES = 0.5  # the stated tolerance of distances and displacements on the earth
METRES_OF_POSITION = 2.0  # what the tolerance of positions is at most


def foresee(engine: Engine, op: int, v: list[int], span: int, owner: int) -> bool:
    """Post what a function that waits for its arguments demands of intervals; nothing for other operations.

    True if it stands for the function, whose own way is to take reals for known that only nearly are; false if the
    function is to be posted as well.
    """

    def relate(rule: Rule, *arguments: int) -> None:
        engine.post_external(Relation(rule), list(arguments), span, owner)

    def number(kind: int) -> int:
        return engine.new_interval(kind, -inf, inf, -1, -1)

    def common(a: int, b: int) -> int:
        """Give the kind of what whole numbers make of two numbers."""
        return KIND_FLOAT if KIND_FLOAT in (engine.kind[a], engine.kind[b]) else KIND_INT

    def way(a: int, b: int) -> int:
        """Give the squared difference of two numbers."""
        square = number(common(a, b))
        engine.post(tags.OP_DIFF_SQUARE, [a, b, square], span, owner)
        foresee(engine, tags.OP_DIFF_SQUARE, [a, b, square], span, owner)
        return square

    def length(square: int, other: int) -> int:
        """Give the root of a sum."""
        total, root = number(common(square, other)), number(KIND_FLOAT)
        engine.post(tags.OP_ADD_EQ, [square, other, total], span, owner)
        engine.post(tags.OP_SQRTF, [root, total], span, owner)
        return root

    def equate(a: int, b: int) -> None:
        engine.post(tags.OP_EQ, [a, b], span, owner)

    match op:
        case tags.OP_DIFF_SQUARE:
            if common(v[0], v[1]) == KIND_INT:
                relate(be_square, v[2])
        case tags.OP_DISTANCE_SQUARES:
            equate(v[2], length(v[0], v[1]))
        case tags.OP_CALC_DISTANCE:
            equate(v[0], length(way(v[1], v[3]), way(v[2], v[4])))
        case tags.OP_TRAVEL_TIME:
            relate(travel, v[0], length(way(v[1], v[3]), way(v[2], v[4])), v[5])
        case tags.OP_TOWARDS:
            distance = length(way(v[2], v[4]), way(v[3], v[5]))
            relate(has_length_one, v[0], v[1], distance)
            relate(point_along, v[0], v[2], v[4], distance)
            relate(point_along, v[1], v[3], v[5], distance)
        case tags.OP_POW:
            relate(raise_power, *v)
        case tags.OP_MOD:
            relate(leave_rest, *v)
        case tags.OP_TICK_DATE:
            relate(tell_date, *v)
        case tags.OP_LL_DIST:
            relate(be_apart, *v)
        case tags.OP_WGS_DISPLACE:
            relate(lie_apart, v[2], v[3], v[0], v[1], v[4], v[5])
            relate(lie_near, v[2], v[3], v[0], v[1], v[4], v[5])
        case tags.OP_WGS_DISPLACEMENT:
            relate(lie_apart, v[4], v[5], *v[:4])
        case _ if op in SIBLINGS:
            engine.post(SIBLINGS[op], v, span, owner)
        case _:
            return False
    return op not in FOR_KNOWN


def be_square(row: Row) -> bool:
    """Narrow the square of a whole number."""
    lo, hi = tolerant(row.bounds(0))
    if lo > 0.0 and not row.keep(0, math.ceil(math.sqrt(lo) - HAIR) ** 2, inf):
        return False
    return hi == inf or hi < 0.0 or row.keep(0, -inf, math.floor(math.sqrt(hi) + HAIR) ** 2)


def raise_power(row: Row) -> bool:
    """Narrow: result, base, exponent."""
    x, y = row.bounds(1), row.bounds(2)
    if row.is_whole(1) and row.is_whole(2) and not raise_whole(row, y[0]):
        return False
    if y[0] == y[1]:
        return raise_known(row, y[0])
    corners = [raised(a, b) for a in magnitude(x) for b in (*y, max(y[0], min(y[1], 0.0)))]
    least, most = outward(min(corners), max(corners))
    if not row.keep(0, -most if x[0] < 0.0 else 0.0, most) or not row.keep_away(0, least):
        return False
    return find_exponent(row, magnitude(x), magnitude(tolerant(row.bounds(0))))


def raise_whole(row: Row, y: float) -> bool:
    """Narrow: the result of whole numbers is a whole number, or one over such; the least exponent is y."""
    lo, hi = tolerant(row.bounds(0))
    if y >= 0.0:
        return row.keep_whole(0)
    if hi - lo > 3.0 * FLOAT_TOLERANCE or math.floor(hi) >= lo:
        return True
    return 1.0 // lo >= 1.0 / hi or row.refuse()


def find_exponent(row: Row, x: Interval, result: Interval) -> bool:
    """Narrow the exponent, from what base and result are without their signs, where the base is on one side of 1."""
    if not (x[0] > 1.0 or 0.0 < x[0] <= x[1] < 1.0):
        return True
    logarithms = [math.log(a) if a > 0.0 else -inf for a in result]
    scale = [math.log(a) if a < inf else inf for a in x]
    corners = [a / b if abs(b) < inf else 0.0 for a in logarithms for b in scale]
    return row.keep(2, *outward(min(corners), max(corners)))


def raise_known(row: Row, y: float) -> bool:
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
        return raise_odd(row, x, y)
    ends = [raised(a, y) for a in magnitude(x)]
    if not row.keep(0, *outward(min(ends), max(ends))):
        return False
    result = row.bounds(0)
    roots = [raised(max(0.0, a), 1.0 / y) for a in (result[0] - FLOAT_TOLERANCE, result[1] + FLOAT_TOLERANCE)]
    least, most = outward(min(roots), max(roots))
    return row.keep(1, -most, most) and (least <= 0.0 or row.keep_away(1, least - FLOAT_TOLERANCE))


def raise_odd(row: Row, x: Interval, y: float) -> bool:
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


def leave_rest(row: Row) -> bool:
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
    turns = [round((a - end) / y[0]) for a, end in zip(x, ends, strict=True)]
    return turns[0] != turns[1] or row.keep(0, *outward(*ends))


def travel(row: Row) -> bool:
    """Narrow: ticks, distance, speed; whoever stands still gets nowhere."""
    if not (row.keep_whole(0) and row.keep(0, 1.0, inf)):
        return False
    distance, speed = row.bounds(1), row.bounds(2)
    if speed[1] <= 0.0:
        return row.keep(0, 1.0, 1.0) and row.keep(1, 0.0, 0.0)
    quickest, slowest = outward(distance[0] / speed[1], distance[1] / speed[0] if speed[0] > 0.0 else inf)
    if not row.keep(0, math.ceil(quickest - HAIR), inf):
        return False
    if slowest < inf and not row.keep(0, -inf, max(1.0, math.ceil(slowest))):
        return False
    ticks = tolerant(row.bounds(0))
    if not row.keep(1, -inf, outward(0.0, times(ticks[1], speed[1]))[1]):
        return False
    if (
        distance[0] > FLOAT_TOLERANCE
        and ticks[1] < inf
        and not row.keep(2, outward(distance[0] / ticks[1], inf)[0], inf)
    ):
        return False
    before = math.floor(ticks[0] + 2.0 * FLOAT_TOLERANCE) - 1.0 if ticks[0] > -inf else 0.0
    if before < 1.0:
        return True
    if not row.keep(1, outward(before * max(0.0, speed[0]), inf)[0], inf):
        return False
    return distance[1] == inf or row.keep(2, 0.0, outward(0.0, distance[1] / before)[1])


def has_length_one(row: Row) -> bool:
    """Narrow: two coordinates of a vector of length one, the distance it points over; it is nothing where that is 0."""
    x, y, distance = row.bounds(0), row.bounds(1), row.bounds(2)
    for k, other in ((0, magnitude(y)), (1, magnitude(x))):
        most = math.sqrt(max(0.0, 1.0 - max(0.0, other[0] - FLOAT_TOLERANCE) ** 2))
        if not row.keep(k, *outward(-most, most)):
            return False
    slack = 3.0 * FLOAT_TOLERANCE
    if distance[0] > 0.0 or max(magnitude(x)[0], magnitude(y)[0]) > slack:
        if distance[1] <= 0.0:
            return row.refuse()
        for k, other in ((0, magnitude(row.bounds(1))), (1, magnitude(row.bounds(0)))):
            least = math.sqrt(max(0.0, 1.0 - (other[1] + slack) ** 2))
            if least > slack and not row.keep_away(k, least - slack):
                return False
    elif distance[1] <= 0.0:
        return row.keep(0, 0.0, 0.0) and row.keep(1, 0.0, 0.0)
    return True


def point_along(row: Row) -> bool:
    """Narrow: one coordinate of a vector of length one, those of the places it points between, their distance."""
    start, end, distance = row.bounds(1), row.bounds(2), row.bounds(3)
    lo, hi = outward(end[0] - start[1], end[1] - start[0])
    nearest, farthest = max(0.0, distance[0]), max(0.0, distance[1])
    if nearest > 0.0:
        least = lo / (nearest if lo < 0.0 else farthest) if lo > -inf else -1.0
        most = hi / (nearest if hi > 0.0 else farthest) if hi < inf else 1.0
    else:
        least, most = -1.0 if lo < 0.0 else 0.0, 1.0 if hi > 0.0 else 0.0
    if not row.keep(0, *outward(max(-1.0, least), min(1.0, most))):
        return False
    share = tolerant(row.bounds(0))
    part, whole = magnitude(share), magnitude((lo, hi))
    if not row.keep(
        3, part[0] and whole[0] / part[1] if part[1] > 0.0 else 0.0, whole[1] / part[0] if part[0] > 0.0 else inf
    ):
        return False
    lo, hi = (
        times(share[0], nearest if share[0] > 0.0 else farthest),
        times(share[1], farthest if share[1] > 0.0 else nearest),
    )
    lo, hi = outward(lo, hi)
    return row.keep(2, start[0] + lo, start[1] + hi) and row.keep(1, end[0] - hi, end[1] - lo)


def tell_date(row: Row) -> bool:
    """Narrow: a tick, the second of its day, its day of the year, its year."""
    if not (row.keep(1, 0.0, 86400.0) and row.keep(2, 1.0, 366.0) and row.keep_whole(2) and row.keep_whole(3)):
        return False
    clock = (row.s.tick_seconds, row.s.tick_epoch)
    if not row.keep(0, *tick_bounds(row.bounds(1), row.bounds(2), row.bounds(3), *clock)):
        return False
    return row.keep(3, *year_bounds(row.bounds(0), *clock))


def be_apart(row: Row) -> bool:
    """Narrow: the distance of two positions on the earth, given by latitude and longitude."""
    place = [row.bounds(k) for k in range(1, 5)]
    lo, hi = distance_bounds(*place)
    if not row.keep(0, max(0.0, lo - METRES), hi + METRES):
        return False
    unknown = [k for k in range(4) if place[k][0] < place[k][1]]
    if len(unknown) != 1:
        return True
    (k,) = unknown
    lo, hi = tolerant(row.bounds(0))
    return row.keep_in_turns(1 + k, arcs_apart([x for x, _ in place], k, lo - METRES, hi + METRES))


def lie_apart(row: Row) -> bool:
    """Narrow: how far north and east a position lies of another one; the first, the second."""
    found = displacement_bounds(*(row.bounds(k) for k in range(2, 6)))
    return all(row.keep(k, lo - METRES_OF_POSITION, hi + METRES_OF_POSITION) for k, (lo, hi) in enumerate(found))


def lie_near(row: Row) -> bool:
    """Narrow two positions, of which the second is found from how far north and east it lies of the first."""
    north, east = magnitude(row.bounds(0)), magnitude(row.bounds(1))
    angle = angle_bound(north[1] + METRES_OF_POSITION, east[1] + METRES_OF_POSITION)
    for k in (2, 4):
        lo, hi = row.bounds(k)
        if not row.keep(6 - k, lo - angle, hi + angle):
            return False
    lat = min(magnitude(row.bounds(2))[1], magnitude(row.bounds(4))[1])
    turn = turn_bound(lat, angle)
    for k in (3, 5):
        lo, hi = row.bounds(k)
        if not row.keep(8 - k, lo - turn, hi + turn):
            return False
    return True
