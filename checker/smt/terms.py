"""Terms of a conflict as z3 claims: those of the registry's rows, of which propagators know nothing.

Numbers are exact: whole numbers as Int, floats as Real with the rational value of the double. Truth values are 0 and 1,
symbols, objects and texts are whole numbers. A term that has no translation is named, never guessed.
"""

import math
from collections.abc import Sequence
from fractions import Fraction

import z3

from checker.proofs.claims import Claim, Number, bounds_claim, member_claim
from checker.proofs.operands import rational
from runtime.constraints.propagators.registry import BY_NAME
from runtime.executive.outcome import Conflict
from runtime.plan.readout.names import VariableName
from runtime.plan.readout.statements import Argument, Term


class Terms:
    """The terms of one conflict: its variables as z3 constants, its symbols as numbers."""

    def __init__(self, conflict: Conflict, freed: frozenset[str] = frozenset()) -> None:
        self.variables = conflict.variables
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
            return bounds_claim(term, self.number)
        if term.name == "memberOf":
            return member_claim(term, self.number)
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
