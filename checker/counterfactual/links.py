"""A program in, its lines out, each with the variables that it speaks of; and what a rule leaves loose."""

from collections import defaultdict
from collections.abc import Iterator

from checker.named_objects import RESOURCES
from compiler.instructions import all_instructions
from compiler.program import (
    DURATION,
    END,
    FIRST_PARAMETER,
    START,
    Assign,
    Call,
    Child,
    ClassCode,
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
    PredicateCode,
    Program,
    Relate,
    RuleCode,
    Sample,
    TokenVariable,
    UnionOf,
)
from nddl_lang.text.source import Span

Key = tuple[object, ...]  # of a variable
TIMES = "times"
DURATION_NAME = "duration"
# Relations that leave the end of the origin free, where nothing says when the target begins.
_FREE = ("any", "contains", "starts", "met_by", "after", "meets", "before")
_EVENTS = "Reservoir"  # whose tokens have one time


class Links:
    """The lines of one program, each with the variables that it speaks of."""

    def __init__(self, number: int, program: Program) -> None:
        self._number = number
        self._program = program
        self._parameters = {each.name: [one.name for one in each.parameters] for each in program.predicates}
        self._classes = {each.name: each for each in program.classes}

    def all(self) -> Iterator[tuple[Span, list[Key]]]:
        """Every instruction with a line."""
        for index, rule in enumerate(self._program.rules):
            tokens = {0: rule.predicate}
            yield rule.span, [("token", rule.predicate, TIMES)]
            yield from self._body(rule.body, ("rule", self._number, index), tokens, ())
        for index, predicate in enumerate(self._program.predicates):
            yield from self._body(predicate.body, ("predicate", self._number, index), {0: predicate.name}, ())
        yield from self._body(self._program.script, ("script", self._number), {}, ())

    def loose(self, rule: RuleCode, scope: Key) -> Iterator[tuple[Span, str, Key, bool]]:
        """What a rule leaves loose: where that is declared, its name, the key under which other rules speak of it.

        The last says whether it is a local variable.
        """
        statements: dict[Key, set[int]] = defaultdict(set)
        declared: dict[Key, tuple[Span, str]] = {}
        steps = list(all_instructions(rule.body))
        children = {0: rule.predicate} | {step.slot: step.predicate for step in steps if isinstance(step, Child)}
        marked = {slot: f"{predicate}#{slot}" for slot, predicate in children.items()}
        events = {slot for slot, predicate in children.items() if self._is_event(predicate)}
        self._parameters |= {marked[slot]: self._parameters.get(name, []) for slot, name in children.items()}
        for step in steps:
            if isinstance(step, NewVariable) and step.name is not None:
                declared[*scope, "local", step.slot] = (step.span, step.name)
            elif isinstance(step, Child):
                for name in self._parameters[marked[step.slot]]:
                    declared["token", marked[step.slot], name] = (step.span, f"{step.label or step.predicate}.{name}")
            speaks = step.copy_of is not None if isinstance(step, NewVariable) else not isinstance(step, Child)
            if speaks:
                times = ("token", marked[0], TIMES)
                is_event = any(("token", marked[one], TIMES) in self._keys(step, scope, marked) for one in events)
                for key in self._keys(step, scope, marked):
                    if not (is_event and key == times):  # when an event comes leaves the end free
                        statements[key].add(_statement(step.span))
        for name in self._parameters[marked[0]]:
            declared["token", marked[0], name] = (rule.span, name)
        for key, (span, name) in declared.items():
            is_local = key[0] != "token"
            if len(statements[key]) < (2 if is_local else 1):
                yield span, name, () if is_local else ("token", str(key[1]).partition("#")[0], name), is_local
        if not statements["token", marked[0], TIMES] and all(
            step.relation in _FREE for step in steps if isinstance(step, Child) and step.origin == 0
        ):
            yield rule.span, DURATION_NAME, (), False

    def _body(
        self, body: tuple[Instruction, ...], scope: Key, tokens: dict[int, str], inside: tuple[Key, ...]
    ) -> Iterator[tuple[Span, list[Key]]]:
        for step in body:
            match step:
                case Child(slot=slot, predicate=predicate):
                    tokens[slot] = predicate
                case NewToken(slot=slot, predicate=predicate):
                    tokens[slot] = predicate
                case _:
                    pass
        for step in body:
            yield step.span, [*self._keys(step, scope, tokens), *inside]
            match step:
                case Guard(then=then, otherwise=otherwise, span=span):
                    key: Key = (*scope, "guard", span.begin)
                    yield span, [key]
                    yield from self._body(then, scope, dict(tokens), (*inside, key))
                    yield from self._body(otherwise, scope, dict(tokens), (*inside, key))
                case ObjectLoop(body=inner):
                    yield from self._body(inner, scope, dict(tokens), inside)
                case _:
                    pass

    def _keys(self, step: Instruction, scope: Key, tokens: dict[int, str]) -> Iterator[Key]:
        match step:
            case Post(operands=operands):
                for operand in operands:
                    yield from self._operand(operand, scope, tokens)
            case Sample(target=target):
                yield from self._operand(target, scope, tokens)
            case NewVariable(slot=slot, copy_of=copy_of):
                yield (*scope, "local", slot)
                if copy_of is not None:
                    yield from self._operand(copy_of, scope, tokens)
            case Child(slot=slot, origin=origin) | Relate(target=slot, origin=origin):
                yield from (("token", tokens[one], TIMES) for one in (slot, origin) if one in tokens)
                yield (*scope, "child", slot)
                if isinstance(step, Child) and isinstance(step.object, LocalVariable):  # which lines choose
                    yield from self._operand(step.object, scope, tokens)
            case NewToken(predicate=predicate):
                yield ("token", predicate, TIMES)
            case Guard(condition=condition, decided_by=deciders):
                for operand in (condition, *deciders):
                    yield from self._operand(operand, scope, tokens)
            case NewGlobal(index=index, copy_of=copy_of):
                yield from self._operand(GlobalVariable(index), scope, tokens)
                if copy_of is not None:
                    yield from self._operand(copy_of, scope, tokens)
            case Assign(target=target, value=value):
                yield from self._operand(target, scope, tokens)
                if isinstance(value, NewObject):
                    yield from self._object(value, scope, tokens)
                elif value is not None:
                    yield from self._operand(value, scope, tokens)
            case NewObject():
                yield from self._object(step, scope, tokens)
            case Call(arguments=arguments, variable=variable):
                for operand in (*arguments, *((variable,) if variable is not None else ())):
                    yield from self._operand(operand, scope, tokens)
            case _:
                pass

    def _object(self, new: NewObject, scope: Key, tokens: dict[int, str]) -> Iterator[Key]:
        """What an object is made of bears on its members, and the limits of a resource on what uses it."""
        for argument in new.arguments:
            if not isinstance(argument, NewObject):
                yield from self._operand(argument, scope, tokens)
        owner: ClassCode | None = self._classes[new.class_name]
        yield from (("member", member.name) for member in (owner.members if owner is not None else ()))
        while owner is not None:
            if owner.native in RESOURCES:
                for each in self._predicates_of(owner.name):
                    yield ("token", each.name, TIMES)
                    yield from (("token", each.name, parameter.name) for parameter in each.parameters)
            owner = self._classes[owner.base] if owner.base is not None else None

    def _is_event(self, predicate: str) -> bool:
        """Whether a predicate is of a resource's events, which have one time."""
        owner = self._classes.get(predicate.rpartition(".")[0])
        return owner is not None and owner.native == _EVENTS

    def _predicates_of(self, owner: str) -> Iterator[PredicateCode]:
        return (each for each in self._program.predicates if each.class_name == owner)

    def _operand(self, operand: Operand, scope: Key, tokens: dict[int, str]) -> Iterator[Key]:
        match operand:
            case GlobalVariable(index=index):
                yield ("global", self._number, self._program.globals[index][0])
            case LocalVariable(slot=slot):
                yield (*scope, "local", slot)
            case TokenVariable(token=token, variable=variable) if token in tokens:
                predicate = tokens[token]
                names = self._parameters.get(predicate, [])
                if variable in (DURATION, START, END):
                    yield ("token", predicate, TIMES)
                elif FIRST_PARAMETER <= variable < FIRST_PARAMETER + len(names):
                    yield ("token", predicate, names[variable - FIRST_PARAMETER])
                if token:
                    yield (*scope, "child", token)
            case Field(base=base, members=members):
                yield from (("member", member) for member in members[-1:])
                if base is not None:
                    yield from self._operand(base, scope, tokens)
            case UnionOf(operands=operands):
                for one in operands:
                    yield from self._operand(one, scope, tokens)
            case _:
                pass


def _statement(span: Span) -> int:
    """Which statement of its file a stretch of text is in: a line may have many, and one may take many lines."""
    return sum(span.source.text.count(end, 0, span.begin) for end in ";{}")
