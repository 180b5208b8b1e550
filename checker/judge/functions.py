"""Functions of numbers, and whether a result conforms to one: reals within the tolerance, open values at both ends."""

import math
from collections.abc import Callable
from itertools import product

from checker.judge.values import hull, is_near, slack
from runtime.executive.record import Value


def sum_of(*terms: float) -> float:
    """The sum of numbers."""
    return sum(terms)


def product_of(*factors: float) -> float:
    """The product of numbers."""
    return math.prod(factors)


def _sine(angle: float) -> float:
    """The sine of an angle in degrees."""
    return math.sin(math.radians(angle))


def _cosine(angle: float) -> float:
    """The cosine of an angle in degrees."""
    return math.cos(math.radians(angle))


def _root(x: float) -> float:
    """The square root; what is below 0 within the tolerance counts as 0."""
    return math.sqrt(max(x, 0.0)) if x > -1e-4 else math.nan


def _power(a: float, b: float) -> float:
    """A power; not a number where there is none."""
    try:
        return math.pow(a, b)
    except (ValueError, OverflowError):
        return math.nan


def _rest(a: float, b: float) -> float:
    """The rest of a division, with the sign of the dividend."""
    return math.fmod(a, b) if b else math.nan


def _logarithm(x: float) -> float:
    """The natural logarithm."""
    return math.log(x) if x > 0 else math.nan


def _exponential(x: float) -> float:
    """e to the power of x."""
    return math.exp(x) if x < 709 else math.inf


def _travel_ticks(xa: float, ya: float, xb: float, yb: float, speed: float) -> float:
    """How long it takes from one point to another, in whole ticks, at least 1."""
    way = math.hypot(xb - xa, yb - ya)
    if speed <= 0:
        return 1 if way == 0 else math.nan
    return max(1, math.ceil(way / speed))


# name -> (index of the result, function of the other arguments, whether it is monotone in each of them)
COMPUTED: dict[str, tuple[int, Callable[..., float], bool]] = {
    "addEq": (-1, sum_of, True),
    "eqSum": (0, sum_of, True),
    "mulEq": (-1, product_of, True),
    "eqProduct": (0, product_of, True),
    "eqMinimum": (0, min, True),
    "allMin": (-1, min, True),
    "eqMaximum": (0, max, True),
    "allMax": (-1, max, True),
    "absVal": (0, abs, False),
    "abs": (0, abs, False),
    "absf": (0, abs, False),
    "neg": (-1, lambda x: -x, True),
    "sqrt": (0, _root, True),
    "sqrtf": (0, _root, True),
    "floor": (0, math.floor, True),
    "floorf": (0, math.floor, True),
    "ceil": (0, math.ceil, True),
    "ceilf": (0, math.ceil, True),
    "maxf": (0, max, True),
    "minf": (0, min, True),
    "pow": (0, _power, False),
    "mod": (0, _rest, False),
    "sin": (0, _sine, False),
    "sinf": (0, _sine, False),
    "cosf": (0, _cosine, False),
    "expf": (0, _exponential, True),
    "logf": (0, _logarithm, True),
    "deg_to_rad": (0, math.radians, True),
    "calcDistance": (0, lambda xa, ya, xb, yb: math.hypot(xb - xa, yb - ya), False),
    "distanceSquares": (-1, lambda a, b: _root(a + b), True),
    "diffSquare": (-1, lambda a, b: (a - b) ** 2, False),
    "travelTime": (0, _travel_ticks, False),
}


def conforms(
    result: Value, function: Callable[..., float], inputs: tuple[Value, ...], monotone: bool = True
) -> bool | None:
    """Whether `result` is what `function` gives for the inputs; open ones are taken at both ends if it is monotone."""
    if not isinstance(result, tuple) and not has_open(inputs):
        expected = function(*inputs)
        if result == expected:
            return True
        if not any(isinstance(each, float) for each in (result, expected, *inputs)):
            return False
        if is_near(float(result), expected):
            return True
        lowest, highest = reach(function, inputs)
        if lowest is None or highest is None:
            return False
        margin = slack(max(abs(lowest), abs(highest))) if isinstance(result, float) else 0.0
        return lowest - margin <= float(result) <= highest + margin
    if not monotone:
        return None
    lowest, highest = reach(function, inputs)
    ours = hull(result)
    if ours is None or lowest is None or highest is None:
        return None
    return None if ours[0] <= highest and lowest <= ours[1] else False


def reach(function: Callable[..., float], inputs: tuple[Value, ...]) -> tuple[float | None, float | None]:
    """The least and greatest of `function` at the corners of its inputs; None where it is not defined there."""
    ends = [hull(each) for each in inputs]
    known = [each for each in ends if each is not None]
    if len(known) < len(ends):
        return None, None
    try:
        found = [function(*corner) for corner in product(*[dict.fromkeys(each) for each in known])]
    except (ValueError, OverflowError):
        return None, None
    good = [each for each in found if not math.isnan(each)]
    if not good or (len(good) < len(found) and any(math.isinf(x) for each in known for x in each)):
        return None, None
    return min(good), max(good)


def has_open(values: tuple[Value, ...]) -> bool:
    """Whether a value was never fixed."""
    return any(isinstance(each, tuple) for each in values)


def result_index(name: str, count: int) -> int:
    """Which of the arguments of a function is its result; -1 if it is no function."""
    if name not in COMPUTED:
        return -1
    return 0 if COMPUTED[name][0] == 0 else count - 1
