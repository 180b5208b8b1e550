"""Bytecode of rules, predicate bodies and constructors: instructions in blocks, operands as pairs, all integers.

An operand is `(kind, value)`, see `tags.IN_*`. A block is a stretch of `cells`; guards and loops name their blocks by
number. Nothing runs here.
"""

from collections import deque
from typing import assert_never

from compiler.program import (
    Assign,
    Call,
    Child,
    Constant,
    DomainConstant,
    Field,
    GlobalVariable,
    Guard,
    Instruction,
    LocalVariable,
    NewGlobal,
    NewObject,
    NewToken,
    NewVariable,
    ObjectLoop,
    Operand,
    Post,
    Relate,
    Sample,
    TokenVariable,
    TypeCode,
    UnionOf,
)
from nddl_lang.text.source import Span
from runtime.constraints.propagators.opcodes import OP_NOTHING
from runtime.constraints.propagators.registry import BY_NAME, EXACT_TWINS
from runtime.plan.store.names import Names
from runtime.plan.store.prototypes import Prototypes
from runtime.plan.tags import (
    DO_ASSIGN,
    DO_BETWEEN,
    DO_CHILD,
    DO_FOREACH,
    DO_GUARD,
    DO_OBJECT,
    DO_POST,
    DO_RELATE,
    DO_SAMPLE,
    DO_USE,
    DO_VARIABLE,
    FIRST_WRITTEN,
    IN_CONSTANT,
    IN_FIELD,
    IN_GLOBAL,
    IN_LOCAL,
    IN_NONE,
    IN_PROTOTYPE,
    IN_SELF,
    IN_TOKEN,
    IN_UNION,
    INFINITY,
    NONE,
    OBJECT_ANY,
    OBJECT_GIVEN,
    OBJECT_OWN,
    TOKEN_SHIFT,
)

# b - a lies in [lower, upper]: temporal constraints on two timepoints are edges, not propagators.
_DISTANCES = {"precedes": (0, INFINITY), "strictlyPrecedes": (1, INFINITY), "concurrent": (0, 0)}


class RuleBytecode:
    """Bytecode of a program, with the tables that its integers point into."""

    def __init__(
        self,
        prototypes: Prototypes,
        names: Names,
        predicates: dict[str, int],
        relations: dict[str, int],
        written: dict[str, int],
        narrows_functions: bool = False,
    ) -> None:
        self.prototypes = prototypes
        self.names = names
        self.predicates = predicates
        self.relations = relations
        twins = EXACT_TWINS if narrows_functions else {}
        self.operations = {name: twins.get(row.op, row.op) for name, row in BY_NAME.items()}
        self.operations |= {name: FIRST_WRITTEN + number for name, number in written.items()}
        self.cells: list[int] = []
        self.block_start: list[int] = []
        self.block_end: list[int] = []
        self.spans: list[Span] = []
        self.span_numbers: dict[Span, int] = {}
        self.messages: dict[int, str] = {}
        self.field_base: list[tuple[int, int]] = []
        self.field_members: list[tuple[int, ...]] = []
        self.unions: list[tuple[tuple[int, int], ...]] = []
        self.objects: list[NewObject] = []
        self.local_types: dict[int, str] = {}
        self.pending: deque[tuple[int, tuple[Instruction, ...]]] = deque()

    def span(self, span: Span | None) -> int:
        """The number of a span."""
        if span is None:
            return NONE
        number = self.span_numbers.setdefault(span, len(self.spans))
        if number == len(self.spans):
            self.spans.append(span)
        return number

    def body(self, instructions: tuple[Instruction, ...]) -> int:
        """Compile a body with all that is nested in it; the number of its block."""
        number = self.block(instructions)
        while self.pending:
            block, body = self.pending.popleft()
            self.block_start[block] = len(self.cells)
            for instruction in body:
                self._instruction(instruction)
            self.block_end[block] = len(self.cells)
        return number

    def block(self, instructions: tuple[Instruction, ...]) -> int:
        """Give a block a number; it is written when its turn comes."""
        number = len(self.block_start)
        self.block_start.append(0)
        self.block_end.append(0)
        self.pending.append((number, instructions))
        return number

    def _instruction(self, instruction: Instruction) -> None:
        """Write one instruction."""
        span = self.span(instruction.span)
        match instruction:
            case NewVariable(slot=slot, name=name, type=type_, domain=domain, copy_of=copy):
                prototype = self.prototypes.of(type_, domain)
                label = NONE if name is None else self.local(name, type_)
                self.write(DO_VARIABLE, span, slot, label, prototype, *self.optional(copy))
            case Post(name=name, operands=operands, message=message):
                if message is not None:
                    self.messages[span] = message
                self.post(name, operands, span)
            case Sample(target=target, parameter=parameter):
                self.write(DO_SAMPLE, span, self.names.number(parameter), *self.operand(target))
            case Child():
                self.child(instruction, span)
            case Relate(relation=relation, origin=origin, target=target, bounds=bounds):
                self.write(DO_RELATE, span, self.relations[relation], origin, target, *_flat_bounds(bounds))
            case Guard(condition=condition, decided_by=decided_by, then=then, otherwise=otherwise):
                blocks = self.block(then), self.block(otherwise)
                inputs = [number for operand in decided_by for number in self.operand(operand)]
                self.write(DO_GUARD, span, *self.operand(condition), *blocks, len(decided_by), *inputs)
            case ObjectLoop(slot=slot, collection=collection, body=body):
                self.write(DO_FOREACH, span, slot, *self.operand(collection), self.block(body))
            case NewObject(slot=slot):
                self.objects.append(instruction)
                self.write(DO_OBJECT, span, NONE if slot is None else slot, len(self.objects) - 1)
            case Assign(target=target, domain=domain, value=value):
                assert not isinstance(value, NewObject), "only the script and constructors assign new objects"
                self.write(DO_ASSIGN, span, *self.operand(target), *self.given(domain, value))
            case NewGlobal() | NewToken() | Call():
                raise AssertionError(f"{type(instruction).__name__} stands in the script only")
            case _:
                assert_never(instruction)

    def local(self, name: str, type_: TypeCode) -> int:
        """The number of the name of a local variable; its type is remembered for read-out."""
        number = self.names.number(name)
        self.local_types[number] = type_.type_name
        return number

    def post(self, name: str, operands: tuple[Operand, ...], span: int) -> None:
        """Write a constraint; temporal ones become distances."""
        if self.operations.get(name) == OP_NOTHING:
            return
        pairs = [self.operand(operand) for operand in operands]
        distance = _DISTANCES.get(name)
        if name == "temporalDistance" and (given := _fixed_distance(operands[1])) is not None:
            distance = given
            del pairs[1]
        flat = [number for pair in pairs for number in pair]
        if distance is not None:
            self.write(DO_BETWEEN, span, *flat, *distance, self.operations[name])
        elif name == "uses":
            self.write(DO_USE, span, *flat)
        else:
            self.write(DO_POST, span, self.operations[name], len(pairs), *flat)

    def child(self, child: Child, span: int) -> None:
        """Write the making of a child."""
        given = (IN_NONE, NONE)
        mode = OBJECT_ANY
        if child.object == "own":
            mode = OBJECT_OWN
        elif not isinstance(child.object, str):
            mode = OBJECT_GIVEN
            given = self.operand(child.object)
        role = {None: 0, "condition": 1, "effect": 2}[child.role]
        label = NONE if child.label is None else self.names.number(child.label)
        made = (self.predicates[child.predicate], label, role, mode, *given)
        relation = (self.relations[child.relation], child.origin, *_flat_bounds(child.bounds))
        self.write(DO_CHILD, span, child.slot, *made, *relation)

    def given(self, domain: DomainConstant | None, value: Operand | None) -> tuple[int, int]:
        """What an assignment assigns: the prototype itself serves, as nothing but its base domain is read."""
        if domain is not None:
            return IN_CONSTANT, self.prototypes.of_domain(domain)
        return self.optional(value)

    def optional(self, operand: Operand | None) -> tuple[int, int]:
        """An operand that may be missing."""
        return (IN_NONE, NONE) if operand is None else self.operand(operand)

    def operand(self, operand: Operand) -> tuple[int, int]:
        """Where the variable of `operand` is found."""
        match operand:
            case Constant(domain=domain):
                if _is_single(domain):
                    return IN_CONSTANT, self.prototypes.constant(domain)
                return IN_PROTOTYPE, self.prototypes.of_domain(domain)
            case GlobalVariable(index=index):
                return IN_GLOBAL, index
            case LocalVariable(slot=slot):
                return IN_LOCAL, slot
            case TokenVariable(token=token, variable=variable):
                return IN_TOKEN, token * TOKEN_SHIFT + variable
            case Field(base=base, members=members):
                if base is None and not members:
                    return IN_SELF, 0
                self.field_base.append((IN_SELF, 0) if base is None else self.operand(base))
                self.field_members.append(tuple(self.names.number(member) for member in members))
                return IN_FIELD, len(self.field_base) - 1
            case UnionOf(operands=operands):
                self.unions.append(tuple(self.operand(part) for part in operands))
                return IN_UNION, len(self.unions) - 1
            case _:
                assert_never(operand)

    def write(self, *numbers: int) -> None:
        """Append numbers."""
        self.cells.extend(numbers)


def _is_single(domain: DomainConstant) -> bool:
    """Whether a constant has one value."""
    if domain.values is not None:
        return len(domain.values) == 1
    return domain.interval is not None and domain.interval[0] == domain.interval[1]


def _fixed_distance(operand: Operand) -> tuple[int, int] | None:
    """The bounds of a distance that is an interval of whole numbers fixed by the text."""
    if not isinstance(operand, Constant) or operand.domain.kind != "int":
        return None
    domain = operand.domain
    if domain.interval is not None:
        return int(domain.interval[0]), int(domain.interval[1])
    if domain.values is not None and len(domain.values) == 1:
        return int(domain.values[0]), int(domain.values[0])
    return None


def _flat_bounds(bounds: tuple[tuple[int, int], ...]) -> list[int]:
    """Relation bounds with their count in front."""
    return [len(bounds), *(bound for pair in bounds for bound in pair)]
