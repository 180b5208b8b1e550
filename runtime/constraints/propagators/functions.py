"""Compute functions forwards, once all arguments are known: what NDDL calls in expressions, draws, travel times."""

import math

from runtime.constraints.domains.bitset import has_value, next_value, previous_value
from runtime.constraints.domains.narrow import assign, high, is_single, low, raise_to, reduce_to
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import FLOAT_TOLERANCE, HALF_INF, KIND_FLOAT, SIDE_HOLES, SUPPORT_CONSTRAINT, ULP
from runtime.constraints.propagators.opcodes import (
    OP_ABS,
    OP_BIND,
    OP_CEIL,
    OP_FLOOR,
    OP_MAX,
    OP_MIN,
    OP_MOD,
    OP_POW,
    OP_RAND,
    OP_SAMPLE,
    OP_SQRT,
    OP_TOWARDS,
    OP_TRAVEL_TIME,
)


def propagate_function(s: Store, c: int) -> bool:
    """Run a constraint of this family."""
    op = s.op[c]
    first = s.first[c]
    r = s.slot_variable[first]
    support = c * 4 + SUPPORT_CONSTRAINT
    if op == OP_RAND:
        return assign(s, r, s.drawn[c], support)
    a = s.slot_variable[first + 1]
    if op == OP_SAMPLE:
        return raise_to(s, r, low(s, a), support) and reduce_to(s, r, high(s, a), support)
    if op == OP_BIND:
        return is_single(s, r) or not is_single(s, a) or _bind(s, r, middle(s, a), support)
    if op == OP_TRAVEL_TIME:
        return _travel(s, first, support)
    if op == OP_TOWARDS:
        return _point_towards(s, first, support)
    if not are_known(s, first + 1, first + s.arity[c]):
        return True
    x = middle(s, a)
    y = 0.0
    if s.arity[c] > 2:
        y = middle(s, s.slot_variable[first + 2])
    if (op == OP_SQRT and x < -FLOAT_TOLERANCE) or (op == OP_MOD and y == 0.0):
        return s.fail(r, SIDE_HOLES, support)
    if op == OP_POW and not _has_power(x, y):
        return s.fail(r, SIDE_HOLES, support)
    z = _apply(op, x, y)
    if op == OP_FLOOR or op == OP_CEIL or op == OP_MOD or op == OP_POW:
        return raise_to(s, r, z, support) and reduce_to(s, r, z, support)
    return _spread(s, op, first, s.arity[c], z, support)


def _spread(s: Store, op: int, first: int, count: int, z: float, support: int) -> bool:
    """Set the result of a continuous function; what is left of its arguments' intervals counts, however narrow."""
    a = s.slot_variable[first + 1]
    b = s.slot_variable[first + count - 1]
    lo = z
    hi = z
    for corner in range(4):
        x = high(s, a) if corner & 1 else low(s, a)
        y = high(s, b) if corner & 2 else low(s, b)
        if op != OP_SQRT or x > 0.0:
            z = _apply(op, x, y)
            lo = min(lo, z)
            hi = max(hi, z)
    if op == OP_ABS and low(s, a) < 0.0 < high(s, a):
        lo = 0.0
    if lo < hi:
        lo -= abs(lo) * ULP
        hi += abs(hi) * ULP
    r = s.slot_variable[first]
    return raise_to(s, r, lo, support) and reduce_to(s, r, hi, support)


def middle(s: Store, v: int) -> float:
    """Give the value of a known variable."""
    if s.kind[v] != KIND_FLOAT:
        return float(s.lb[v])
    if s.flo[v] == s.fhi[v]:
        return s.flo[v]
    return s.flo[v] + (s.fhi[v] - s.flo[v]) * 0.5


def half_width(s: Store, v: int) -> float:
    """Give how far the values of a known variable may be from its middle."""
    return (s.fhi[v] - s.flo[v]) * 0.5 if s.kind[v] == KIND_FLOAT else 0.0


def whole(s: Store, v: int) -> float:
    """Give the value of a known variable, a whole number if it is within the tolerance of one."""
    x = middle(s, v)
    y = math.floor(x + 0.5)
    return float(y) if abs(x - y) <= FLOAT_TOLERANCE else x


def rounded(x: float) -> float:
    """Keep 44 bits of a double (Veltkamp's split), so that libraries that differ in the last bits agree."""
    if not -1e300 < x < 1e300:
        return x
    y = x * 513.0
    return y - (y - x)


def _has_power(x: float, y: float) -> bool:
    """Tell whether x to the power of y is a real number within the range of doubles."""
    if x == 0.0:
        return y >= 0.0
    if x < 0.0 and y != math.floor(y):
        return False
    return y * math.log(abs(x)) < 709.0


def _apply(op: int, x: float, y: float) -> float:
    """Compute a function of one or two arguments; the rest of a division has the sign of its dividend, as in C."""
    if op == OP_ABS:
        return abs(x)
    if op == OP_MAX:
        return max(x, y)
    if op == OP_MIN:
        return min(x, y)
    if op == OP_FLOOR:
        return math.floor(x + FLOAT_TOLERANCE)
    if op == OP_CEIL:
        return math.ceil(x - FLOAT_TOLERANCE)
    if op == OP_SQRT:
        return math.sqrt(x) if x > 0.0 else 0.0
    if op == OP_MOD:
        return math.fmod(x, y)
    assert op == OP_POW
    return rounded(math.pow(x, y))


def sine(degrees: float) -> float:
    """Give the sine of an angle in degrees, exact at multiples of 30."""
    x = math.fmod(degrees, 360.0)
    if x == 0.0 or x == 180.0 or x == -180.0:
        return 0.0
    if x == 90.0 or x == -270.0:
        return 1.0
    if x == -90.0 or x == 270.0:
        return -1.0
    if x == 30.0 or x == 150.0 or x == -210.0 or x == -330.0:
        return 0.5
    if x == -30.0 or x == -150.0 or x == 210.0 or x == 330.0:
        return -0.5
    return rounded(math.sin(x * (math.pi / 180.0)))


def _bind(s: Store, v: int, x: float, support: int) -> bool:
    """Give a variable that is still free the value nearest to x; the lower one of two."""
    if s.kind[v] == KIND_FLOAT:
        x = min(max(x, s.flo[v]), s.fhi[v])
        return raise_to(s, v, x, support) and reduce_to(s, v, x, support)
    if x >= HALF_INF or x <= -HALF_INF:
        return True
    wanted = int(math.floor(x + 0.5))
    wanted = min(max(wanted, s.lb[v]), s.ub[v])
    if s.word[v] >= 0 and not has_value(s, v, wanted):
        above = next_value(s, v, wanted)
        below = previous_value(s, v, wanted)
        wanted = below if wanted - below <= above - wanted else above
    return assign(s, v, wanted, support)


def are_known(s: Store, first: int, last: int) -> bool:
    """Tell whether the arguments from slot `first` to before `last` are known."""
    for k in range(first, last):  # noqa: SIM110 (a generator cannot be compiled here)
        if not is_single(s, s.slot_variable[k]):
            return False
    return True


def _travel(s: Store, first: int, support: int) -> bool:
    """Set ticks = max(1, distance / speed rounded up), once all is known; standing still gets nowhere."""
    if not are_known(s, first + 1, first + 6):
        return True
    ticks = s.slot_variable[first]
    dx = middle(s, s.slot_variable[first + 3]) - middle(s, s.slot_variable[first + 1])
    dy = middle(s, s.slot_variable[first + 4]) - middle(s, s.slot_variable[first + 2])
    distance = math.sqrt(dx * dx + dy * dy)
    speed = middle(s, s.slot_variable[first + 5])
    if speed <= 0.0:
        if distance > 0.0:
            return s.fail(ticks, SIDE_HOLES, support)
        speed = 1.0
    x = max(1.0, math.ceil(distance / speed - 1e-9))
    return raise_to(s, ticks, x, support) and reduce_to(s, ticks, x, support)


def _point_towards(s: Store, first: int, support: int) -> bool:
    """Set the unit vector from one point to another, once both are known; (0, 0) where they coincide."""
    if not are_known(s, first + 2, first + 6):
        return True
    dx = middle(s, s.slot_variable[first + 4]) - middle(s, s.slot_variable[first + 2])
    dy = middle(s, s.slot_variable[first + 5]) - middle(s, s.slot_variable[first + 3])
    distance = math.sqrt(dx * dx + dy * dy)
    if distance > 0.0:
        dx /= distance
        dy /= distance
    for k in range(2):
        v = s.slot_variable[first + k]
        if not (raise_to(s, v, dx, support) and reduce_to(s, v, dx, support)):
            return False
        dx = dy
    return True
