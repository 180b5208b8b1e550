"""Compute with dates and with positions on the WGS-84 ellipsoid; plain functions, rarely called, never compiled."""

import math

from runtime.constraints.propagators.functions import rounded

EQUATOR = 6378137.0  # WGS-84, metres
ECCENTRICITY_2 = 0.00669437999013
MEAN_RADIUS = 6371008.8
_DEGREE = math.pi / 180.0
_DAY = 86400.0


def great_circle(lat1: float, lon1: float, lat2: float, lon2: float) -> float:
    """Give the distance in metres of two positions in degrees, on a sphere, by the haversine formula."""
    p = math.sin((lat2 - lat1) * _DEGREE / 2.0)
    q = math.sin((lon2 - lon1) * _DEGREE / 2.0)
    h = p * p + math.cos(lat1 * _DEGREE) * math.cos(lat2 * _DEGREE) * q * q
    return rounded(2.0 * MEAN_RADIUS * math.asin(min(1.0, math.sqrt(h))))


def _to_cartesian(lat: float, lon: float) -> tuple[float, float, float]:
    """Give the earth-centred coordinates of a position on the ellipsoid."""
    sine = math.sin(lat * _DEGREE)
    normal = EQUATOR / math.sqrt(1.0 - ECCENTRICITY_2 * sine * sine)
    across = normal * math.cos(lat * _DEGREE)
    x = across * math.cos(lon * _DEGREE)
    y = across * math.sin(lon * _DEGREE)
    return x, y, normal * (1.0 - ECCENTRICITY_2) * sine


def displacement(lat: float, lon: float, other_lat: float, other_lon: float) -> tuple[float, float]:
    """Give how many metres north and east, in the first position's tangent plane, the second one lies."""
    x1, y1, z1 = _to_cartesian(lat, lon)
    x2, y2, z2 = _to_cartesian(other_lat, other_lon)
    x, y, z = x2 - x1, y2 - y1, z2 - z1
    outward = math.cos(lon * _DEGREE) * x + math.sin(lon * _DEGREE) * y
    north = -math.sin(lat * _DEGREE) * outward + math.cos(lat * _DEGREE) * z
    east = -math.sin(lon * _DEGREE) * x + math.cos(lon * _DEGREE) * y
    return rounded(north), rounded(east)


def displaced(lat: float, lon: float, north: float, east: float) -> tuple[float, float]:
    """Give the position that lies north and east: the inverse of `displacement`, by Newton's method to 1e-9 degrees."""
    sine = math.sin(lat * _DEGREE)
    curvature = 1.0 - ECCENTRICITY_2 * sine * sine
    meridian = EQUATOR * (1.0 - ECCENTRICITY_2) / (curvature * math.sqrt(curvature))
    parallel = EQUATOR / math.sqrt(curvature) * max(1e-9, math.cos(lat * _DEGREE))
    new_lat = lat
    new_lon = lon
    for _ in range(12):
        at_north, at_east = displacement(lat, lon, new_lat, new_lon)
        new_lat += (north - at_north) / meridian / _DEGREE
        new_lon += (east - at_east) / parallel / _DEGREE
    return rounded(new_lat), rounded(new_lon)


def _days_before(year: int) -> int:
    """Count the days from the start of 1970 to the start of a year (Gregorian calendar)."""
    past = year - 1
    return 365 * (year - 1970) + (past // 4 - 492) - (past // 100 - 19) + (past // 400 - 4)


def date_of_tick(tick: float, tick_seconds: float, epoch: float) -> tuple[float, float, float]:
    """Give the second of the day, the day of the year (1 is the first of January) and the year of a tick."""
    time = epoch + tick * tick_seconds
    day = int(math.floor(time / _DAY))
    year = 1970 + day // 366
    while _days_before(year + 1) <= day:
        year += 1
    while _days_before(year) > day:
        year -= 1
    return time - day * _DAY, float(day - _days_before(year) + 1), float(year)


def tick_of_date(seconds: float, day: int, year: int, tick_seconds: float, epoch: float) -> float:
    """Give the first tick at or after a date."""
    time = (_days_before(year) + day - 1) * _DAY + seconds
    return float(math.ceil((time - epoch) / tick_seconds - 1e-9))
