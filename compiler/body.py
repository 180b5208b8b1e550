"""Hold a body while it is written: its slots, the names it has given them, and the instructions so far."""

from dataclasses import dataclass, field
from typing import assert_never

from compiler import constants
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
    Instruction,
    LocalVariable,
    NewVariable,
    Operand,
    ParameterSite,
    TokenVariable,
    TypeCode,
)
from nddl_lang.semantics import schema
from nddl_lang.semantics.callables import NATIVE_CALLABLES, Callables
from nddl_lang.semantics.schema import Label, Predicate, Reference, Schema, SideTables, Type, Variable
from nddl_lang.semantics.types import reference_type
from nddl_lang.syntax.nodes import Expr
from nddl_lang.text.source import Span

_BUILT_IN = {"state": STATE, "object": OBJECT, "duration": DURATION, "start": START, "end": END, "time": START}


@dataclass(eq=False, slots=True)
class Model:
    """What is the same for every body: the meaning of the text, and what the program has numbered so far."""

    schema: Schema
    tables: SideTables
    globals: dict[Variable, int] = field(default_factory=dict)
    sampled: dict[str, ParameterSite] = field(default_factory=dict)
    sources: dict[Operand, tuple[Operand, ...]] = field(default_factory=dict)  # a global and what defines it
    # A parameter that an expression defines, by predicate and number, and what defines it, for a token in slot 0.
    parameters: dict[tuple[str, int], tuple[Operand, ...]] = field(default_factory=dict)
    callables: Callables = NATIVE_CALLABLES

    def constant(self, expr: Expr) -> DomainConstant | None:
        """The domain that `expr` denotes if it is constant."""
        return constants.constant(expr, self.tables.references)

    def type_of(self, expr: Expr) -> Type:
        """The type of `expr`; semantics has given every value one, and targets of assignments refer to one."""
        if (found := self.tables.types.get(expr)) is None:
            found = reference_type(self.tables.references[expr], None)
            assert found is not None
        return found


@dataclass(eq=False, slots=True)
class Frame:
    """The slots of one rule instance, constructor call or token, or of the script; all its blocks share it."""

    slots: int = 0
    tokens: int = 1
    predicates: dict[int, Predicate] = field(default_factory=dict)  # of the token in each slot
    variables: dict[Variable, Operand] = field(default_factory=dict)
    labels: dict[Label, int] = field(default_factory=dict)
    sources: dict[Operand, tuple[Operand, ...]] = field(default_factory=dict)

    def new_slot(self) -> int:
        """The next variable slot."""
        self.slots += 1
        return self.slots - 1

    def new_token(self, predicate: Predicate, label: Label | None) -> int:
        """The next token slot, known as `label` from now on."""
        self.predicates[self.tokens] = predicate
        self.tokens += 1
        if label is not None:
            self.labels[label] = self.tokens - 1
        return self.tokens - 1

    def token(self, label: Label) -> int:
        """The slot of the token that `label` names; the rule's own token is in slot 0."""
        return self.labels.get(label, 0) if label.name == "this" else self.labels[label]


@dataclass(eq=False, slots=True)
class Body:
    """A list of instructions being written; `leaves` collects the variables that are read, where that is asked."""

    model: Model
    frame: Frame
    code: list[Instruction] = field(default_factory=list)
    leaves: list[Operand] | None = None

    def emit(self, instruction: Instruction) -> None:
        """Append `instruction`."""
        self.code.append(instruction)

    def block(self) -> "Body":
        """An empty list of instructions over the same slots."""
        return Body(self.model, self.frame)

    def implicit(self, type_: TypeCode, span: Span) -> LocalVariable:
        """Make a nameless variable for an intermediate result."""
        slot = self.frame.new_slot()
        self.emit(NewVariable(slot, None, type_, None, None, span))
        return LocalVariable(slot)

    def read(self, operand: Operand) -> Operand:
        """Note that the value of `operand` is used: a guard waits until all it uses is decided."""
        if self.leaves is not None:
            self.leaves += [leaf for leaf in self._sources(operand) if _can_wait(leaf) and leaf not in self.leaves]
        return operand

    def _sources(self, operand: Operand) -> tuple[Operand, ...]:
        """The variables that an expression defines `operand` by; else `operand` itself."""
        if isinstance(operand, TokenVariable) and operand.token in self.frame.predicates:
            key = (self.frame.predicates[operand.token].full_name, operand.variable)
            if (known := self.model.parameters.get(key)) is not None:
                return tuple(_moved(leaf, operand.token) for leaf in known)
        return self.frame.sources.get(operand) or self.model.sources.get(operand) or (operand,)

    def operand(self, reference: Reference) -> Operand:
        """Where the variable that `reference` names is found."""
        match reference:
            case schema.EnumValue():
                return Constant(constants.enum_value(reference))
            case schema.GlobalReference(variable=variable):
                return GlobalVariable(self.model.globals[variable])
            case schema.LocalReference(variable=variable):
                return self.frame.variables[variable]
            case schema.TokenReference(label=label):
                return TokenVariable(self.frame.token(label), STATE)
            case schema.TokenVariableReference(label=label, name=name):
                return TokenVariable(self.frame.token(label), _variable_number(label.predicate, name))
            case schema.MemberReference(base=base, members=members):
                names = tuple(member.name for member in members)
                return Field(None if base is None else self.operand(base), names)
            case schema.ClassReference():
                raise AssertionError("a class is no value")
            case _:
                assert_never(reference)


def _variable_number(predicate: Predicate, name: str) -> int:
    """The number of variable `name` among those of a token of `predicate`; a parameter hides nothing built in."""
    for position, parameter in enumerate(predicate.parameters):
        if parameter.name == name:
            return FIRST_PARAMETER + position
    return _BUILT_IN[name]


def _moved(operand: Operand, token: int) -> Operand:
    """`operand` with the token in slot `token` in place of that in slot 0."""
    match operand:
        case TokenVariable(variable=number):
            return TokenVariable(token, number)
        case Field(base=base, members=members) if base is not None:
            return Field(_moved(base, token), members)
        case _:
            return operand


def _can_wait(operand: Operand) -> bool:
    return not (isinstance(operand, Constant) and constants.single(operand.domain) is not None)
