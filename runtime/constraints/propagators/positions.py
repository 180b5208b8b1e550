"""Relations on dates and on positions on the earth, where not all arguments are known (see `relational`)."""

import math
from math import inf

from runtime.constraints.propagators.arguments import Arguments, tolerant
from runtime.constraints.propagators.earth import ECCENTRICITY_2, EQUATOR, MEAN_RADIUS, date_of_tick, tick_of_date
from runtime.constraints.propagators.intervals import (
    ROUGH,
    Interval,
    added,
    cosine,
    magnitude,
    multiplied,
    outward,
    sine,
    taken,
)

_LEAST_RADIUS = 6.33e6  # metres, somewhat less than the ellipsoid's least radius of curvature
_HAIR = 1e-12  # what cosines are wrong by
_METRES = 0.5  # the stated tolerance of distances and displacements on the earth
_METRES_OF_POSITION = 2.0  # what the tolerance of positions is at most
_FARTHEST = 1e12  # seconds; dates are looked at within some 30,000 years


def _distance_bounds(lat1: Interval, lon1: Interval, lat2: Interval, lon2: Interval) -> Interval:
    """Bound the distance in metres of two positions on a sphere, given in degrees.

    The haversine formula over intervals. Beside it, as it is weak where a latitude is free: nobody comes nearer to a
    meridian than straight across, and a way along a parallel and a meridian is no shorter than the shortest.
    """
    aside = taken(lon2, lon1)
    half_lat = _square(sine(_halved(taken(lat2, lat1))))
    half_lon = _square(sine(_halved(aside)))
    share = added(half_lat, multiplied(multiplied(cosine(lat1), cosine(lat2)), half_lon))
    least, most = (2.0 * math.asin(math.sqrt(min(1.0, max(0.0, x)))) for x in share)
    for lat in (lat1, lat2):
        across = magnitude(multiplied(cosine(lat), sine(aside)))[0]
        angle = math.asin(min(1.0, max(0.0, across)))
        least, most = max(least, angle), min(most, math.pi - angle)
    ways = magnitude(taken(lat2, lat1))[1] + magnitude(aside)[1]
    most = min(most, math.radians(ways))
    return outward(least * MEAN_RADIUS - 0.1, most * MEAN_RADIUS + 0.1)


def _arcs_apart(position: list[float], k: int, least: float, most: float) -> list[Interval]:
    """Give the degrees, but for whole turns, that one of four coordinates may be, by the distance in metres.

    `position` is lat1, lon1, lat2, lon2, of which number k is not known. The cosine of the angle between two directions
    is a cos(y) + b sin(y) + c, so it lies between two bounds on at most two arcs of y.
    """
    lat1, lon1, lat2, lon2 = (math.radians(x) for x in (position if k < 2 else [*position[2:], *position[:2]]))
    if k % 2 == 0:
        a, b, c, start = math.cos(lat2) * math.cos(lon2 - lon1), math.sin(lat2), 0.0, 0.0
    else:
        a, b, c, start = math.cos(lat1) * math.cos(lat2), 0.0, math.sin(lat1) * math.sin(lat2), lon2
    size = math.hypot(a, b)
    if size < ROUGH:
        return [(-180.0, 180.0)]
    near, far = (math.cos(min(math.pi, max(0.0, x / MEAN_RADIUS))) for x in (least, most))
    shares = [(far - c - _HAIR) / size, (near - c + _HAIR) / size]
    if shares[0] > 1.0 or shares[1] < -1.0:
        return []
    first, last = (math.acos(min(1.0, max(-1.0, share))) for share in reversed(shares))
    middle = start + math.atan2(b, a)
    arcs = [(middle - last, middle - first), (middle + first, middle + last)]
    return [(math.degrees(lo) - ROUGH, math.degrees(hi) + ROUGH) for lo, hi in arcs]


def _halved(x: Interval) -> Interval:
    """Give the interval of x / 2."""
    return x[0] / 2.0, x[1] / 2.0


def _square(x: Interval) -> Interval:
    """Give the interval of x * x."""
    lo, hi = magnitude(x)
    return outward(lo * lo, hi * hi)


def _displacement_bounds(lat1: Interval, lon1: Interval, lat2: Interval, lon2: Interval) -> tuple[Interval, Interval]:
    """Bound how many metres north and east the second position lies in the first one's tangent plane (WGS-84)."""
    aside = taken(lon2, lon1)
    across1, up1 = _coordinates(lat1)
    across2, up2 = _coordinates(lat2)
    east = multiplied(across2, sine(aside))
    outward_way = taken(multiplied(across2, cosine(aside)), across1)
    north = taken(multiplied(cosine(lat1), taken(up2, up1)), multiplied(sine(lat1), outward_way))
    return (north[0] - 1.0, north[1] + 1.0), (east[0] - 1.0, east[1] + 1.0)


def _angle_bound(north: float, east: float) -> float:
    """Bound by how many degrees a position differs from one in whose tangent plane it lies at most so far, in metres.

    Also the latitudes: the ellipsoid is nowhere more curved than a sphere of the least radius.
    """
    share = math.hypot(north, east) / _LEAST_RADIUS
    return math.degrees(math.asin(share)) if share < 0.7 else inf


def _turn_bound(lat: float, angle: float) -> float:
    """Bound the difference in longitude of positions so many degrees apart, one of them at most at a latitude."""
    if lat + angle > 89.0:
        return inf
    return math.degrees(math.asin(math.sin(math.radians(angle)) / math.cos(math.radians(lat)))) + ROUGH


def _coordinates(lat: Interval) -> tuple[Interval, Interval]:
    """Give the distances from the axis and from the plane of the equator of a latitude, in metres."""
    sines = sine(lat)
    normal = tuple(EQUATOR / math.sqrt(1.0 - ECCENTRICITY_2 * x) for x in _square(sines))
    radius = outward(min(normal), max(normal))
    flattened = (radius[0] * (1.0 - ECCENTRICITY_2), radius[1] * (1.0 - ECCENTRICITY_2))
    return multiplied(radius, cosine(lat)), multiplied(flattened, sines)


def _tick_bounds(seconds: Interval, day: Interval, year: Interval, tick_seconds: float, epoch: float) -> Interval:
    """Bound the tick of a date of which the year is bounded; all ticks where it is not."""
    if not (year[0] > 1.0 and year[1] < 1e5):
        return -inf, inf
    first = tick_of_date(max(0.0, seconds[0]), max(1, math.ceil(day[0])), math.ceil(year[0]), tick_seconds, epoch)
    last = tick_of_date(
        min(86400.0, seconds[1]), min(366, math.floor(day[1])), math.floor(year[1]), tick_seconds, epoch
    )
    return first - 1.0, last + 1.0


def _year_bounds(tick: Interval, tick_seconds: float, epoch: float) -> Interval:
    """Bound the year of a tick."""
    first, last = ((epoch + x * tick_seconds) for x in tick)
    return (
        date_of_tick(tick[0], tick_seconds, epoch)[2] if abs(first) < _FARTHEST else -inf,
        date_of_tick(tick[1], tick_seconds, epoch)[2] if abs(last) < _FARTHEST else inf,
    )


def tick_date(row: Arguments) -> bool:
    """Narrow: a tick, the second of its day, its day of the year, its year."""
    if not (row.keep(1, 0.0, 86400.0) and row.keep(2, 1.0, 366.0) and row.keep_whole(2) and row.keep_whole(3)):
        return False
    clock = (row.s.tick_seconds, row.s.tick_epoch)
    if not row.keep(0, *_tick_bounds(row.bounds(1), row.bounds(2), row.bounds(3), *clock)):
        return False
    return row.keep(3, *_year_bounds(row.bounds(0), *clock))


def great_circle_distance(row: Arguments) -> bool:
    """Narrow: the distance of two positions on the earth, given by latitude and longitude."""
    position = [row.bounds(k) for k in range(1, 5)]
    lo, hi = _distance_bounds(*position)
    if not row.keep(0, max(0.0, lo - _METRES), hi + _METRES):
        return False
    unknown = [k for k in range(4) if position[k][0] < position[k][1]]
    if len(unknown) != 1:
        return True
    (k,) = unknown
    lo, hi = tolerant(row.bounds(0))
    return row.keep_in_turns(1 + k, _arcs_apart([x for x, _ in position], k, lo - _METRES, hi + _METRES))


def displaced_position(row: Arguments) -> bool:
    """Narrow: a position, how far north and east another one lies of it, that other one."""
    return _keep_displacement(row, (2, 3), (0, 1, 4, 5)) and _keep_near(row)


def displacement_between(row: Arguments) -> bool:
    """Narrow: two positions, and how far north and east the second lies of the first."""
    return _keep_displacement(row, (4, 5), (0, 1, 2, 3))


def _keep_displacement(row: Arguments, way: tuple[int, int], points: tuple[int, ...]) -> bool:
    """Narrow how far north and east the second of two points lies of the first."""
    found = _displacement_bounds(*(row.bounds(k) for k in points))
    return all(
        row.keep(k, lo - _METRES_OF_POSITION, hi + _METRES_OF_POSITION) for k, (lo, hi) in zip(way, found, strict=True)
    )


def _keep_near(row: Arguments) -> bool:
    """Narrow two positions, of which the second is found from how far north and east it lies of the first."""
    north, east = magnitude(row.bounds(2)), magnitude(row.bounds(3))
    angle = _angle_bound(north[1] + _METRES_OF_POSITION, east[1] + _METRES_OF_POSITION)
    for k in (0, 4):
        lo, hi = row.bounds(k)
        if not row.keep(4 - k, lo - angle, hi + angle):
            return False
    turn = _turn_bound(min(magnitude(row.bounds(k))[1] for k in (0, 4)), angle)
    for k in (1, 5):
        lo, hi = row.bounds(k)
        if not row.keep(6 - k, lo - turn, hi + turn):
            return False
    return True
