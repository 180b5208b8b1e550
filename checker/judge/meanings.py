"""What each named constraint of the language means for values: true, false, or None where the values leave it open.

Written from the language's table (nddl_lang/semantics/constraints.py), not from the engine. Whole numbers are exact.
A function of reals conforms if its result lies in the range that it has while each real moves within the tolerance.
"""

import math
from collections.abc import Callable
from itertools import product

from checker.judge.values import hull, is_near, is_open, lies_within, may_be_equal, slack
from runtime.executive.record import Interval, Value

Meaning = Callable[..., bool | None]


# ---- comparisons ----


def equal(a: Value, b: Value) -> bool | None:
    """Whether `a` equals `b`."""
    if isinstance(a, tuple) or isinstance(b, tuple):
        return None if may_be_equal(a, b) else False
    if a == b:
        return True
    if isinstance(a, str) or isinstance(b, str):
        return False
    return is_near(a, b)


def differ(a: Value, b: Value) -> bool | None:
    """Whether `a` differs from `b`; reals that are near may do either."""
    if isinstance(a, tuple) or isinstance(b, tuple):
        return None if may_be_equal(a, b) else True
    if a == b:
        return False
    if isinstance(a, str) or isinstance(b, str):
        return True
    return None if is_near(a, b) else True


def at_most(a: Value, b: Value) -> bool | None:
    """Whether `a <= b`."""
    if not isinstance(a, (tuple, str)) and not isinstance(b, (tuple, str)):
        if a <= b:
            return True
        return None if is_near(a, b) else False
    ours, theirs = hull(a), hull(b)
    if ours is None or theirs is None:
        return None
    if ours[0] > theirs[1]:
        return False
    return True if ours[1] <= theirs[0] else None


def below(a: Value, b: Value) -> bool | None:
    """Whether `a < b`."""
    if not isinstance(a, (tuple, str)) and not isinstance(b, (tuple, str)):
        if a < b:
            return True
        return None if a != b and is_near(a, b) else False
    ours, theirs = hull(a), hull(b)
    if ours is None or theirs is None:
        return None
    if ours[0] >= theirs[1]:
        return False
    return True if ours[1] < theirs[0] else None


def is_true(value: Value) -> bool | None:
    """Whether a truth value, or a number, is true."""
    if isinstance(value, Interval):
        return True if value.lower > 0 or value.upper < 0 else None
    return None if isinstance(value, tuple) else value != 0


# ---- logic ----


def all_of(answers: list[bool | None]) -> bool | None:
    """Conjunction."""
    if False in answers:
        return False
    return None if None in answers else True


def any_of(answers: list[bool | None]) -> bool | None:
    """Disjunction."""
    if True in answers:
        return True
    return None if None in answers else False


def equals(*values: Value) -> bool | None:
    """All are equal."""
    if len(values) == 2:
        return equal(values[0], values[1])
    return all_of([equal(values[0], each) for each in values[1:]])


def all_differ(*values: Value) -> bool | None:
    """No two are equal."""
    return all_of([differ(a, b) for k, a in enumerate(values) for b in values[k + 1 :]])


def disjunction(*values: Value) -> bool | None:
    """At least one is true."""
    return any_of([is_true(each) for each in values])


def tells(truth: Value, answer: bool | None) -> bool | None:
    """Whether `truth` is the answer."""
    said = is_true(truth)
    return None if said is None or answer is None else said == answer


def reified(meaning: Meaning) -> Meaning:
    """The constraint whose first argument tells whether the rest satisfy `meaning`."""

    def check(truth: Value, *rest: Value) -> bool | None:
        return tells(truth, meaning(*rest))

    return check


def both(a: Value, b: Value) -> bool | None:
    """Conjunction of two truth values."""
    return all_of([is_true(a), is_true(b)])


def negation(a: Value) -> bool | None:
    """Negation of a truth value."""
    said = is_true(a)
    return None if said is None else not said


def counted(number: Value, answers: list[bool | None]) -> bool | None:
    """Whether `number` of the answers are true."""
    least, most = answers.count(True), len(answers) - answers.count(False)
    if not lies_within(number, least, most):
        return False
    return True if least == most and not is_open(number) else None


def count_zeroes(number: Value, *values: Value) -> bool | None:
    """`number` of the rest are 0."""
    return counted(number, [negation(each) for each in values])


def count_others(number: Value, *values: Value) -> bool | None:
    """`number` of the rest are not 0."""
    return counted(number, [is_true(each) for each in values])


# ---- times ----


def distance(earlier: Value, gap: Value, later: Value) -> bool | None:
    """`later - earlier` lies in `gap`."""
    return conforms(later, sum_of, (earlier, gap))


def within_bounds(x: Value, lower: Value, upper: Value) -> bool | None:
    """The least of `lower` <= x <= the greatest of `upper`."""
    ends = hull(lower), hull(upper)
    return None if ends[0] is None or ends[1] is None else lies_within(x, ends[0][0], ends[1][1]) or False


# ---- functions ----


def sum_of(*terms: float) -> float:
    """The sum of numbers."""
    return sum(terms)


def product_of(*factors: float) -> float:
    """The product of numbers."""
    return math.prod(factors)


def sine(angle: float) -> float:
    """The sine of an angle in degrees."""
    return math.sin(math.radians(angle))


def cosine(angle: float) -> float:
    """The cosine of an angle in degrees."""
    return math.cos(math.radians(angle))


def root(x: float) -> float:
    """The square root; what is below 0 within the tolerance counts as 0."""
    return math.sqrt(max(x, 0.0)) if x > -1e-4 else math.nan


def power(a: float, b: float) -> float:
    """A power; not a number where there is none."""
    try:
        return math.pow(a, b)
    except (ValueError, OverflowError):
        return math.nan


def rest(a: float, b: float) -> float:
    """The rest of a division, with the sign of the dividend."""
    return math.fmod(a, b) if b else math.nan


def logarithm(x: float) -> float:
    """The natural logarithm."""
    return math.log(x) if x > 0 else math.nan


def exponential(x: float) -> float:
    """e to the power of x."""
    return math.exp(x) if x < 709 else math.inf


def travel_ticks(xa: float, ya: float, xb: float, yb: float, speed: float) -> float:
    """How long it takes from one point to another, in whole ticks, at least 1."""
    way = math.hypot(xb - xa, yb - ya)
    if speed <= 0:
        return 1 if way == 0 else math.nan
    return max(1, math.ceil(way / speed))


# name -> (place of the result, function of the other arguments, whether it is monotone in each of them)
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
    "sqrt": (0, root, True),
    "sqrtf": (0, root, True),
    "floor": (0, math.floor, True),
    "floorf": (0, math.floor, True),
    "ceil": (0, math.ceil, True),
    "ceilf": (0, math.ceil, True),
    "maxf": (0, max, True),
    "minf": (0, min, True),
    "pow": (0, power, False),
    "mod": (0, rest, False),
    "sin": (0, sine, False),
    "sinf": (0, sine, False),
    "cosf": (0, cosine, False),
    "expf": (0, exponential, True),
    "logf": (0, logarithm, True),
    "deg_to_rad": (0, math.radians, True),
    "calcDistance": (0, lambda xa, ya, xb, yb: math.hypot(xb - xa, yb - ya), False),
    "distanceSquares": (-1, lambda a, b: root(a + b), True),
    "diffSquare": (-1, lambda a, b: (a - b) ** 2, False),
    "travelTime": (0, travel_ticks, False),
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


def computed(place: int, function: Callable[..., float], monotone: bool) -> Meaning:
    """The constraint that the argument at `place` is the function of the others."""
    if place == 0:
        return lambda result, *inputs: conforms(result, function, inputs, monotone)
    return lambda *values: conforms(values[-1], function, values[:-1], monotone)


def quotient(a: Value, b: Value, result: Value) -> bool | None:
    """`a ÷ b` without rest."""
    return False if b == 0 else conforms(a, product_of, (b, result))


def random_number(result: Value) -> bool | None:
    """A whole number of 16 bits."""
    return lies_within(result, 0, 32767) or False


def listed(x: Value, y: Value) -> bool | None:
    """x takes only values that y may take."""
    return None if may_be_equal(x, y) else False


def sane(latitude: Value, longitude: Value, *_: Value) -> bool | None:
    """A position on the earth."""
    return lies_within(latitude, -90, 90) and lies_within(longitude, -360, 360)


MEANINGS: dict[str, Meaning] = {
    **{name: computed(*row) for name, row in COMPUTED.items()},
    "eq": equals,
    "concurrent": equal,
    "neq": differ,
    "leq": at_most,
    "precedes": at_most,
    "lt": below,
    "strictlyPrecedes": below,
    "temporalDistance": distance,
    "divEq": quotient,
    "rand": random_number,
    "withinBounds": within_bounds,
    "allDiff": all_differ,
    "or": disjunction,
    "countZeroes": count_zeroes,
    "countNonZeroes": count_others,
    "subsetOf": listed,
    "testEq": reified(equal),
    "testNeq": reified(differ),
    "testLeq": reified(at_most),
    "testLessThan": reified(below),
    "testAnd": reified(both),
    "testOr": reified(disjunction),
    "testNot": reified(negation),
    "condAllDiff": reified(all_differ),
    "condEq": reified(equals),
    "sane_pos": sane,
}

# Constraints that say nothing about values.
SILENT = frozenset({"isExternal", "isInternal", "ll_offset", "is_empty", "car", "cdr"})

TESTS: dict[str, Meaning] = {
    "testEq": equal,
    "testNeq": differ,
    "testLeq": at_most,
    "testLessThan": below,
    "testAnd": both,
    "testOr": disjunction,
    "testNot": negation,
    "condAllDiff": all_differ,
    "condEq": equals,
}


# ---- what an expression without a name is worth ----


def evaluate(function: Callable[..., float], inputs: tuple[Value, ...], monotone: bool) -> Value:
    """The value of a function; an interval where an input is open."""
    if not has_open(inputs):
        return function(*inputs)
    if not monotone:
        return Interval(-math.inf, math.inf)
    lowest, highest = reach(function, inputs)
    if lowest is None or highest is None:
        return Interval(-math.inf, math.inf)
    return Interval(lowest, highest)


def solver(name: str, place: int, count: int) -> Callable[..., Value] | None:
    """The function that gives argument `place` of constraint `name` from the other arguments; None if there is none."""
    if name in TESTS and place == 0:
        test = TESTS[name]
        return lambda *rest: _truth(test(*rest))
    if name in COMPUTED and place == (COMPUTED[name][0] if COMPUTED[name][0] == 0 else count - 1):
        _, function, monotone = COMPUTED[name]
        return lambda *rest: evaluate(function, rest, monotone)
    match name, place:
        case "addEq", _:  # of sum and the other term
            return lambda other, total: evaluate(lambda a, b: b - a, (other, total), True)
        case "divEq", 2:
            return lambda a, b: evaluate(_divide, (a, b), False)
        case "neg", 0:
            return lambda x: evaluate(lambda a: -a, (x,), True)
        case (("eq" | "concurrent"), _) if count == 2:
            return lambda x: x
        case "neq", 0:
            return lambda x: _truth(negation(x))
        case "temporalDistance", 1:
            return lambda earlier, later: evaluate(lambda a, b: b - a, (earlier, later), True)
        case "temporalDistance", 2:
            return lambda earlier, gap: evaluate(sum_of, (earlier, gap), True)
        case "temporalDistance", 0:
            return lambda gap, later: evaluate(lambda a, b: b - a, (gap, later), True)
        case _:
            return None


def _truth(answer: bool | None) -> Value:
    return Interval(0, 1) if answer is None else answer


def _divide(a: float, b: float) -> float:
    if not b:
        return math.nan
    if isinstance(a, int) and isinstance(b, int) and a % b == 0:
        return a // b
    return a / b
