"""What every operation says of known values, in plain arithmetic; nothing here is taken from the engine."""

import math
from collections.abc import Callable, Sequence

from runtime.constraints.propagators import opcodes

Values = Sequence[float]
TOLERANCE = 1e-5  # two floats closer than this are equal
METRES = 0.5  # the stated tolerance of distances on the earth
DEGREES = 5e-7  # and of positions
PARENTS = {4: 0, 5: 0, 6: 4, 7: 1}  # which object was created by the constructor of which
UNBORN = tuple(range(10, 18))  # objects that may yet be made, one inside each of the others


def near(x: float, y: float) -> bool:
    """Tell whether two numbers are equal within the tolerance."""
    return abs(x - y) <= TOLERANCE


def all_equal(x: Values) -> bool:
    """Tell whether all of some numbers are equal."""
    return all(near(x[0], y) for y in x[1:])


def all_different(x: Values) -> bool:
    """Tell whether no two of some numbers are equal."""
    return not any(near(x[j], x[k]) for k in range(len(x)) for j in range(k))


def less(x: float, y: float) -> bool:
    """Tell whether one number is smaller than another by more than the tolerance."""
    return y - x > TOLERANCE


def at_most(x: float, y: float) -> bool:
    """Tell whether one number is smaller than another or equal to it."""
    return x <= y + TOLERANCE


def ancestors(x: float) -> set[int]:
    """Give the objects inside which an object lies."""
    found = set()
    parent = int(x) - 10 if x in UNBORN else PARENTS.get(int(x), -1)
    while parent >= 0:
        found.add(parent)
        parent = PARENTS.get(parent, -1)
    return found


def has_power(r: float, x: float, y: float) -> bool:
    """Tell whether r is x to the power of y."""
    try:
        z = float(x) ** y
    except (ZeroDivisionError, OverflowError):
        return False
    return not isinstance(z, complex) and near(r, z)


def angle(x: float) -> float:
    """Bring an angle within -180 (included) and 180 degrees."""
    return x - 360.0 * math.floor((x + 180.0) / 360.0)


def days_before(year: int) -> int:
    """Count the days from the start of 1970 to that of another year, in the calendar of Gregory."""
    leaps = [y // 4 - y // 100 + y // 400 for y in (year - 1, 1969)]
    return 365 * (year - 1970) + leaps[0] - leaps[1]


def is_date(tick: float, seconds: float, day: float, year: float) -> bool:
    """Tell whether a tick of one second, counted from the start of 1970, is that of a date."""
    if (
        year != int(year)
        or not 0 <= seconds < 86400
        or not 1 <= day <= days_before(int(year) + 1) - days_before(int(year))
    ):
        return False
    return tick == (days_before(int(year)) + day - 1) * 86400 + seconds


def sphere_distance(lat1: float, lon1: float, lat2: float, lon2: float) -> float:
    """Give the distance of two positions on a sphere of the earth's mean radius, by the angle between two vectors."""
    a, b = (unit(lat, lon) for lat, lon in ((lat1, lon1), (lat2, lon2)))
    cross = math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return 6371008.8 * math.atan2(cross, sum(x * y for x, y in zip(a, b, strict=True)))


def unit(lat: float, lon: float) -> tuple[float, float, float]:
    """Give the direction of a position in degrees."""
    p, q = math.radians(lat), math.radians(lon)
    return math.cos(p) * math.cos(q), math.cos(p) * math.sin(q), math.sin(p)


def ellipsoid(lat: float, lon: float) -> tuple[float, float, float]:
    """Give the coordinates of a position on the ellipsoid of WGS-84, by its two axes."""
    a, b = 6378137.0, 6356752.314245
    x, y, z = unit(lat, lon)
    n = a * a / math.sqrt(a * a * (x * x + y * y) + b * b * z * z)
    return n * x, n * y, n * z * b * b / (a * a)


def displacement(lat: float, lon: float, other_lat: float, other_lon: float) -> tuple[float, float]:
    """Give how far north and east another position lies in the tangent plane of the first."""
    way = [y - x for x, y in zip(ellipsoid(lat, lon), ellipsoid(other_lat, other_lon), strict=True)]
    p, q = math.radians(lat), math.radians(lon)
    north = (-math.sin(p) * math.cos(q), -math.sin(p) * math.sin(q), math.cos(p))
    east = (-math.sin(q), math.cos(q), 0.0)
    return sum(x * y for x, y in zip(north, way, strict=True)), sum(x * y for x, y in zip(east, way, strict=True))


def is_displaced(lat: float, lon: float, north: float, east: float, to_lat: float, to_lon: float) -> bool:
    """Tell whether a position lies north and east of another on its side of the earth, within the tolerance."""
    if abs(to_lat) > 90 or abs(to_lon - lon) > 180:
        return False
    if sum(x * y for x, y in zip(unit(lat, lon), unit(to_lat, to_lon), strict=True)) < 0:
        return False
    n, e = displacement(lat, lon, to_lat, to_lon)
    metres = 111_700.0 * (DEGREES + TOLERANCE)
    return abs(n - north) <= metres and abs(e - east) <= metres


def is_displacement(lat: float, lon: float, to_lat: float, to_lon: float, north: float, east: float) -> bool:
    """Tell whether a displacement leads from one position to another, within the tolerance of distances."""
    n, e = displacement(lat, lon, to_lat, to_lon)
    return abs(n - north) <= METRES + TOLERANCE and abs(e - east) <= METRES + TOLERANCE


def is_way(ticks: float, xa: float, ya: float, xb: float, yb: float, speed: float) -> bool:
    """Tell whether a way takes some ticks at a speed."""
    distance = math.hypot(xb - xa, yb - ya)
    if speed <= 0.0:
        return distance == 0.0 and ticks == 1.0
    return near(ticks, max(1.0, math.ceil(distance / speed - 1e-9)))


def points_towards(ux: float, uy: float, x: float, y: float, tx: float, ty: float) -> bool:
    """Tell whether a vector of length one (or 0 where there is no way) points from one place to another."""
    distance = math.hypot(tx - x, ty - y) or 1.0
    return near(ux, (tx - x) / distance) and near(uy, (ty - y) / distance)


MEANINGS: dict[int, Callable[..., bool]] = {
    opcodes.OP_EQ: lambda *x: all_equal(x),
    opcodes.OP_NEQ: lambda x, y: not near(x, y),
    opcodes.OP_LT: less,
    opcodes.OP_LEQ: at_most,
    opcodes.OP_ALL_DIFF: lambda *x: all_different(x),
    opcodes.OP_TEMPORAL_DISTANCE: lambda start, d, end: near(end - start, d),
    opcodes.OP_WITHIN_BOUNDS: lambda x, lo, hi: at_most(lo, x) and at_most(x, hi),
    opcodes.OP_ADD_EQ: lambda x, y, r: near(x + y, r),
    opcodes.OP_MUL_EQ: lambda x, y, r: near(x * y, r),
    opcodes.OP_DIV_EQ: lambda x, y, r: y != 0 and near(x, r * y),
    opcodes.OP_EQ_SUM: lambda r, *x: near(r, sum(x)),
    opcodes.OP_EQ_PRODUCT: lambda r, *x: near(r, math.prod(x)),
    opcodes.OP_EQ_MAXIMUM: lambda r, *x: near(r, max(x)),
    opcodes.OP_EQ_MINIMUM: lambda r, *x: near(r, min(x)),
    opcodes.OP_ALL_MAX: lambda *x: near(x[-1], max(x[:-1])),
    opcodes.OP_ALL_MIN: lambda *x: near(x[-1], min(x[:-1])),
    opcodes.OP_ABS_VAL: lambda r, x: near(r, abs(x)),
    opcodes.OP_NEG: lambda x, y: near(x, -y),
    opcodes.OP_DIFF_SQUARE: lambda x, y, r: near(r, (x - y) ** 2),
    opcodes.OP_CALC_DISTANCE: lambda d, x, y, u, v: near(d, math.hypot(x - u, y - v)),
    opcodes.OP_DISTANCE_SQUARES: lambda x, y, r: x + y >= 0 and near(r, math.sqrt(x + y)),
    opcodes.OP_TEST_EQ: lambda t, x, y: (t != 0) == near(x, y),
    opcodes.OP_TEST_NEQ: lambda t, x, y: (t != 0) != near(x, y),
    opcodes.OP_TEST_LEQ: lambda t, x, y: (t != 0) == at_most(x, y),
    opcodes.OP_TEST_LT: lambda t, x, y: (t != 0) == less(x, y),
    opcodes.OP_TEST_AND: lambda t, x, y: (t != 0) == (x != 0 and y != 0),
    opcodes.OP_TEST_OR: lambda t, x, y: (t != 0) == (x != 0 or y != 0),
    opcodes.OP_OR: lambda *x: any(x),
    opcodes.OP_COUNT_ZEROES: lambda n, *x: near(n, sum(y == 0 for y in x)),
    opcodes.OP_COUNT_NON_ZEROES: lambda n, *x: near(n, sum(y != 0 for y in x)),
    opcodes.OP_COND_ALL_DIFF: lambda t, *x: (t != 0) == all_different(x),
    opcodes.OP_COND_EQ: lambda t, *x: (t != 0) == all_equal(x),
    opcodes.OP_TEST_SINGLETON: lambda t, x: t != 0,
    opcodes.OP_TEST_SPECIFIED: lambda t, x: t != 0,
    opcodes.OP_SUBSET_OF: near,
    opcodes.OP_EQ_UNION: lambda *x: all_equal(x),
    opcodes.OP_MEMBER_IMPLY: lambda a, b, c, d: not near(b, c) or near(a, d),
    opcodes.OP_LOCK: near,
    opcodes.OP_HAS_ANCESTOR: lambda x, p: int(p) in ancestors(x),
    opcodes.OP_COMMON_ANCESTOR: lambda x, y, p: int(p) in ancestors(x) & ancestors(y),
    opcodes.OP_ABS: lambda r, x: near(r, abs(x)),
    opcodes.OP_SQRT: lambda r, x: x >= 0 and near(r, math.sqrt(x)),
    opcodes.OP_FLOOR: lambda r, x: near(r, math.floor(x + TOLERANCE)),
    opcodes.OP_CEIL: lambda r, x: near(r, math.ceil(x - TOLERANCE)),
    opcodes.OP_MAX: lambda r, x, y: near(r, max(x, y)),
    opcodes.OP_MIN: lambda r, x, y: near(r, min(x, y)),
    opcodes.OP_POW: has_power,
    opcodes.OP_MOD: lambda r, x, y: y != 0 and near(r, math.fmod(x, y)),
    opcodes.OP_SIN: lambda r, x: abs(x) <= 90 + TOLERANCE and near(r, math.sin(math.radians(x))),
    opcodes.OP_SAMPLE: near,
    opcodes.OP_TRAVEL_TIME: is_way,
    opcodes.OP_TOWARDS: points_towards,
    opcodes.OP_SINF: lambda r, x: abs(x) <= 180 and near(r, math.sin(math.radians(x))),
    opcodes.OP_COSF: lambda r, x: abs(x) <= 180 and near(r, math.cos(math.radians(x))),
    opcodes.OP_SQRTF: lambda r, x: x >= 0 and near(r, math.sqrt(x)),
    opcodes.OP_ABSF: lambda r, x: near(r, abs(x)),
    opcodes.OP_FLOORF: lambda r, x: near(r, math.floor(x + TOLERANCE)),
    opcodes.OP_CEILF: lambda r, x: near(r, math.ceil(x - TOLERANCE)),
    opcodes.OP_MAXF: lambda r, *x: near(r, max(x)),
    opcodes.OP_MINF: lambda r, *x: near(r, min(x)),
    opcodes.OP_EXPF: lambda r, x: x < 700 and near(r, math.exp(x)),
    opcodes.OP_LOGF: lambda r, x: x > 0 and near(r, math.log(x)),
    opcodes.OP_DEG_TO_RAD: lambda r, x: near(r, math.radians(x)),
    opcodes.OP_CIRCLE_MOD: lambda r, x: near(r, angle(x)),
    opcodes.OP_TICK_DATE: is_date,
    opcodes.OP_LL_DIST: lambda d, *x: d > -TOLERANCE and abs(d - sphere_distance(*x)) <= METRES + TOLERANCE,
    opcodes.OP_WGS_DISPLACE: is_displaced,
    opcodes.OP_WGS_DISPLACEMENT: is_displacement,
    opcodes.OP_WATCH: lambda *x: True,
    opcodes.OP_NOTHING: lambda *x: True,
}


def holds(op: int, x: Values) -> bool:
    """Tell whether a constraint holds for known values."""
    return MEANINGS[op](*x)
