"""Interval arithmetic over z3's expressions, exact: whether a claim holds for all values of a box, as far as it tells.

Sound and not complete: a claim that holds may be left open where a variable occurs twice. What is left is for z3.
"""

from collections.abc import Mapping
from fractions import Fraction
from math import floor, inf
from typing import Any

import z3

from checker.proofs.claims import Claim, Number
from checker.proofs.operands import name_of

Interval = tuple[Any, Any]  # Fractions, or infinite


class Ranges:
    """Ranges of expressions over the ranges of their variables."""

    def __init__(self, sides: Mapping[str, tuple[Fraction, Fraction]]) -> None:
        self.sides = sides
        self._known: dict[int, Interval] = {}
        self._kept: list[Number] = []  # an id is only good while its expression lives

    def holds(self, claim: Claim) -> bool | None:
        """Whether a claim holds everywhere (True), nowhere (False), or neither is certain."""
        kind, parts = claim.decl().kind(), claim.children()
        match kind:
            case z3.Z3_OP_TRUE:
                return True
            case z3.Z3_OP_FALSE:
                return False
            case z3.Z3_OP_NOT:
                inner = self.holds(parts[0])
                return None if inner is None else not inner
            case z3.Z3_OP_AND:
                answers = [self.holds(each) for each in parts]
                return False if False in answers else None if None in answers else True
            case z3.Z3_OP_OR:
                answers = [self.holds(each) for each in parts]
                return True if True in answers else None if None in answers else False
            case z3.Z3_OP_LE:
                return _at_most(self.range(parts[0]), self.range(parts[1]))
            case z3.Z3_OP_GE:
                return _at_most(self.range(parts[1]), self.range(parts[0]))
            case z3.Z3_OP_LT:
                return _below(self.range(parts[0]), self.range(parts[1]))
            case z3.Z3_OP_GT:
                return _below(self.range(parts[1]), self.range(parts[0]))
            case z3.Z3_OP_EQ if z3.is_arith(parts[0]):
                return _equal(self.range(parts[0]), self.range(parts[1]))
            case _:
                return None

    def range(self, number: Number) -> Interval:
        """The range of a number."""
        key = number.get_id()
        known = self._known.get(key)
        if known is None:
            known = self._known[key] = self._range(number)
            self._kept.append(number)
        return known

    def is_attained(self, number: Number) -> bool:
        """Whether the range of a number is told exactly: no variable occurs in it twice, and no condition is open."""
        seen: set[str] = set()
        waiting = [number]
        while waiting:
            one = waiting.pop()
            name = name_of(one)
            if name in seen:
                return False
            if name:
                seen.add(name)
            elif one.decl().kind() == z3.Z3_OP_ITE:
                condition, *branches = one.children()
                answer = self.holds(condition)
                if answer is None:
                    return False
                waiting.append(branches[0 if answer else 1])
            else:
                waiting += one.children()
        return True

    def _range(self, number: Number) -> Interval:
        if z3.is_int_value(number):
            return (Fraction(number.as_long()),) * 2
        if z3.is_rational_value(number):
            return (number.as_fraction(),) * 2
        name = name_of(number)
        if name:
            return self.sides.get(name, (-inf, inf))
        parts = [self.range(each) for each in number.children() if z3.is_arith(each)]
        match number.decl().kind():
            case z3.Z3_OP_ADD:
                return sum(a for a, _ in parts), sum(b for _, b in parts)
            case z3.Z3_OP_SUB if len(parts) == 2:
                return parts[0][0] - parts[1][1], parts[0][1] - parts[1][0]
            case z3.Z3_OP_UMINUS:
                return -parts[0][1], -parts[0][0]
            case z3.Z3_OP_MUL:
                found = parts[0]
                for each in parts[1:]:
                    found = _product(found, each)
                return found
            case z3.Z3_OP_DIV:
                return _quotient(parts[0], parts[1])
            case z3.Z3_OP_TO_REAL:
                return parts[0]
            case z3.Z3_OP_TO_INT:
                return _floored(parts[0])
            case z3.Z3_OP_ITE:
                answer = self.holds(number.children()[0])
                if answer is not None:
                    return parts[0] if answer else parts[1]
                return min(parts[0][0], parts[1][0]), max(parts[0][1], parts[1][1])
            case _:
                return -inf, inf


def _floored(a: Interval) -> Interval:
    return tuple(each if each in (-inf, inf) else Fraction(floor(each)) for each in a)  # type: ignore[return-value]


def _product(a: Interval, b: Interval) -> Interval:
    ends = [x * y if x != 0 and y != 0 else Fraction(0) for x in a for y in b]
    return min(ends), max(ends)


def _quotient(a: Interval, b: Interval) -> Interval:
    if b[0] <= 0 <= b[1]:
        return -inf, inf
    return _product(a, (1 / b[1], 1 / b[0]))


def _at_most(a: Interval, b: Interval) -> bool | None:
    return True if a[1] <= b[0] else False if a[0] > b[1] else None


def _below(a: Interval, b: Interval) -> bool | None:
    return True if a[1] < b[0] else False if a[0] >= b[1] else None


def _equal(a: Interval, b: Interval) -> bool | None:
    if a[1] < b[0] or b[1] < a[0]:
        return False
    return True if a[0] == a[1] == b[0] == b[1] else None
