"""Values as the judge compares them: exact numbers, reals within one tolerance, and hulls of what was never fixed.

The language gives reals a tolerance of 1e-5. A real in a record therefore stands for all values within
`TOLERANCE + RELATIVE * |value|` of it, and a constraint holds if it holds for some of them.
"""

from math import inf, isinf

from runtime.executive.record import OpenValues, Value, ValueRange

TOLERANCE = 1e-5
RELATIVE = 1e-9  # what sums and products of doubles may lose
ENDLESS = 2**51  # bounds from here on are none (docs/engine.md)

_Scalar = float | int | bool | str
Hull = tuple[float, float]
UNKNOWN = ValueRange(-inf, inf)  # what the record does not tell


def slack(value: float) -> float:
    """How far a real may be from what is written."""
    return TOLERANCE + RELATIVE * abs(value)


def is_near(a: float, b: float) -> bool:
    """Whether two numbers are equal; exactly so if both are whole."""
    if a == b:
        return True
    if type(a) is not float and type(b) is not float:
        return False
    return not isinf(a) and not isinf(b) and abs(a - b) <= slack(a if abs(a) > abs(b) else b)


def is_open(value: Value) -> bool:
    """Whether a value was never fixed."""
    return isinstance(value, tuple)


def hull(value: Value) -> Hull | None:
    """The numbers that `value` may stand for; None for names and texts."""
    if isinstance(value, ValueRange):
        return (value.lower, value.upper)
    if isinstance(value, OpenValues):
        if not value.values or isinstance(value.values[0], str):
            return None
        numbers = [float(each) for each in value.values]
        return (min(numbers), max(numbers))
    if isinstance(value, str):
        return None
    if isinstance(value, float) and not isinf(value):
        return (value - slack(value), value + slack(value))
    return (value, value)


def ends_of(value: Value) -> Hull:
    """The numbers that `value` may stand for; any where it is no number."""
    return hull(value) or (-inf, inf)


def _names(value: Value) -> frozenset[_Scalar] | None:
    """The names that `value` may stand for; None if it may be any, or is a number."""
    if isinstance(value, OpenValues):
        return frozenset(value.values)
    return frozenset((value,)) if isinstance(value, str) else None


def may_be_equal(a: Value, b: Value) -> bool:
    """Whether two values have something in common."""
    if not isinstance(a, tuple) and not isinstance(b, tuple):
        if isinstance(a, str) or isinstance(b, str):
            return a == b
        return is_near(a, b)
    ours, theirs = _names(a), _names(b)
    if ours is not None and theirs is not None:
        if not any(isinstance(each, str) for each in ours | theirs):
            return any(may_be_equal(x, y) for x in ours for y in theirs)
        return bool(ours & theirs)
    mine, other = hull(a), hull(b)
    if mine is None or other is None:
        return UNKNOWN in (a, b)
    return mine[0] <= other[1] and other[0] <= mine[1]


def lies_within(value: Value, lower: float, upper: float) -> bool:
    """Whether a number may lie between two bounds."""
    if isinstance(value, int):
        return lower <= value <= upper
    mine = hull(value)
    return mine is not None and mine[0] <= upper and lower <= mine[1]


def difference(later: Value, earlier: Value) -> Value:
    """`later - earlier` of two times."""
    if isinstance(later, int) and isinstance(earlier, int):
        return later - earlier
    a, b = hull(later), hull(earlier)
    if a is None or b is None:
        return UNKNOWN
    return ValueRange(a[0] - b[1] if a[0] > -inf and b[1] < inf else -inf, a[1] - b[0] if b[0] > -inf else inf)
