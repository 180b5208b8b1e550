"""Values of records as boxes, and what each constraint says of them: written from docs/constraints.md alone.

A number is an interval, a real one of a record as wide as the language's tolerance; a name is a set of names; None is
what is not known. An answer is False only where no values in the boxes fulfil the constraint.
"""

import math
from collections.abc import Callable, Sequence

from compiler.program import DomainConstant
from runtime.executive.record import OpenValues, Value, ValueRange

Interval = tuple[float, float]
Box = Interval | frozenset[str] | None
_ENDLESS = 2**52 - 1


def _around(value: float, part: float = 1.2e-9, least: float = 1.2e-5) -> Interval:
    width = least + part * abs(value)
    return value - width, value + width


def box_of(value: Value) -> Box:
    """What a record says of a variable."""
    match value:
        case ValueRange(lower=lower, upper=upper):
            return lower, upper
        case OpenValues(values=values):
            if all(isinstance(one, str) for one in values):
                return frozenset(map(str, values))
            parts = [box_of(one) for one in values]
            ends = [part for part in parts if isinstance(part, tuple)]
            return (min(a for a, _ in ends), max(b for _, b in ends)) if len(ends) == len(parts) else None
        case str():
            return frozenset({value})
        case float():
            return (value, value) if math.isinf(value) else _around(value)
        case _:
            return float(value), float(value)


def box_of_constant(domain: DomainConstant) -> Box:
    """The values that the text gives."""
    if domain.interval is not None:
        lower, upper = domain.interval
        return (-math.inf if lower <= -_ENDLESS else lower), (math.inf if upper >= _ENDLESS else upper)
    values = domain.values or ()
    if all(isinstance(one, str) for one in values):
        return frozenset(map(str, values))
    numbers = [float(one) for one in values]
    return min(numbers), max(numbers)


def overlap(a: Box, b: Box) -> bool | None:
    """Whether two variables may have the same value."""
    if a is None or b is None:
        return None
    if isinstance(a, frozenset) or isinstance(b, frozenset):
        return bool(a & b) if isinstance(a, frozenset) and isinstance(b, frozenset) else None
    return a[0] <= b[1] and b[0] <= a[1]


# ---- functions: boxes of the arguments in, the box of the result out ----


def _total(*parts: Interval) -> Interval:
    return sum(low for low, _ in parts), sum(high for _, high in parts)


def _minus(a: Interval, b: Interval) -> Interval:
    return a[0] - b[1], a[1] - b[0]


def _times(a: Interval, b: Interval) -> Interval:
    corners = [0.0 if 0 in (x, y) else x * y for x in a for y in b]
    return min(corners), max(corners)


def _product(*parts: Interval) -> Interval:
    found: Interval = (1.0, 1.0)
    for part in parts:
        found = _times(found, part)
    return found


def _over(a: Interval, b: Interval) -> Interval | None:
    if b[0] <= 0 <= b[1] or math.inf in (abs(b[0]), abs(b[1]), abs(a[0]), abs(a[1])):
        return None
    corners = [x / y for x in a for y in b]
    return min(corners), max(corners)


def _least(*parts: Interval) -> Interval:
    return min(low for low, _ in parts), min(high for _, high in parts)


def _most(*parts: Interval) -> Interval:
    return max(low for low, _ in parts), max(high for _, high in parts)


def _size(a: Interval) -> Interval:
    ends = sorted(map(abs, a))
    return (0.0 if a[0] <= 0 <= a[1] else ends[0]), ends[1]


def _rising(function: Callable[[float], float], least: float = -math.inf) -> Callable[[Interval], Interval | None]:
    def over(a: Interval) -> Interval | None:
        if a[1] < least or math.inf in map(abs, a):
            return None
        try:
            return function(max(a[0], least)), function(a[1])
        except (OverflowError, ValueError):
            return None

    return over


def _slow(function: Callable[..., float]) -> Callable[..., Interval | None]:
    """A function that changes no faster than its arguments do together."""

    def over(*parts: Interval) -> Interval | None:
        if any(math.isinf(end) for part in parts for end in part):
            return None
        width = sum(b - a for a, b in parts)
        middle = function(*((a + b) / 2 for a, b in parts))
        return middle - width, middle + width

    return over


def _power(a: Interval, b: Interval) -> Interval | None:
    if a[0] <= 0 or math.inf in (a[1], b[1], -b[0]):
        return None
    corners = [x**y for x in a for y in b]
    return min(corners), max(corners)


def _rest(a: Interval, b: Interval) -> Interval | None:
    if a[0] == a[1] and b[0] == b[1] != 0 and not math.isinf(a[0]):
        return (math.fmod(a[0], b[0]),) * 2
    return None


_TOL = 1e-5
_root = _rising(math.sqrt, 0.0)
_down, _up = _rising(lambda x: math.floor(x + _TOL)), _rising(lambda x: math.ceil(x - _TOL))


def _distance(x: Interval, y: Interval, u: Interval, v: Interval) -> Interval | None:
    far = [_size(_minus(x, u)), _size(_minus(y, v))]
    return math.hypot(far[0][0], far[1][0]), math.hypot(far[0][1], far[1][1])


# Name: place of the result (-1: the last), function of the others.
FUNCTIONS: dict[str, tuple[int, Callable[..., Interval | None]]] = {
    "addEq": (-1, _total),
    "mulEq": (-1, _times),
    "eqSum": (0, _total),
    "eqProduct": (0, _product),
    "eqMinimum": (0, _least),
    "eqMaximum": (0, _most),
    "allMin": (-1, _least),
    "allMax": (-1, _most),
    "divEq": (-1, _over),
    "absVal": (0, _size),
    "abs": (0, _size),
    "absf": (0, _size),
    "neg": (0, lambda a: (-a[1], -a[0])),
    "sqrt": (0, _root),
    "sqrtf": (0, _root),
    "floor": (0, _down),
    "floorf": (0, _down),
    "ceil": (0, _up),
    "ceilf": (0, _up),
    "maxf": (0, _most),
    "minf": (0, _least),
    "pow": (0, _power),
    "mod": (0, _rest),
    "sin": (0, _slow(lambda x: math.sin(math.radians(x)))),
    "sinf": (0, _slow(lambda x: math.sin(math.radians(x)))),
    "cosf": (0, _slow(lambda x: math.cos(math.radians(x)))),
    "expf": (0, _rising(math.exp)),
    "logf": (0, lambda a: _rising(math.log)(a) if a[0] > 0 else None),
    "deg_to_rad": (0, _rising(math.radians)),
    "calcDistance": (0, _distance),
    "distanceSquares": (-1, lambda a, b: _root(_total(a, b))),
    "diffSquare": (-1, lambda a, b: _times(_size(_minus(a, b)), _size(_minus(a, b)))),
}


# ---- claims: boxes in; True for all values, False for none, None for some ----


def _equal(a: Box, b: Box) -> bool | None:
    may = overlap(a, b)
    if not may:
        return may
    if isinstance(a, frozenset) and isinstance(b, frozenset):
        return True if len(a) == len(b) == 1 else None
    assert isinstance(a, tuple) and isinstance(b, tuple)
    is_narrow = max(a[1] - a[0], b[1] - b[0]) < 1e-3 and abs(a[0] + a[1] - b[0] - b[1]) < 1e-6
    return True if is_narrow else None


def _no(answer: bool | None) -> bool | None:
    return None if answer is None else not answer


def _at_most(a: Box, b: Box) -> bool | None:
    if not isinstance(a, tuple) or not isinstance(b, tuple):
        return None
    return True if a[1] <= b[0] else False if a[0] > b[1] + _TOL else None


def _less(a: Box, b: Box) -> bool | None:
    return _no(_at_most(b, a)) if a is not None and b is not None else None


def truth(a: Box) -> bool | None:
    """Whether a truth value is true."""
    return {(0.0, 0.0): False, (1.0, 1.0): True}.get(a) if isinstance(a, tuple) else None


def _both(a: Box, b: Box) -> bool | None:
    parts = (truth(a), truth(b))
    return False if False in parts else None if None in parts else True


def _either(*boxes: Box) -> bool | None:
    parts = [None if not isinstance(one, tuple) else False if one == (0, 0) else _is_not_zero(one) for one in boxes]
    return True if True in parts else None if None in parts else False


def _is_not_zero(a: Interval) -> bool | None:
    return None if a[0] <= 0 <= a[1] else True


def _all_equal(*boxes: Box) -> bool | None:
    parts = [_equal(a, b) for k, a in enumerate(boxes) for b in boxes[:k]]
    return False if False in parts else None if None in parts else True


def _all_differ(*boxes: Box) -> bool | None:
    parts = [_no(_equal(a, b)) for k, a in enumerate(boxes) for b in boxes[:k]]
    return False if False in parts else None if None in parts else True


def _apart(a: Box, distance: Box, b: Box) -> bool | None:
    if not (isinstance(a, tuple) and isinstance(b, tuple) and isinstance(distance, tuple)):
        return None
    return _equal(distance, _minus(b, a)) if overlap(distance, _minus(b, a)) else False


def _within(x: Box, low: Box, high: Box) -> bool | None:
    parts = (_at_most(low, x), _at_most(x, high))
    return False if False in parts else None if None in parts else True


CLAIMS: dict[str, Callable[..., bool | None]] = {
    "eq": _all_equal,
    "concurrent": _all_equal,
    "neq": lambda a, b: _no(_equal(a, b)),
    "leq": _at_most,
    "precedes": _at_most,
    "lt": _less,
    "strictlyPrecedes": _less,
    "allDiff": _all_differ,
    "or": _either,
    "temporalDistance": _apart,
    "withinBounds": _within,
}

# What the first argument tells the truth of.
TESTS: dict[str, Callable[..., bool | None]] = {
    "testEq": _equal,
    "testNeq": lambda a, b: _no(_equal(a, b)),
    "testLeq": _at_most,
    "testLessThan": _less,
    "testAnd": _both,
    "testOr": _either,
    "condEq": _all_equal,
    "condAllDiff": _all_differ,
}


def _known(boxes: Sequence[Box]) -> list[Interval] | None:
    found = [one for one in boxes if isinstance(one, tuple)]
    return found if len(found) == len(boxes) else None


def answer(name: str, boxes: Sequence[Box]) -> bool | None:
    """Whether a constraint holds: False only if it cannot."""
    if name in CLAIMS:
        return CLAIMS[name](*boxes)
    if name in TESTS:
        said, found = truth(boxes[0]), TESTS[name](*boxes[1:])
        return None if said is None or found is None else said == found
    if name in FUNCTIONS:
        place = FUNCTIONS[name][0] % len(boxes)
        value = computed(name, boxes, place)
        return _equal(boxes[place], value) if overlap(boxes[place], value) is not False else False
    return None


def computed(name: str, boxes: Sequence[Box], place: int) -> Box:
    """The value of an argument that the others determine; None if they do not."""
    others = [one for k, one in enumerate(boxes) if k != place]
    if name in ("eq", "concurrent"):
        return next((one for one in others if one is not None), None)
    if name in TESTS and place == 0:
        found = TESTS[name](*others)
        return None if found is None else (float(found), float(found))
    given = _known(others)
    if name not in FUNCTIONS or given is None:
        return None
    at, function = FUNCTIONS[name]
    if place == at % len(boxes):
        return function(*given)
    match name:
        case "addEq":
            return _minus(given[1], given[0])
        case "mulEq":
            return _over(given[1], given[0])
        case "divEq":
            return _times(given[0], given[1]) if place == 0 else _over(given[0], given[1])
        case "eqSum":
            return _minus(given[0], _total(*given[1:]))
        case "neg":
            return -given[0][1], -given[0][0]
    return None
