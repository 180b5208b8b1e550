"""Operands of a program as numbers of z3; whoever has a body at hand says which tokens, locals and members they are.

Whole numbers are Int, floats Real with the decimal value that is written; truth values are 0 and 1, names of values and
objects are whole numbers, one per name.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol, assert_never

import z3

from checker.judge.values import ENDLESS
from checker.proofs.claims import Claim, Number
from compiler.instructions import all_instructions
from compiler.program import (
    FIRST_PARAMETER,
    TOKEN_VARIABLES,
    Child,
    Constant,
    DomainConstant,
    Field,
    GlobalVariable,
    Instruction,
    LocalVariable,
    NewObject,
    NewToken,
    NewVariable,
    ObjectLoop,
    Operand,
    PredicateCode,
    Program,
    TokenVariable,
    TypeCode,
    UnionOf,
)

_KINDS = {"state": "symbol", "object": "object", "duration": "int", "start": "int", "end": "int"}
Scalar = float | int | bool | str


class Symbols:
    """Variables by name, and names of values as numbers; shared by all reactors of a mission."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}
        self._variables: dict[tuple[str, bool], Number] = {}
        self._names: dict[int, str] = {}  # of these, by identity: z3 is slow to tell
        self._fresh = 0

    def constant(self, value: Scalar, kind: str) -> Number:
        """A value as a number."""
        if isinstance(value, str):
            return z3.IntVal(self._numbers.setdefault(value, len(self._numbers)))
        if kind == "float" and not isinstance(value, bool):
            return rational(value)
        return z3.IntVal(int(value)) if value == int(value) else rational(value)

    def number(self, text: str) -> int | None:
        """The number of a name; None if it was never spoken of."""
        return self._numbers.get(text)

    def text(self, number: int) -> str:
        """The name that has a number; empty if none has."""
        return next((text for text, one in self._numbers.items() if one == number), "")

    def variable(self, name: str, kind: str) -> Number:
        """The variable called `name`."""
        key = (name, kind == "float")
        known = self._variables.get(key)
        if known is None:
            known = self._variables[key] = z3.Real(name) if kind == "float" else z3.Int(name)
            self._names[id(known)] = name
        return known

    def name_of(self, number: Number | None) -> str:
        """The name of a variable; empty for everything else."""
        known = self._names.get(id(number))
        return name_of(number) if known is None else known

    def anonymous(self, kind: str) -> Number:
        """A variable that nobody else knows."""
        self._fresh += 1
        return self.variable(f"any value {self._fresh}", kind)

    def within(self, number: Number, domain: DomainConstant) -> Claim:
        """That a number lies in a domain."""
        if domain.values is not None:
            return z3.Or(*[number == self.constant(value, domain.kind) for value in domain.values])
        assert domain.interval is not None
        lower, upper = domain.interval
        bounds = []
        if lower > -ENDLESS:
            bounds.append(number >= self.constant(lower, domain.kind))
        if upper < ENDLESS:
            bounds.append(number <= self.constant(upper, domain.kind))
        return z3.And(*bounds)


def decimal(value: float | Fraction) -> Fraction:
    """The shortest decimal number that is read as a double."""
    return Fraction(repr(value)) if isinstance(value, float) else Fraction(value)


def rational(value: float | Fraction) -> Number:
    """An exact real: of a double the shortest decimal number that it is read from."""
    exact = decimal(value)
    return z3.Q(exact.numerator, exact.denominator)


def name_of(number: Number | None) -> str:
    """The name of a variable; empty for everything else."""
    if (
        number is None
        or isinstance(number, z3.IntNumRef | z3.RatNumRef)
        or not z3.is_const(number)
        or number.decl().kind() != z3.Z3_OP_UNINTERPRETED
    ):
        return ""
    return str(number.decl().name())


def variables_of(expression: Number) -> tuple[Number, ...]:
    """The variables of an expression or a claim, each once, in the order in which they occur."""
    found: list[Number] = []
    seen: set[int] = set()
    waiting = [expression]
    while waiting:
        each = waiting.pop()
        if each.get_id() in seen:
            continue
        seen.add(each.get_id())
        if name_of(each):
            found.append(each)
        else:
            waiting.extend(reversed(each.children()))
    return tuple(found)


@dataclass(frozen=True, eq=False, slots=True)
class ProgramNames:
    """The declarations of a program by name."""

    program: Program
    predicates: dict[str, PredicateCode]
    bases: dict[str, str | None]

    def is_kind_of(self, class_name: str, other: str) -> bool:
        """Whether a class is, or extends, another."""
        found: str | None = class_name
        while found is not None:
            if found == other:
                return True
            found = self.bases.get(found)
        return False

    def fits(self, predicate: str, asked: str) -> bool:
        """Whether a token of `predicate` may stand where one of `asked` is asked for."""
        name, _, own = predicate.rpartition(".")
        other, _, wanted = asked.rpartition(".")
        return own == wanted and self.is_kind_of(name, other)


def names_of(program: Program) -> ProgramNames:
    """The declarations of a program by name."""
    return ProgramNames(
        program,
        {code.name: code for code in program.predicates},
        {code.name: code.base for code in program.classes},
    )


class Binding(Protocol):
    """What the operands of one body stand for; None where that is not known."""

    names: ProgramNames
    symbols: Symbols

    def token(self, slot: int) -> tuple[str, str] | None:
        """The name of the token in a slot, and its predicate."""

    def local(self, slot: int) -> Number | None:
        """The variable in a local slot."""

    def world(self, index: int) -> Number | None:
        """A global variable."""

    def member(self, base: Operand | None, members: Sequence[str]) -> Number | None:
        """A member of an object."""


def number(operand: Operand, binding: Binding, base: list[Claim]) -> Number | None:
    """The number of an operand; what holds of it by itself (a range in the text) is added to `base`."""
    match operand:
        case Constant(domain=domain):
            if domain.values is not None and len(domain.values) == 1:
                return binding.symbols.constant(domain.values[0], domain.kind)
            if domain.interval is not None and domain.interval[0] == domain.interval[1]:
                return binding.symbols.constant(domain.interval[0], domain.kind)
            free = binding.symbols.anonymous(domain.kind)
            base.append(binding.symbols.within(free, domain))
            return free
        case GlobalVariable(index=index):
            return binding.world(index)
        case LocalVariable(slot=slot):
            return binding.local(slot)
        case TokenVariable(token=token, variable=variable):
            found = binding.token(token)
            return None if found is None else token_number(found[0], found[1], variable, binding.names, binding.symbols)
        case Field(base=inner, members=members):
            return binding.member(inner, members)
        case UnionOf(operands=operands):
            parts = [number(each, binding, base) for each in operands]
            if any(part is None for part in parts):
                return None
            is_real = any(z3.is_real(part) for part in parts)
            free = binding.symbols.anonymous("float" if is_real else "int")
            base.append(z3.Or(*[free == part for part in parts]))
            return free
        case _:
            assert_never(operand)


def token_number(name: str, predicate: str, variable: int, names: ProgramNames, symbols: Symbols) -> Number | None:
    """A time, the object or a parameter of a token."""
    if variable < FIRST_PARAMETER:
        known = TOKEN_VARIABLES[variable]
        return symbols.variable(f"{name}.{known}", _KINDS[known])
    code = names.predicates.get(predicate)
    index = variable - FIRST_PARAMETER
    if code is None or index >= len(code.parameters):
        return None
    parameter = code.parameters[index]
    return symbols.variable(f"{name}.{parameter.name}", parameter.type.kind)


def variable_name(predicate: str, variable: int, names: ProgramNames) -> str:
    """How a variable of a token of `predicate` is called."""
    if variable < FIRST_PARAMETER:
        return TOKEN_VARIABLES[variable]
    return names.predicates[predicate].parameters[variable - FIRST_PARAMETER].name


@dataclass(frozen=True, slots=True)
class BodyLayout:
    """What the slots of a body hold: types and names of locals, predicates of tokens."""

    types: dict[int, TypeCode]
    locals: dict[int, str | None]
    predicates: dict[int, str]


def layout_of(body: Sequence[Instruction], own: str | None) -> BodyLayout:
    """The slots of a body, branches included; `own` is the predicate of the rule's token."""
    layout = BodyLayout({}, {}, {} if own is None else {0: own})
    for each in all_instructions(body):
        match each:
            case NewVariable():
                layout.types[each.slot] = each.type
                layout.locals[each.slot] = each.name
            case NewObject(slot=int(slot), type=TypeCode() as code):
                layout.types[slot] = code
                layout.locals[slot] = each.name
            case Child() | NewToken():
                layout.predicates[each.slot] = each.predicate
            case ObjectLoop():
                layout.types[each.slot] = TypeCode("object", "object", None)
                layout.locals[each.slot] = None
            case _:
                pass
    return layout
