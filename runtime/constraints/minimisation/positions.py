"""Bound dates, distances and displacements on the earth, where not all of their arguments are known."""

import math
from math import inf

from runtime.constraints.minimisation.intervals import (
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
from runtime.constraints.propagators.earth import ECCENTRICITY_2, EQUATOR, MEAN_RADIUS, date_of_tick, tick_of_date

LEAST_RADIUS = 6.33e6  # metres, somewhat less than the ellipsoid's least radius of curvature
HAIR = 1e-12  # what cosines are wrong by
FARTHEST = 1e12  # seconds; dates are looked at within some 30,000 years


def distance_bounds(lat1: Interval, lon1: Interval, lat2: Interval, lon2: Interval) -> Interval:
    """Bound the distance in metres of two positions on a sphere, given in degrees.

    The haversine formula over intervals. Beside it, as it is weak where a latitude is free: nobody comes nearer to a
    meridian than straight across, and a way along a parallel and a meridian is no shorter than the shortest.
    """
    aside = taken(lon2, lon1)
    half_lat = square(sine(halved(taken(lat2, lat1))))
    half_lon = square(sine(halved(aside)))
    share = added(half_lat, multiplied(multiplied(cosine(lat1), cosine(lat2)), half_lon))
    least, most = (2.0 * math.asin(math.sqrt(min(1.0, max(0.0, x)))) for x in share)
    for lat in (lat1, lat2):
        across = magnitude(multiplied(cosine(lat), sine(aside)))[0]
        angle = math.asin(min(1.0, max(0.0, across)))
        least, most = max(least, angle), min(most, math.pi - angle)
    ways = magnitude(taken(lat2, lat1))[1] + magnitude(aside)[1]
    most = min(most, math.radians(ways))
    return outward(least * MEAN_RADIUS - 0.1, most * MEAN_RADIUS + 0.1)


def arcs_apart(place: list[float], k: int, least: float, most: float) -> list[Interval]:
    """Give the degrees, but for whole turns, that one of four coordinates may be, by the distance in metres.

    `place` is lat1, lon1, lat2, lon2, of which number k is not known. The cosine of the angle between two directions
    is a cos(y) + b sin(y) + c, so it lies between two bounds on at most two arcs of y.
    """
    lat1, lon1, lat2, lon2 = (math.radians(x) for x in (place if k < 2 else [*place[2:], *place[:2]]))
    if k % 2 == 0:
        a, b, c, start = math.cos(lat2) * math.cos(lon2 - lon1), math.sin(lat2), 0.0, 0.0
    else:
        a, b, c, start = math.cos(lat1) * math.cos(lat2), 0.0, math.sin(lat1) * math.sin(lat2), lon2
    size = math.hypot(a, b)
    if size < ROUGH:
        return [(-180.0, 180.0)]
    near, far = (math.cos(min(math.pi, max(0.0, x / MEAN_RADIUS))) for x in (least, most))
    shares = [(far - c - HAIR) / size, (near - c + HAIR) / size]
    if shares[0] > 1.0 or shares[1] < -1.0:
        return []
    first, last = (math.acos(min(1.0, max(-1.0, share))) for share in reversed(shares))
    middle = start + math.atan2(b, a)
    arcs = [(middle - last, middle - first), (middle + first, middle + last)]
    return [(math.degrees(lo) - ROUGH, math.degrees(hi) + ROUGH) for lo, hi in arcs]


def halved(x: Interval) -> Interval:
    """Give the interval of x / 2."""
    return x[0] / 2.0, x[1] / 2.0


def square(x: Interval) -> Interval:
    """Give the interval of x * x."""
    lo, hi = magnitude(x)
    return outward(lo * lo, hi * hi)


def displacement_bounds(lat1: Interval, lon1: Interval, lat2: Interval, lon2: Interval) -> tuple[Interval, Interval]:
    """Bound how many metres north and east the second position lies in the first one's tangent plane (WGS-84)."""
    aside = taken(lon2, lon1)
    across1, up1 = coordinates(lat1)
    across2, up2 = coordinates(lat2)
    east = multiplied(across2, sine(aside))
    outward_way = taken(multiplied(across2, cosine(aside)), across1)
    north = taken(multiplied(cosine(lat1), taken(up2, up1)), multiplied(sine(lat1), outward_way))
    return (north[0] - 1.0, north[1] + 1.0), (east[0] - 1.0, east[1] + 1.0)


def angle_bound(north: float, east: float) -> float:
    """Bound by how many degrees a position differs from one in whose tangent plane it lies at most so far, in metres.

    Also the latitudes: the ellipsoid is nowhere more curved than a sphere of the least radius.
    """
    share = math.hypot(north, east) / LEAST_RADIUS
    return math.degrees(math.asin(share)) if share < 0.7 else inf


def turn_bound(lat: float, angle: float) -> float:
    """Bound the difference in longitude of positions so many degrees apart, one of them at most at a latitude."""
    if lat + angle > 89.0:
        return inf
    return math.degrees(math.asin(math.sin(math.radians(angle)) / math.cos(math.radians(lat)))) + ROUGH


def coordinates(lat: Interval) -> tuple[Interval, Interval]:
    """Give the distances from the axis and from the plane of the equator of a latitude, in metres."""
    sines = sine(lat)
    normal = tuple(EQUATOR / math.sqrt(1.0 - ECCENTRICITY_2 * x) for x in square(sines))
    radius = outward(min(normal), max(normal))
    flattened = (radius[0] * (1.0 - ECCENTRICITY_2), radius[1] * (1.0 - ECCENTRICITY_2))
    return multiplied(radius, cosine(lat)), multiplied(flattened, sines)


def tick_bounds(seconds: Interval, day: Interval, year: Interval, tick_seconds: float, epoch: float) -> Interval:
    """Bound the tick of a date of which the year is bounded; all ticks where it is not."""
    if not (year[0] > 1.0 and year[1] < 1e5):
        return -inf, inf
    first = tick_of_date(max(0.0, seconds[0]), max(1, math.ceil(day[0])), math.ceil(year[0]), tick_seconds, epoch)
    last = tick_of_date(
        min(86400.0, seconds[1]), min(366, math.floor(day[1])), math.floor(year[1]), tick_seconds, epoch
    )
    return first - 1.0, last + 1.0


def year_bounds(tick: Interval, tick_seconds: float, epoch: float) -> Interval:
    """Bound the year of a tick."""
    first, last = ((epoch + x * tick_seconds) for x in tick)
    return (
        date_of_tick(tick[0], tick_seconds, epoch)[2] if abs(first) < FARTHEST else -inf,
        date_of_tick(tick[1], tick_seconds, epoch)[2] if abs(last) < FARTHEST else inf,
    )
