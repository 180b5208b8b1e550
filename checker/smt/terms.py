"""Terms of a conflict as z3 claims: those of the registry's rows, of which propagators know nothing.

Numbers are exact: whole numbers as Int, floats as Real with the rational value of the double. Truth values are 0 and 1,
symbols, objects and texts are whole numbers. A term that has no translation is named, never guessed.
"""

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import z3

from runtime.constraints.propagators.registry import BY_NAME
from runtime.executive.outcome import Conflict, Term

_ENGINE_INFINITY = 2.0**51  # bounds beyond count as infinite (docs/engine.md)
Number = Any  # z3.ArithRef: z3 tells type checkers nothing
Claim = Any  # z3.BoolRef


class Terms:
    """The terms of one conflict: its variables as z3 constants, its symbols as numbers."""

    def __init__(self, conflict: Conflict, freed: frozenset[str] = frozenset()) -> None:
        self.kinds = {variable.name: variable.kind for variable in conflict.variables}
        self.freed = freed
        self._symbols: dict[str, int] = {}

    def number(self, argument: str | float | int) -> Number:
        """A variable, a number, or the number of a symbol."""
        if isinstance(argument, str):
            if argument in self.kinds:
                return z3.Real(argument) if self.kinds[argument] == "float" else z3.Int(argument)
            return z3.IntVal(self._symbols.setdefault(argument, len(self._symbols)))
        if isinstance(argument, int):
            return z3.IntVal(int(argument))
        return rational(Fraction(argument))

    def parameter(self, name: str) -> Number:
        """The value of a sampled parameter, where it is free."""
        return z3.Real(f"sampled {name}")

    def base(self) -> list[Claim]:
        """What holds of the variables by their kinds."""
        return [z3.And(z3.Int(name) >= 0, z3.Int(name) <= 1) for name, kind in self.kinds.items() if kind == "bool"]

    def encode(self, term: Term) -> Claim | None:
        """What `term` demands; None where it has no translation."""
        if term.name == "bounds":
            return self._bounds(*term.arguments)
        if term.name == "sampledParameter":
            variable, name, value = term.arguments[:3]
            target = self.number(variable)
            return target == (self.parameter(str(name)) if name in self.freed else self.number(value))
        if any(isinstance(one, float) and not math.isfinite(one) for one in term.arguments):
            return None
        numbers = [self.number(one) for one in term.arguments]
        if term.name == "precedence":
            return numbers[1] - numbers[0] <= numbers[2]
        row = BY_NAME.get(term.name)
        return row.claim(_Z3(), numbers) if row is not None and row.claim is not None else None

    def _bounds(self, variable: str | float | int, lower: str | float | int, upper: str | float | int) -> Claim:
        number = self.number(variable)
        parts = []
        if not (isinstance(lower, int | float) and lower <= -_ENGINE_INFINITY):
            parts.append(number >= self.number(lower))
        if not (isinstance(upper, int | float) and upper >= _ENGINE_INFINITY):
            parts.append(number <= self.number(upper))
        return z3.And(*parts)


def rational(value: Fraction) -> Number:
    """An exact real."""
    return z3.Q(value.numerator, value.denominator)


class _Z3:
    """The algebra of claims over z3's numbers."""

    def every(self, claims: Sequence[Claim]) -> Claim:
        return z3.And(*claims)

    def some(self, claims: Sequence[Claim]) -> Claim:
        return z3.Or(*claims)

    def choose(self, claim: Claim, x: Number, y: Number) -> Number:
        return z3.If(claim, x, y)

    def floor(self, x: Number) -> Number:
        return x if x.is_int() else z3.ToInt(x)

    def real(self, x: Number) -> Number:
        return z3.ToReal(x) if x.is_int() else x

    def is_whole(self, x: Number) -> bool:
        return bool(x.is_int())
