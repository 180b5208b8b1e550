"""What each named constraint of the language, and a bound, means as a claim of z3 over exact numbers.

Written from the language's table (nddl_lang/semantics/constraints.py), not from the engine. Truth values are 0 and 1,
names are whole numbers. A constraint that is not here has no translation, and is named by whoever asked.
"""

from collections.abc import Callable, Sequence
from itertools import combinations, pairwise
from math import isinf
from typing import Any

import z3

from checker.judge.values import ENDLESS
from runtime.plan.readout.names import VariableName
from runtime.plan.readout.statements import Argument, Term

_NAMED = ("symbol", "object", "string")  # kinds whose values are names
Number = Any  # z3.ArithRef: z3 tells type checkers nothing
Claim = Any  # z3.BoolRef
Meaning = Callable[[Sequence[Number]], Claim | None]


def claim_of(name: str, numbers: Sequence[Number]) -> Claim | None:
    """What the constraint `name` demands of its arguments; None where it has no translation."""
    meaning = _MEANINGS.get(name)
    return None if meaning is None else meaning(numbers)


def bounds_claim(term: Term, number: Callable[[Argument], Number]) -> Claim:
    """What the bounds of a variable demand, by its numbers; nothing where it is infinite, as a capacity without end."""
    variable, lower, upper = term.arguments
    target = number(variable)
    if term.values and isinstance(variable, VariableName) and variable.kind in _NAMED:
        return z3.Or(*[target == number(value) for value in term.values])
    parts = []
    if not (isinstance(lower, int | float) and (lower <= -ENDLESS or isinf(lower))):
        parts.append(target >= number(lower))
    if not (isinstance(upper, int | float) and (upper >= ENDLESS or isinf(upper))):
        parts.append(target <= number(upper))
    return z3.And(*parts)


def member_claim(term: Term, number: Callable[[Argument], Number]) -> Claim:
    """What `a.b` of an object `a` that was open demands: it is the `b` of one of the objects, and `a` is that one."""
    result, index, *members = (number(one) for one in term.arguments)
    objects = [number(name) for name in term.values]
    return z3.Or(*[z3.And(index == one, result == member) for one, member in zip(objects, members, strict=True)])


def is_silent(name: str) -> bool:
    """Whether a constraint says nothing about values."""
    return name in _SILENT


def _real(x: Number) -> Number:
    return z3.ToReal(x) if z3.is_int(x) else x


def _floor(x: Number) -> Number:
    return x if z3.is_int(x) else z3.ToInt(x)


def _ceiling(x: Number) -> Number:
    return x if z3.is_int(x) else -z3.ToInt(-x)


def _sum(numbers: Sequence[Number]) -> Number:
    return sum(numbers[1:], start=numbers[0])


def _product(numbers: Sequence[Number]) -> Number:
    result = numbers[0]
    for each in numbers[1:]:
        result = result * each
    return result


def _size(x: Number) -> Number:
    return z3.If(x >= 0, x, -x)


def _extreme(result: Number, rest: Sequence[Number], *, greatest: bool) -> Claim:
    bounds = [result >= each if greatest else result <= each for each in rest]
    return z3.And(*bounds, z3.Or(*[result == each for each in rest]))


def _quotient(n: Sequence[Number]) -> Claim:
    a, b, result = n
    return z3.And(b != 0, a == b * result)


def _root(result: Number, square: Number) -> Claim:
    return z3.And(result >= 0, _real(result) * _real(result) == square)


def _remainder(n: Sequence[Number]) -> Claim | None:
    """The rest of a division of whole numbers, with the sign of the dividend."""
    result, a, b = n
    if not (z3.is_int(a) and z3.is_int(b)):
        return None
    rest = _size(a) % z3.If(b == 0, z3.IntVal(1), _size(b))
    return z3.And(b != 0, result == z3.If(a >= 0, rest, -rest))


def _power(n: Sequence[Number]) -> Claim | None:
    """A power with a small whole exponent."""
    result, a, b = n
    exponent = z3.simplify(b)
    known = exponent.as_fraction() if z3.is_rational_value(exponent) else None
    whole = exponent.as_long() if z3.is_int_value(exponent) else None
    if known is not None and known.denominator == 1:
        whole = known.numerator
    if whole is None or not 0 <= whole <= 8:
        return None
    return result == (_product([a] * whole) if whole else 1)


def _distance(n: Sequence[Number]) -> Claim:
    result, xa, ya, xb, yb = n
    east, north = _real(xa) - _real(xb), _real(ya) - _real(yb)
    return _root(result, east * east + north * north)


def _travel(n: Sequence[Number]) -> Claim:
    """Whole ticks for a way at a speed, at least 1."""
    ticks, xa, ya, xb, yb, speed = n
    way = z3.FreshReal("way")
    east, north = _real(xa) - _real(xb), _real(ya) - _real(yb)
    need = _real(ticks) * _real(speed)
    exact = z3.Or(z3.And(ticks == 1, way <= need), z3.And(ticks > 1, need >= way, need - _real(speed) < way))
    return z3.And(
        _root(way, east * east + north * north), z3.Or(z3.And(way == 0, ticks == 1), z3.And(speed > 0, exact))
    )


def _all_differ(n: Sequence[Number]) -> Claim:
    return z3.And(*[a != b for a, b in combinations(n, 2)])


def _all_equal(n: Sequence[Number]) -> Claim:
    return z3.And(*[a == b for a, b in pairwise(n)])


def _reified(meaning: Callable[[Sequence[Number]], Claim]) -> Meaning:
    """The first argument tells whether the rest satisfy `meaning`."""
    return lambda n: (n[0] != 0) == meaning(n[1:])


def _counted(n: Sequence[Number], *, of_zeroes: bool) -> Claim:
    return n[0] == _sum([z3.If((each == 0) == of_zeroes, z3.IntVal(1), z3.IntVal(0)) for each in n[1:]])


_MEANINGS: dict[str, Meaning] = {
    "addEq": lambda n: n[0] + n[1] == n[2],
    "eqSum": lambda n: n[0] == _sum(n[1:]),
    "mulEq": lambda n: n[0] * n[1] == n[2],
    "eqProduct": lambda n: n[0] == _product(n[1:]),
    "divEq": _quotient,
    "eqMinimum": lambda n: _extreme(n[0], n[1:], greatest=False),
    "allMin": lambda n: _extreme(n[-1], n[:-1], greatest=False),
    "minf": lambda n: _extreme(n[0], n[1:], greatest=False),
    "eqMaximum": lambda n: _extreme(n[0], n[1:], greatest=True),
    "allMax": lambda n: _extreme(n[-1], n[:-1], greatest=True),
    "maxf": lambda n: _extreme(n[0], n[1:], greatest=True),
    "absVal": lambda n: n[0] == _size(n[1]),
    "abs": lambda n: n[0] == _size(n[1]),
    "absf": lambda n: n[0] == _size(n[1]),
    "neg": lambda n: n[0] == -n[1],
    "floor": lambda n: n[0] == _floor(n[1]),
    "floorf": lambda n: n[0] == _floor(n[1]),
    "ceil": lambda n: n[0] == _ceiling(n[1]),
    "ceilf": lambda n: n[0] == _ceiling(n[1]),
    "sqrt": lambda n: _root(n[0], n[1]),
    "sqrtf": lambda n: _root(n[0], n[1]),
    "pow": _power,
    "mod": _remainder,
    "calcDistance": _distance,
    "distanceSquares": lambda n: _root(n[2], _real(n[0]) + _real(n[1])),
    "diffSquare": lambda n: n[2] == (n[0] - n[1]) * (n[0] - n[1]),
    "travelTime": _travel,
    "rand": lambda n: z3.And(n[0] >= 0, n[0] <= 32767),
    "withinBounds": lambda n: z3.And(n[1] <= n[0], n[0] <= n[2]),
    "eq": _all_equal,
    "concurrent": _all_equal,
    "neq": lambda n: n[0] != n[1],
    "leq": lambda n: n[0] <= n[1],
    "precedes": lambda n: n[0] <= n[1],
    "lt": lambda n: n[0] < n[1],
    "strictlyPrecedes": lambda n: n[0] < n[1],
    "temporalDistance": lambda n: n[2] - n[0] == n[1],
    "allDiff": _all_differ,
    "or": lambda n: z3.Or(*[each != 0 for each in n]),
    "countZeroes": lambda n: _counted(n, of_zeroes=True),
    "countNonZeroes": lambda n: _counted(n, of_zeroes=False),
    "subsetOf": lambda n: n[0] == n[1],
    "testEq": _reified(lambda n: n[0] == n[1]),
    "testNeq": _reified(lambda n: n[0] != n[1]),
    "testLeq": _reified(lambda n: n[0] <= n[1]),
    "testLessThan": _reified(lambda n: n[0] < n[1]),
    "testAnd": _reified(lambda n: z3.And(n[0] != 0, n[1] != 0)),
    "testOr": _reified(lambda n: z3.Or(*[each != 0 for each in n])),
    "testNot": _reified(lambda n: n[0] == 0),
    "condAllDiff": _reified(_all_differ),
    "condEq": _reified(_all_equal),
    "sane_pos": lambda n: z3.And(n[0] >= -90, n[0] <= 90, n[1] >= -360, n[1] <= 360),
}
_SILENT = frozenset({"isExternal", "isInternal", "ll_offset", "is_empty", "car", "cdr", "uses"})
