"""What the statements of a small model say, as formulas of z3 over terms that the caller finds for names."""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import z3

from tests.solver.whole.model import (
    RELATIONS,
    Call,
    Claim,
    Compare,
    Junction,
    Model,
    Truth,
    Variable,
)

Formula = Any  # a term of z3
Find = Callable[[str], Formula]
NUMBER = re.compile(r"[+-]?\d+(\.\d+)?")


class Values:
    """The constants of a model as numbers: colours and objects by their place in the text."""

    def __init__(self, model: Model) -> None:
        self.colours = {name: k for k, name in enumerate(model.colours)}
        self.things = {thing.name: k for k, thing in enumerate(model.things)}
        self.truths = {"false": 0, "true": 1}
        self.of_class = {
            name: [k for k, thing in enumerate(model.things) if thing.class_name == name]
            for name in {thing.class_name for thing in model.things}
        }

    def constant(self, name: str) -> Formula | None:
        """A constant by its text; None for what is none."""
        if NUMBER.fullmatch(name):
            return z3.RealVal(name) if "." in name else z3.IntVal(int(name))
        for table in (self.truths, self.colours, self.things):
            if name in table:
                return z3.IntVal(table[name])
        return None

    def fresh(self, name: str, type_: str) -> Formula:
        """A term for a variable."""
        return z3.Real(name) if type_ == "float" else z3.Int(name)

    def within(self, term: Formula, variable: Variable) -> Formula:
        """That a term has one of the values of a variable."""
        values = [
            self.constant(str(value).lower() if isinstance(value, bool) else str(value)) for value in variable.values
        ]
        if variable.is_wide:
            return z3.And(term >= values[0], term <= values[1])
        if not values:
            tables = {"bool": self.truths.values(), "E": self.colours.values()} | self.of_class
            values = [z3.IntVal(value) for value in tables[variable.type]]
        return z3.Or([term == value for value in values])


@dataclass(frozen=True)
class Span:
    """When a token is."""

    start: Formula
    end: Formula


def related(relation: str, origin: Span, target: Span) -> Formula:
    """What a relation says of two tokens."""
    points = {"os": origin.start, "oe": origin.end, "ts": target.start, "te": target.end}
    return z3.And([points[b] - points[a] >= gap for a, b, gap in RELATIONS[relation]])


def claimed(claim: Claim, find: Find) -> Formula:
    """What a claim says."""
    match claim:
        case Compare(op, left, right):
            a, b = operand(left, find), operand(right, find)
            return {"==": a == b, "!=": a != b, "<": a < b, "<=": a <= b, ">": a > b, ">=": a >= b}[op]
        case Junction(op, parts):
            said = [claimed(part, find) for part in parts]
            return z3.And(said) if op == "&&" else z3.Or(said)
        case Truth(name):
            return find(name) == 1
        case Call(op, arguments):
            return called(op, [find(argument) for argument in arguments])


def operand(text: str, find: Find) -> Formula:
    """A name, or a sum, difference or product of two."""
    parts = text.split(" ")
    if len(parts) == 1:
        return find(text)
    a, b = find(parts[0]), find(parts[2])
    return {"+": a + b, "-": a - b, "*": a * b}[parts[1]]


def called(op: str, terms: list[Formula]) -> Formula:
    """What a constraint says by its name."""
    match op, terms:
        case "eq", [first, *rest]:
            return z3.And([first == other for other in rest])
        case "neq", [a, b]:
            return a != b
        case "lt", [a, b]:
            return a < b
        case "leq", [a, b]:
            return a <= b
        case "addEq", [a, b, total]:
            return a + b == total
        case "mulEq", [a, b, product]:
            return a * b == product
        case "temporalDistance", [a, distance, b]:
            return a + distance == b
        case "allDiff", _:
            return z3.Distinct(terms)
        case _:
            raise ValueError(op)


def one_of(index: Formula, cases: Iterable[tuple[int, Formula]]) -> Formula:
    """The term beside the number that `index` is."""
    found = list(cases)
    term = found[-1][1]
    for number, other in found[:-1]:
        term = z3.If(index == number, other, term)
    return term


@dataclass(frozen=True)
class Use:
    """What charges a resource, if `when` holds: from start to end, or once at start (`end` None) by a signed amount."""

    when: Formula
    thing: Formula
    start: Formula
    end: Formula | None
    amount: Formula


def within_limits(model: Model, uses: list[Use]) -> list[Formula]:
    """That no resource is out of bounds at any instant: levels change at starts of uses, at ends they only recover."""
    said = []
    for k, thing in enumerate(model.things):
        if thing.class_name == "Reservoir":
            initial, lowest, highest = thing.limits
        else:
            (initial, lowest), highest = thing.limits or (1.0, 0.0), None
        charged = (
            [(use, z3.And(use.when, use.thing == k)) for use in uses]
            if thing.limits or thing.class_name == "Unary"
            else []
        )
        for at, is_at in charged:
            level = z3.RealVal(initial)
            for use, counts in charged:
                over = use.start <= at.start if use.end is None else z3.And(use.start <= at.start, at.start < use.end)
                level += z3.If(z3.And(counts, over), use.amount, 0)
            said.append(z3.Implies(is_at, level >= z3.RealVal(lowest)))
            if highest is not None:
                said.append(z3.Implies(is_at, level <= z3.RealVal(highest)))
    return said
