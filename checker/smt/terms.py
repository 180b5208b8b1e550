"""Say in z3's words what a conflict's terms demand; independent of the engine's propagators.

Numbers are exact: whole numbers as Int, floats as Real with the rational value of the double. Truth values are 0 and 1,
symbols, objects and texts are whole numbers. A term that has no translation is named, never guessed.
"""

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

import z3

from runtime.executive.outcome import Conflict
from runtime.plan.readout.names import VariableName
from runtime.plan.readout.statements import Argument, Term

_ENGINE_INFINITY = 2.0**51  # bounds beyond count as infinite (docs/engine.md)
_NAMED = ("symbol", "object", "string")  # kinds whose values are names
Number = Any  # z3.ArithRef: z3 tells type checkers nothing
Claim = Any  # z3.BoolRef
Encoder = Callable[[Sequence[Number]], Claim | None]


class Vocabulary:
    """The variables of one conflict as z3 constants, and its symbols as numbers."""

    def __init__(self, conflict: Conflict, freed: frozenset[str] = frozenset()) -> None:
        operands = (one for element in conflict.elements for term in element.terms for one in term.arguments)
        self.variables = tuple(dict.fromkeys(one for one in operands if isinstance(one, VariableName)))
        self.freed = freed
        self._symbols: dict[str, int] = {}

    def number(self, operand: Argument) -> Number:
        """A variable, a number, or the number of a symbol."""
        match operand:
            case VariableName():
                name = f"{operand.reactor}:{operand}"
                return z3.Real(name) if operand.kind == "float" else z3.Int(name)
            case str():
                return z3.IntVal(self._symbols.setdefault(operand, len(self._symbols)))
            case int():
                return z3.IntVal(int(operand))
            case _:
                return rational(Fraction(operand))

    def parameter(self, name: str) -> Number:
        """The value of a sampled parameter, where it is free."""
        return z3.Real(f"sampled {name}")

    def base(self) -> list[Claim]:
        """What holds of the variables by their kinds."""
        truths = [self.number(variable) for variable in self.variables if variable.kind == "bool"]
        return [z3.And(truth >= 0, truth <= 1) for truth in truths]

    def encode(self, term: Term) -> Claim | None:
        """What `term` demands; None where it has no translation."""
        if term.name == "bounds":
            return self._bounds(term)
        if term.name == "sampledParameter":
            variable, name, value = term.arguments[:3]
            target = self.number(variable)
            return target == (self.parameter(str(name)) if name in self.freed else self.number(value))
        if any(isinstance(one, float) and not math.isfinite(one) for one in term.arguments):
            return None
        encoder = ENCODERS.get(term.name)
        return None if encoder is None else encoder([self.number(one) for one in term.arguments])

    def _bounds(self, term: Term) -> Claim:
        variable, lower, upper = term.arguments
        number = self.number(variable)
        if term.values and isinstance(variable, VariableName) and variable.kind in _NAMED:
            return z3.Or(*[number == self.number(value) for value in term.values])
        parts = []
        if not (isinstance(lower, int | float) and lower <= -_ENGINE_INFINITY):
            parts.append(number >= self.number(lower))
        if not (isinstance(upper, int | float) and upper >= _ENGINE_INFINITY):
            parts.append(number <= self.number(upper))
        return z3.And(*parts)


def rational(value: Fraction) -> Number:
    """An exact real."""
    return z3.Q(value.numerator, value.denominator)


def _real(x: Number) -> Number:
    return z3.ToReal(x) if x.is_int() else x


def _floor(x: Number) -> Number:
    return x if x.is_int() else z3.ToInt(x)


def _truth(x: Number) -> Claim:
    return x != 0


def _total(items: Sequence[Number]) -> Number:
    total = items[0]
    for item in items[1:]:
        total = total + item
    return total


def _product(items: Sequence[Number]) -> Number:
    product = items[0]
    for item in items[1:]:
        product = product * item
    return product


def _greatest(result: Number, items: Sequence[Number]) -> Claim:
    return z3.And(*[result >= item for item in items], z3.Or(*[result == item for item in items]))


def _least(result: Number, items: Sequence[Number]) -> Claim:
    return z3.And(*[result <= item for item in items], z3.Or(*[result == item for item in items]))


def _all_equal(items: Sequence[Number]) -> Claim:
    return z3.And(*[one == other for one, other in pairwise(items)])


def _all_different(items: Sequence[Number]) -> Claim:
    return z3.And(*[one != other for place, one in enumerate(items) for other in items[place + 1 :]])


def _tells(truth: Number, claim: Claim) -> Claim:
    return _truth(truth) == claim


def _root(result: Number, square: Number) -> Claim:
    return z3.And(result >= 0, _real(result) * _real(result) == square)


def _count(items: Sequence[Number], *, of_zeroes: bool) -> Number:
    return _total([z3.If((item == 0) == of_zeroes, z3.IntVal(1), z3.IntVal(0)) for item in items])


def _distance(a: Sequence[Number]) -> Claim:
    east, north = _real(a[1]) - _real(a[3]), _real(a[2]) - _real(a[4])
    return _root(a[0], east * east + north * north)


def _rest(result: Number, x: Number, y: Number) -> Claim | None:
    return z3.And(y != 0, result == x % y) if x.is_int() and y.is_int() else None


ENCODERS: dict[str, Encoder] = {
    "precedence": lambda a: a[1] - a[0] <= a[2],
    "eq": _all_equal,
    "neq": lambda a: a[0] != a[1],
    "leq": lambda a: a[0] <= a[1],
    "lt": lambda a: a[0] < a[1],
    "concurrent": lambda a: a[0] == a[1],
    "precedes": lambda a: a[0] <= a[1],
    "strictlyPrecedes": lambda a: a[0] < a[1],
    "temporalDistance": lambda a: a[2] - a[0] == a[1],
    "addEq": lambda a: a[0] + a[1] == a[2],
    "mulEq": lambda a: a[0] * a[1] == a[2],
    "divEq": lambda a: z3.And(a[1] != 0, a[0] == a[1] * a[2]),
    "eqSum": lambda a: a[0] == _total(a[1:]),
    "eqProduct": lambda a: a[0] == _product(a[1:]),
    "eqMaximum": lambda a: _greatest(a[0], a[1:]),
    "eqMinimum": lambda a: _least(a[0], a[1:]),
    "allMax": lambda a: _greatest(a[-1], a[:-1]),
    "allMin": lambda a: _least(a[-1], a[:-1]),
    "maxf": lambda a: _greatest(a[0], a[1:3]),
    "minf": lambda a: _least(a[0], a[1:3]),
    "absVal": lambda a: a[0] == z3.If(a[1] >= 0, a[1], -a[1]),
    "abs": lambda a: a[0] == z3.If(a[1] >= 0, a[1], -a[1]),
    "absf": lambda a: a[0] == z3.If(a[1] >= 0, a[1], -a[1]),
    "neg": lambda a: a[0] == -a[1],
    "sqrt": lambda a: _root(a[0], a[1]),
    "sqrtf": lambda a: _root(a[0], a[1]),
    "floor": lambda a: a[0] == _floor(a[1]),
    "floorf": lambda a: a[0] == _floor(a[1]),
    "ceil": lambda a: a[0] == -_floor(-a[1]),
    "ceilf": lambda a: a[0] == -_floor(-a[1]),
    "mod": lambda a: _rest(a[0], a[1], a[2]),
    "distanceSquares": lambda a: _root(a[2], a[0] + a[1]),
    "diffSquare": lambda a: a[2] == (a[0] - a[1]) * (a[0] - a[1]),
    "calcDistance": _distance,
    "withinBounds": lambda a: z3.And(a[1] <= a[0], a[0] <= a[2]),
    "allDiff": _all_different,
    "or": lambda a: z3.Or(*[_truth(item) for item in a]),
    "countZeroes": lambda a: a[0] == _count(a[1:], of_zeroes=True),
    "countNonZeroes": lambda a: a[0] == _count(a[1:], of_zeroes=False),
    "testEq": lambda a: _tells(a[0], a[1] == a[2]),
    "testNeq": lambda a: _tells(a[0], a[1] != a[2]),
    "testLeq": lambda a: _tells(a[0], a[1] <= a[2]),
    "testLessThan": lambda a: _tells(a[0], a[1] < a[2]),
    "testAnd": lambda a: _tells(a[0], z3.And(_truth(a[1]), _truth(a[2]))),
    "testOr": lambda a: _tells(a[0], z3.Or(_truth(a[1]), _truth(a[2]))),
    "condEq": lambda a: _tells(a[0], _all_equal(a[1:])),
    "condAllDiff": lambda a: _tells(a[0], _all_different(a[1:])),
}
