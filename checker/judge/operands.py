"""Operands of a program as functions that read a value from the frame of one run."""

from collections.abc import Callable, Iterable, Iterator
from math import inf
from typing import Any, assert_never

from checker.judge.bench import Bench, Tok, clock, duration_of
from checker.judge.values import ENDLESS, UNKNOWN, hull, is_open
from compiler.program import (
    DURATION,
    END,
    FIRST_PARAMETER,
    OBJECT,
    START,
    STATE,
    Constant,
    DomainConstant,
    Field,
    GlobalVariable,
    LocalVariable,
    Operand,
    ParameterCode,
    Program,
    TokenVariable,
    TypeCode,
    UnionOf,
)
from runtime.executive.record import BodyRun, GuardRun, OpenValues, Value, ValueRange

BUILT_IN = {STATE: "state", OBJECT: "object", DURATION: "duration", START: "start", END: "end"}


class BodyFrame:
    """One run of a body: the values in its slots, its tokens, and what the record says of the run."""

    __slots__ = ("bench", "children", "choosing", "guards", "locals", "slots", "tok", "tokens", "within")

    def __init__(self, bench: Bench, tok: Tok | None, slots: list[Value], tokens: list[Tok | None]) -> None:
        self.bench = bench
        self.tok = tok
        self.slots = slots
        self.tokens = tokens
        self.within = ""  # the branch that is run
        self.choosing: Any = None  # finds children and branches where no run is on record
        self.locals: Iterator[Value] = iter(())
        self.children: Iterator[int] = iter(())
        self.guards: Iterator[GuardRun] = iter(())

    def follow(self, run: BodyRun) -> None:
        """Read what comes next from `run`."""
        self.locals = iter(run.locals)
        self.children = iter(run.children)
        self.guards = iter(run.guards)


Read = Callable[[BodyFrame], Value]


class VariableNames:
    """How the variables of a body are called: for reports, and to tell the type of a token's parameter."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.predicates = {code.name: code for code in program.predicates}
        self.classes = {code.name: code for code in program.classes}
        self.clock = next((k for k, (name, _) in enumerate(program.globals) if name == "AGENT_CLOCK"), -1)
        self.locals: dict[int, str] = {}
        self.types: dict[int, TypeCode] = {}  # of local variables
        self.tokens: dict[int, tuple[str, str]] = {}  # slot -> label and predicate
        self.parts: dict[int, tuple[Operand, ...]] = {}  # slot of a part of an expression -> what it is computed from
        self._kinds: dict[tuple[str, str], bool] = {}

    def tokens_in(self, operands: Iterable[Operand]) -> frozenset[int]:
        """The slots of the tokens of which operands are variables, or from whose variables they are computed."""
        found: set[int] = set()
        for each in operands:
            match each:
                case TokenVariable(token=token):
                    found.add(token)
                case LocalVariable(slot=slot) if slot in self.parts:
                    found |= self.tokens_in(self.parts[slot])
        return frozenset(found)

    def of(self, operand: Operand) -> str:
        """The name of an operand as the modeler wrote it; empty for constants and parts of expressions."""
        match operand:
            case GlobalVariable(index=index):
                return self.program.globals[index][0]
            case LocalVariable(slot=slot):
                return self.locals.get(slot, "")
            case TokenVariable(token=token, variable=variable):
                label, predicate = self.tokens.get(token, ("", ""))
                parameter = self._parameter(predicate, variable)
                name = BUILT_IN.get(variable) or (parameter.name if parameter is not None else "")
                return f"{label}.{name}" if label else name
            case Field(base=base, members=members):
                return ".".join(([self.of(base)] if base is not None else []) + list(members))
            case _:
                return ""

    def _parameter(self, predicate: str, variable: int) -> ParameterCode | None:
        code, number = self.predicates.get(predicate), variable - FIRST_PARAMETER
        return code.parameters[number] if code is not None and 0 <= number < len(code.parameters) else None

    def kind_of(self, operand: Operand) -> str:
        """The kind of type of a variable with a name; empty for what is none."""
        match operand:
            case GlobalVariable(index=index):
                return self.program.globals[index][1].kind
            case LocalVariable(slot=slot) if slot in self.types:
                return self.types[slot].kind
            case TokenVariable(token=token, variable=variable):
                parameter = self._parameter(self.tokens.get(token, ("", ""))[1], variable)
                return parameter.type.kind if parameter is not None else ""
            case _:
                return ""

    def is_kind_of(self, class_name: str, other: str) -> bool:
        """Whether a class is, or extends, another."""
        if class_name == other:
            return True
        pair = (class_name, other)
        known = self._kinds.get(pair)
        if known is None:
            base = self.classes[class_name].base if class_name in self.classes else None
            known = self._kinds[pair] = base is not None and self.is_kind_of(base, other)
        return known


def domain_value(domain: DomainConstant) -> Value:
    """The value, or the values, of a constant."""
    if domain.values is not None:
        values = tuple(float(each) if domain.kind == "float" else each for each in domain.values)
        return values[0] if len(values) == 1 else OpenValues(values)
    assert domain.interval is not None
    lower, upper = domain.interval
    if lower == upper:
        return float(lower) if domain.kind == "float" else lower
    return ValueRange(-inf if lower <= -ENDLESS else lower, inf if upper >= ENDLESS else upper)


def reader(operand: Operand, names: VariableNames) -> Read:
    """The function that reads `operand`."""
    match operand:
        case Constant(domain=domain):
            constant = domain_value(domain)
            return lambda frame: constant
        case GlobalVariable(index=index):
            if index == names.clock:
                return _read_clock
            return lambda frame: frame.bench.globals[index]
        case LocalVariable(slot=slot):
            return lambda frame: frame.slots[slot]
        case TokenVariable(token=token, variable=variable):
            return _token_reader(token, variable)
        case Field(base=base, members=members):
            return _field_reader(None if base is None else reader(base, names), members, names)
        case UnionOf(operands=operands):
            parts = [reader(each, names) for each in operands]
            return lambda frame: _united([part(frame) for part in parts])
        case _:
            assert_never(operand)


def _read_clock(frame: BodyFrame) -> Value:
    return UNKNOWN if frame.tok is None else clock(frame.bench, frame.tok)


def _token_reader(token: int, variable: int) -> Read:
    def read(frame: BodyFrame) -> Value:
        tok = frame.tokens[token]
        if tok is None:
            return UNKNOWN
        if variable == DURATION:
            return duration_of(tok)
        if variable == STATE:
            return tok.record.state.upper()
        # What was merged into a token of another predicate, which is reported, may lack it.
        return tok.values[variable] if variable < len(tok.values) else UNKNOWN

    return read


def _field_reader(base: Read | None, members: tuple[str, ...], names: VariableNames) -> Read:
    def read(frame: BodyFrame) -> Value:
        if base is None:
            return UNKNOWN
        value = base(frame)
        for name in members:
            value = member_of(frame.bench, names, value, name)
        return value

    return read


def member_of(bench: Bench, names: VariableNames, thing: Value, name: str) -> Value:
    """The member called `name` of an object, or of each that it may be."""
    if isinstance(thing, ValueRange):
        return UNKNOWN
    found: list[Value] = []
    for each in thing.values if isinstance(thing, OpenValues) else (thing,):
        known = bench.members.get(str(each))
        if known is None:
            return UNKNOWN
        class_name, values = known
        indices = [k for k, one in enumerate(names.classes[class_name].members) if one.name == name]
        if not indices:
            return UNKNOWN
        found.append(values[indices[0]])
    return _united(found)


def _united(values: list[Value]) -> Value:
    """A value that may be any of `values`."""
    if len(values) == 1 or (values and all(each == values[0] for each in values)):
        return values[0]
    scalars: list[float | int | bool | str] = []
    for each in values:
        if isinstance(each, OpenValues):
            scalars += each.values
        elif isinstance(each, ValueRange):
            break
        else:
            scalars.append(each)
    else:
        return OpenValues(tuple(dict.fromkeys(scalars)))
    hulls = [hull(each) for each in values]
    known = [each for each in hulls if each is not None]
    return ValueRange(min(a for a, _ in known), max(b for _, b in known)) if len(known) == len(values) else UNKNOWN


def is_range(operand: Operand) -> bool:
    """Whether an operand is a constant with several values: any of them will do."""
    return isinstance(operand, UnionOf) or (isinstance(operand, Constant) and is_open(domain_value(operand.domain)))
