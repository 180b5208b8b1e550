"""What each named constraint of the language means for values: true, false, or None where the values leave it open.

Written from the language's table (nddl_lang/semantics/constraints.py), not from the engine. Whole numbers are exact.
A function of reals conforms if its result lies in the range that it has while each real moves within the tolerance.
"""

from collections.abc import Callable
from math import hypot

from checker.judge.functions import COMPUTED, conforms, product_of, sum_of
from checker.judge.values import TOLERANCE, hull, is_near, is_open, lies_within, may_be_equal, slack
from runtime.executive.record import Value, ValueRange

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


def _differ(a: Value, b: Value) -> bool | None:
    """Whether `a` differs from `b`; reals that are near may do either."""
    if isinstance(a, tuple) or isinstance(b, tuple):
        return None if may_be_equal(a, b) else True
    if a == b:
        return False
    if isinstance(a, str) or isinstance(b, str):
        return True
    return None if is_near(a, b) else True


def _at_most(a: Value, b: Value) -> bool | None:
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


def _below(a: Value, b: Value) -> bool | None:
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


def _is_below(a: Value, b: Value) -> bool | None:
    """The truth of `a < b`; of reals that are near either may be said."""
    if isinstance(a, (int, float)) and isinstance(b, (int, float)) and a < b and is_near(a, b):
        return None
    return _below(a, b)


def is_true(value: Value) -> bool | None:
    """Whether a truth value, or a number, is true."""
    if isinstance(value, ValueRange):
        return True if value.lower > 0 or value.upper < 0 else None
    return None if isinstance(value, tuple) else value != 0


# ---- logic ----


def _all_of(answers: list[bool | None]) -> bool | None:
    """Conjunction."""
    if False in answers:
        return False
    return None if None in answers else True


def _any_of(answers: list[bool | None]) -> bool | None:
    """Disjunction."""
    if True in answers:
        return True
    return None if None in answers else False


def _equals(*values: Value) -> bool | None:
    """All are equal."""
    if len(values) == 2:
        return equal(values[0], values[1])
    return _all_of([equal(values[0], each) for each in values[1:]])


def _all_differ(*values: Value) -> bool | None:
    """No two are equal."""
    return _all_of([_differ(a, b) for k, a in enumerate(values) for b in values[k + 1 :]])


def _disjunction(*values: Value) -> bool | None:
    """At least one is true."""
    return _any_of([is_true(each) for each in values])


def _tells(truth: Value, answer: bool | None) -> bool | None:
    """Whether `truth` is the answer."""
    said = is_true(truth)
    return None if said is None or answer is None else said == answer


def _reified(meaning: Meaning) -> Meaning:
    """The constraint whose first argument tells whether the rest satisfy `meaning`."""

    def check(truth: Value, *rest: Value) -> bool | None:
        return _tells(truth, meaning(*rest))

    return check


def _both(a: Value, b: Value) -> bool | None:
    """Conjunction of two truth values."""
    return _all_of([is_true(a), is_true(b)])


def negation(a: Value) -> bool | None:
    """Negation of a truth value."""
    said = is_true(a)
    return None if said is None else not said


def _counted(number: Value, answers: list[bool | None]) -> bool | None:
    """Whether `number` of the answers are true."""
    least, most = answers.count(True), len(answers) - answers.count(False)
    if not lies_within(number, least, most):
        return False
    return True if least == most and not is_open(number) else None


def _count_zeroes(number: Value, *values: Value) -> bool | None:
    """`number` of the rest are 0."""
    return _counted(number, [negation(each) for each in values])


def _count_others(number: Value, *values: Value) -> bool | None:
    """`number` of the rest are not 0."""
    return _counted(number, [is_true(each) for each in values])


# ---- times ----


def _distance(earlier: Value, gap: Value, later: Value) -> bool | None:
    """`later - earlier` lies in `gap`."""
    return conforms(later, sum_of, (earlier, gap))


def _within_bounds(x: Value, lower: Value, upper: Value) -> bool | None:
    """The least of `lower` <= x <= the greatest of `upper`."""
    ends = hull(lower), hull(upper)
    return None if ends[0] is None or ends[1] is None else lies_within(x, ends[0][0], ends[1][1]) or False


def _computed(index: int, function: Callable[..., float], monotone: bool) -> Meaning:
    """The constraint that the argument at `index` is the function of the others."""
    if index == 0:
        return lambda result, *inputs: conforms(result, function, inputs, monotone)
    return lambda *values: conforms(values[-1], function, values[:-1], monotone)


def _quotient(a: Value, b: Value, result: Value) -> bool | None:
    """`a ÷ b` without rest."""
    return False if b == 0 else conforms(a, product_of, (b, result))


def _random_number(result: Value) -> bool | None:
    """A whole number of 16 bits."""
    return lies_within(result, 0, 32767) or False


def _listed(x: Value, y: Value) -> bool | None:
    """x takes only values that y may take."""
    return None if may_be_equal(x, y) else False


def _sane(latitude: Value, longitude: Value, *_: Value) -> bool | None:
    """A position on the earth."""
    return lies_within(latitude, -90, 90) and lies_within(longitude, -360, 360)


def _points(*values: Value) -> bool | None:
    """Whether (ux, uy) is the unit vector from (x, y) to (tx, ty), (0, 0) where they coincide.

    Points that are moved within the tolerance turn it, the more the nearer they are to each other.
    """
    if any(not isinstance(each, (int, float)) for each in values):
        return None
    ux, uy, x, y, tx, ty = (float(each) for each in values)  # type: ignore[arg-type]
    way = hypot(tx - x, ty - y)
    if way == 0:
        return is_near(ux, 0.0) and is_near(uy, 0.0)
    turned = 4 * slack(max(abs(x), abs(y), abs(tx), abs(ty))) / way
    if turned >= 1:
        return None
    margin = TOLERANCE + turned
    return abs(ux - (tx - x) / way) <= margin and abs(uy - (ty - y) / way) <= margin


MEANINGS: dict[str, Meaning] = {
    **{name: _computed(*row) for name, row in COMPUTED.items()},
    "eq": _equals,
    "concurrent": equal,
    "neq": _differ,
    "leq": _at_most,
    "precedes": _at_most,
    "towards": _points,
    "lt": _below,
    "strictlyPrecedes": _below,
    "temporalDistance": _distance,
    "divEq": _quotient,
    "rand": _random_number,
    "withinBounds": _within_bounds,
    "allDiff": _all_differ,
    "or": _disjunction,
    "countZeroes": _count_zeroes,
    "countNonZeroes": _count_others,
    "subsetOf": _listed,
    "testEq": _reified(equal),
    "testNeq": _reified(_differ),
    "testLeq": _reified(_at_most),
    "testLessThan": _reified(_is_below),
    "testAnd": _reified(_both),
    "testOr": _reified(_disjunction),
    "testNot": _reified(negation),
    "condAllDiff": _reified(_all_differ),
    "condEq": _reified(_equals),
    "sane_pos": _sane,
}

# Constraints that say nothing about values.
SILENT = frozenset({"isExternal", "isInternal", "ll_offset", "is_empty", "car", "cdr"})

TESTS: dict[str, Meaning] = {
    "testEq": equal,
    "testNeq": _differ,
    "testLeq": _at_most,
    "testLessThan": _is_below,
    "testAnd": _both,
    "testOr": _disjunction,
    "testNot": negation,
    "condAllDiff": _all_differ,
    "condEq": _equals,
}
