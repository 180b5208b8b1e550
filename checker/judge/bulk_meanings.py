"""What constraints mean for many rows at once: where they plainly hold, and what they make of the other arguments.

The meanings are those of `meanings.py` and `functions.py`, on arrays. A row in which a constraint does not plainly hold
is told nothing about: the judge of single tokens looks at it.
"""

from collections.abc import Callable, Sequence
from functools import reduce

import numpy as np

from checker.judge.columns import FLOAT, INT, TEXT, Array, Column, Mask
from checker.judge.values import RELATIVE, TOLERANCE

_AND = np.logical_and.reduce

Holds = Callable[..., Mask]
Truths = Callable[..., tuple[Mask, Mask]]  # where it holds, where it does not; in between nothing is said


def near(a: Column, b: Column) -> Mask:
    """Where two single values are equal, as `values.is_near` has it."""
    if a.kind == TEXT or b.kind == TEXT:
        return (a.lower == b.lower) if a.kind == b.kind else np.zeros(len(a.lower), bool)
    x, y = a.lower, b.lower
    same: Mask = x == y
    if (a.kind == INT and b.kind == INT) or _all_rows(same):
        return same
    gap = np.abs(x - y)
    close: Mask = gap <= TOLERANCE
    if _all_rows(close):
        return close
    margin = TOLERANCE + RELATIVE * np.maximum(np.abs(x), np.abs(y))
    return np.asarray(same | ((gap <= margin) & np.isfinite(margin)))


def _all_rows(mask: Mask) -> bool:
    """Whether something holds in all rows."""
    return bool(_AND(mask))


def _differ(a: Column, b: Column) -> tuple[Mask, Mask]:
    if TEXT in (a.kind, b.kind):
        return ~near(a, b), near(a, b)
    return ~near(a, b), np.asarray(a.lower == b.lower)


def _equal(a: Column, b: Column) -> tuple[Mask, Mask]:
    return near(a, b), ~near(a, b)


def _at_most(a: Column, b: Column) -> tuple[Mask, Mask]:
    """Of whole numbers also where they were never fixed, as AGENT_CLOCK is."""
    if not are_numbers(a, b):
        return np.zeros(1, bool), np.zeros(1, bool)
    most_of_a, most_of_b = (each.lower if each.upper is None else each.upper for each in (a, b))
    holds = np.asarray(most_of_a <= b.lower)
    fails = a.lower > most_of_b
    return holds, fails if a.kind == INT and b.kind == INT else fails & ~near(a, b)


def _is_at_most(a: Column, b: Column) -> Mask:
    return np.asarray(a.lower <= b.lower) if are_numbers(a, b) else np.zeros(1, bool)


def _below(a: Column, b: Column) -> tuple[Mask, Mask]:
    holds = _is_less(a, b)
    if not are_numbers(a, b):
        return holds, holds
    return holds, ~holds & (np.asarray(a.lower == b.lower) | ~near(a, b))


def _is_less(a: Column, b: Column) -> Mask:
    return np.asarray(a.lower < b.lower) if are_numbers(a, b) else np.zeros(1, bool)


def _is_below(a: Column, b: Column) -> tuple[Mask, Mask]:
    holds, fails = _below(a, b)
    return holds & ~near(a, b), fails


def are_numbers(*columns: Column) -> bool:
    """Whether no column holds texts."""
    for each in columns:  # noqa: SIM110 - called for each constraint: a generator would cost more than the rest
        if each.kind == TEXT:
            return False
    return True


def truth(a: Column) -> tuple[Mask, Mask]:
    """Where a truth value, or a number, is true; and where it is false."""
    if a.kind == TEXT:
        return np.zeros(1, bool), np.zeros(1, bool)
    holds = np.asarray(a.lower != 0)
    return holds, ~holds


def _both(a: Column, b: Column) -> tuple[Mask, Mask]:
    (x, not_x), (y, not_y) = truth(a), truth(b)
    return x & y, not_x | not_y


def _either(*columns: Column) -> tuple[Mask, Mask]:
    found = [truth(each) for each in columns]
    return reduce(np.logical_or, [x for x, _ in found]), reduce(np.logical_and, [y for _, y in found])


def _negation(a: Column) -> tuple[Mask, Mask]:
    holds, fails = truth(a)
    return fails, holds


TRUTHS: dict[str, Truths] = {
    "testEq": _equal,
    "testNeq": _differ,
    "testLeq": _at_most,
    "testLessThan": _is_below,
    "testAnd": _both,
    "testOr": _either,
    "testNot": _negation,
}


# ---- functions ----


def _sum(*columns: Column) -> Array:
    total = columns[0].lower
    for each in columns[1:]:
        total = total + each.lower
    return total


def _product(*columns: Column) -> Array:
    total = columns[0].lower
    for each in columns[1:]:
        total = total * each.lower
    return total


def _least(*columns: Column) -> Array:
    return np.asarray(reduce(np.minimum, [each.lower for each in columns]))


def _greatest(*columns: Column) -> Array:
    return np.asarray(reduce(np.maximum, [each.lower for each in columns]))


def _root(x: Column) -> Array:
    return np.where(x.lower > -1e-4, np.sqrt(np.maximum(x.lower, 0.0)), np.nan)


def _rest(a: Column, b: Column) -> Array:
    return np.where(b.lower != 0, np.fmod(a.lower.astype(float), b.lower), np.nan)


def _distance(xa: Column, ya: Column, xb: Column, yb: Column) -> Array:
    return _length(xb.lower - xa.lower, yb.lower - ya.lower)


def _length(x: Array, y: Array) -> Array:
    return np.asarray(np.sqrt(x * x + y * y))


def _square(a: Column, b: Column) -> Array:
    return np.asarray((a.lower - b.lower) ** 2)


# By name: the function of all arguments but the result, and the kind of its value; empty: that of its inputs.
FUNCTIONS: dict[str, tuple[Callable[..., Array], str]] = {
    "addEq": (_sum, ""),
    "eqSum": (_sum, ""),
    "mulEq": (_product, ""),
    "eqProduct": (_product, ""),
    "eqMinimum": (_least, ""),
    "allMin": (_least, ""),
    "eqMaximum": (_greatest, ""),
    "allMax": (_greatest, ""),
    "maxf": (_greatest, ""),
    "minf": (_least, ""),
    "absVal": (lambda x: np.abs(x.lower), ""),
    "abs": (lambda x: np.abs(x.lower), ""),
    "absf": (lambda x: np.abs(x.lower), ""),
    "neg": (lambda x: -x.lower, ""),
    "sqrt": (_root, FLOAT),
    "sqrtf": (_root, FLOAT),
    "floor": (lambda x: np.floor(x.lower), INT),
    "floorf": (lambda x: np.floor(x.lower), INT),
    "ceil": (lambda x: np.ceil(x.lower), INT),
    "ceilf": (lambda x: np.ceil(x.lower), INT),
    "mod": (_rest, FLOAT),
    "sin": (lambda x: np.sin(np.radians(x.lower)), FLOAT),
    "sinf": (lambda x: np.sin(np.radians(x.lower)), FLOAT),
    "cosf": (lambda x: np.cos(np.radians(x.lower)), FLOAT),
    "deg_to_rad": (lambda x: np.radians(x.lower), FLOAT),
    "calcDistance": (_distance, FLOAT),
    "diffSquare": (_square, ""),
}
_HUGE = 2.0**53


def value_of(name: str, inputs: Sequence[Column]) -> Column | None:
    """The value of a function in each row, bad where it has none; None where it is not known here."""
    known = FUNCTIONS.get(name)
    if known is None or not are_numbers(*inputs):
        return None
    function, kind = known
    if not kind:
        kind = INT
        for each in inputs:
            if each.kind == FLOAT:
                kind = FLOAT
    if kind == INT:  # exact in float64 while nothing that is added up on the way is beyond the limit
        inputs = [Column(each.kind, each.lower.astype(float, copy=False)) for each in inputs]
        for each in inputs if len(inputs) > 2 else ():
            if not _all_rows(np.abs(each.lower) <= _HUGE / len(inputs)):
                return None
    return _within_limits(kind, np.asarray(function(*inputs)))


def _within_limits(kind: str, found: Array) -> Column:
    """The column of computed numbers; bad where there is none, or a whole number is not exact."""
    holds = np.abs(found) <= _HUGE if kind == INT else np.isfinite(found)
    if _all_rows(holds):
        return Column(kind, found)
    return Column(kind, np.where(holds, found, 0.0), None, ~holds)


def difference_of(later: Column, earlier: Column) -> Column | None:
    """`later - earlier` of numbers."""
    if not are_numbers(later, earlier):
        return None
    kind = INT if later.kind == INT and earlier.kind == INT else FLOAT
    return _within_limits(kind, later.lower - earlier.lower)


def conforms(result: Column, expected: Column) -> Mask:
    """Where a result plainly is what a function gives; reals within the tolerance."""
    if result.kind == INT and expected.kind == INT:
        return np.asarray(result.lower == expected.lower)
    return near(result, expected)


# ---- comparisons ----


def _all_equal(*columns: Column) -> Mask:
    if len(columns) == 2:
        return near(*columns)
    return np.asarray(reduce(np.logical_and, [near(columns[0], each) for each in columns[1:]]))


def _all_differ(*columns: Column) -> Mask:
    pairs = [_differ(a, b)[0] for k, a in enumerate(columns) for b in columns[k + 1 :]]
    return np.asarray(reduce(np.logical_and, pairs))


HOLDS: dict[str, Holds] = {
    "eq": _all_equal,
    "concurrent": near,
    "neq": lambda a, b: _differ(a, b)[0],
    "leq": _is_at_most,
    "precedes": _is_at_most,
    "lt": _is_less,
    "strictlyPrecedes": _is_less,
    "allDiff": _all_differ,
    "or": lambda *columns: _either(*columns)[0],
}


def points(*columns: Column) -> Mask:
    """Where (ux, uy) plainly is the unit vector from (x, y) to (tx, ty), as `meanings` has it."""
    if not are_numbers(*columns):
        return np.zeros(1, bool)
    ux, uy, x, y, tx, ty = (each.lower for each in columns)
    east, north = tx - x, ty - y
    way = _length(east, north)
    size = reduce(np.maximum, [np.abs(each) for each in (x, y, tx, ty)])
    turned = 4 * (TOLERANCE + RELATIVE * size) / way
    margin = TOLERANCE + turned
    return np.asarray((turned < 1) & (np.abs(ux - east / way) <= margin) & (np.abs(uy - north / way) <= margin))
