"""What each named constraint of the language means for values: true, false, or None where the values leave it open.

Written from the language's table (nddl_lang/semantics/constraints.py), not from the engine. Whole numbers are exact.
A function of reals conforms if its result lies in the range that it has while each real moves within the tolerance.
"""

from collections.abc import Callable

from checker.judge.functions import COMPUTED, conforms, product_of, sum_of
from checker.judge.values import hull, is_near, is_open, lies_within, may_be_equal
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
    if isinstance(value, ValueRange):
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
