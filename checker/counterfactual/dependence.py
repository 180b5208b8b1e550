"""Programs and sites in, a dependence graph out: which lines bear on which, within a rule and across reactors.

Two lines hang together by a variable: a local one, a global one, or the parameters and times of a predicate. The last
are the same in the reactor that publishes a token, in those that see it, and in those that ask for it: so an observed
argument leads to the line that sets it, and a request to its sender.
"""

import heapq
import re
from collections import defaultdict
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from checker.counterfactual.instructions import flat, is_shared, pairs_in
from checker.mutation.edits import EditSite
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
from nddl_lang.text.read import real_path
from nddl_lang.text.source import Span

Key = tuple[object, ...]  # of a variable
_TIMES = "times"
_DURATION = "duration"
# Relations that leave the end of the origin free, where nothing says when the target begins.
_FREE = ("any", "contains", "starts", "met_by", "after", "meets", "before")
_RESOURCES = ("Reservoir", "Reusable", "CBReusable", "Unary")
_EVENTS = "Reservoir"  # whose tokens have one time
_MOST_BESIDE = 12  # lines that speak of a variable which still says that they hang together
_PASSING = re.compile(r"\s*([A-Za-z_][\w.]*)\s*==\s*([A-Za-z_][\w.]*)\s*;")
_CROWD = 0.05  # what each further line that bears on a variable adds to the way through it


@dataclass(frozen=True, slots=True)
class LooseEnd:
    """A variable of a rule that at most one line speaks of, or the times of its token: one more line may be missing.

    `site` is the number of the line that declares it, of the child whose parameter it is, or of the head of the rule.
    `is_local`: it is declared in the rule itself, so that nothing else can say what it is. `is_uneven`: the other
    branch of a condition sets it.
    """

    site: int
    variable: str
    is_set_elsewhere: bool = False  # by other rules of the same model
    is_local: bool = False
    is_uneven: bool = False


class Dependence:
    """The sites of some programs by number, and the variables that join them."""

    def __init__(self, programs: Sequence[Program], sites: Sequence[EditSite]) -> None:
        self.sites = sites
        self._at: dict[tuple[str, int], list[int]] = defaultdict(list)
        for number, site in enumerate(sites):
            for line in range(site.first, site.last + 1):
                self._at[site.file, line].append(number)
        self._keys: dict[int, set[Key]] = defaultdict(set)
        self._users: dict[Key, set[int]] = defaultdict(set)
        self._paths: dict[str, str] = {}
        self._named = {site.named for site in sites if site.named}
        self.programs = programs
        for number, program in enumerate(programs):
            for span, keys in _Links(number, program).all():
                for one in self._at.get(self._line(span), ()):
                    self._keys[one].update(keys)
                    for key in keys:
                        self._users[key].add(one)

    def at(self, file: str, line: int) -> Sequence[int]:
        """The sites at a line."""
        return self._at.get((file, line), ())

    def at_span(self, span: Span) -> Sequence[int]:
        """The sites in the line where something is written."""
        return self.at(*self._line(span))

    def within(self, span: Span) -> Iterator[int]:
        """The sites in the lines of a rule or a branch."""
        file, first = self._line(span)
        last = span.source.locate(max(span.begin, span.finish - 1))[0]
        for line in range(first, last + 1):
            yield from self._at.get((file, line), ())

    def of_predicate(self, predicate: str) -> Iterable[int]:
        """The sites that bear on a token of a predicate, whatever its class."""
        for key in self._users:
            if key[0] == "token" and str(key[1]).rpartition(".")[2] == predicate:
                yield from self._users[key]

    def of_resource(self, predicate: str) -> Iterator[int]:
        """The sites that bear on an event of a resource, and where that is made; none for other predicates."""
        native = any(
            one.name == predicate.rpartition(".")[0] and one.native in _RESOURCES
            for program in self.programs
            for one in program.classes
        )
        for key in self._users if native else ():
            if key[:2] == ("token", predicate):
                yield from self._users[key]

    def setting(self, predicate: str, variable: str) -> Iterator[int]:
        """The sites in the rule of a predicate that bear on a parameter of its token, or on how long that lasts."""
        key = ("token", predicate, _TIMES if variable in (_DURATION, "end") else variable)
        yield from sorted(one for one in self._users.get(key, ()) if self.sites[one].rule == predicate)

    def asking(self, predicate: str, variable: str = _TIMES) -> Iterator[int]:
        """The sites by which other rules bound a parameter, or the times, of the tokens of a predicate."""
        name = _TIMES if variable in (_DURATION, "start", "end") else variable
        for key in [key for key in self._users if key[0] == "token" and key[2] == name]:
            if predicate in (key[1], str(key[1]).rpartition(".")[2]):
                yield from sorted(one for one in self._users[key] if self.sites[one].rule not in ("", key[1]))

    def tokens_at(self, sites: Iterable[int]) -> set[str]:
        """The predicates of the tokens whose times lines speak of."""
        return {str(key[1]) for one in sites for key in self._keys[one] if key[0] == "token" and key[2] == _TIMES}

    def expected_with(self, sites: Iterable[int], held: Container[str]) -> set[str]:
        """The predicates that never held, of those that lines speak of, and of what is to be related to these in time.

        Names come without their classes. What should have begun waits for what it is related to.
        """
        waiting = self.tokens_at(sites)
        related: dict[str, set[str]] = defaultdict(set)
        shared: set[str] = set()
        for program in self.programs:
            shared |= {each.name for each in program.predicates if is_shared(each.class_name, program)}
            for rule in program.rules:
                for one, other in pairs_in(rule):
                    related[one].add(other)
                    related[other].add(one)
        found: set[str] = set()
        while waiting:
            name = waiting.pop()
            if name in shared and name not in found and name.rpartition(".")[2] not in held:
                found.add(name)
                waiting |= related[name]
        return {name.rpartition(".")[2] for name in found}

    def beside(self, site: EditSite) -> set[EditSite]:
        """The other lines that speak of a variable of a line, where few do."""
        numbers = [one for one in self.at(site.file, site.first) if self.sites[one] is site]
        groups = [self._users[key] for one in numbers for key in self._keys[one]]
        found = {self.sites[one] for group in groups if len(group) <= _MOST_BESIDE for one in group}
        return found - {site}

    def distances(self, roots: Mapping[int, float], through: float = 1.0) -> dict[int, float]:
        """How far each site is from the nearest root, whose own distance is given: shortest ways through variables.

        A way is so long `through` a line that passes a value on, and nothing more.
        """
        found: dict[int, float] = {}
        passed: set[Key] = set()
        queue = [(far, site) for site, far in roots.items()]
        heapq.heapify(queue)
        while queue:
            far, site = heapq.heappop(queue)
            if site in found:
                continue
            found[site] = far
            for key in self._keys[site] - passed:
                passed.add(key)
                step = (through if self._is_passing(site) else 1.0) + _CROWD * len(self._users[key])
                for other in self._users[key]:
                    if other not in found:
                        heapq.heappush(queue, (far + step, other))
        return found

    def _is_passing(self, site: int) -> bool:
        """Whether a line says no more than that two variables are equal."""
        sides = _PASSING.fullmatch(self.sites[site].text)
        return sides is not None and all(side.partition(".")[0] not in self._named for side in sides.groups())

    def loose_ends(self) -> list[LooseEnd]:
        """The loose ends of all rules: locals, parameters of the own token and of children, and times.

        Of an observed token the reactor that owns it says how long it lasts.
        """
        found: dict[LooseEnd, None] = {}
        timed = {
            rule.predicate
            for number, program in enumerate(self.programs)
            for index, rule in enumerate(program.rules)
            if all(one != _DURATION for _, one, _, _ in _Links(number, program).loose(rule, ("rule", number, index)))
        }
        for number, program in enumerate(self.programs):
            for index, rule in enumerate(program.rules):
                file, line = self._line(rule.span)
                heads = [one for one in self.at(file, line) if self.sites[one].is_rule]
                if not heads:
                    continue
                links = _Links(number, program)
                for span, variable, key, is_local in links.loose(rule, ("rule", number, index)):
                    if variable == _DURATION and rule.predicate in timed:
                        continue
                    declared = [one for one in self.at(*self._line(span)) if not self.sites[one].is_rule]
                    site = declared[0] if span is not rule.span and declared else heads[0]
                    found[LooseEnd(site, variable, bool(self._users.get(key)), is_local)] = None
        return list(found)

    def _line(self, span: Span) -> tuple[str, int]:
        name = span.source.name
        if name not in self._paths:
            self._paths[name] = str(real_path(Path(name)))
        return self._paths[name], span.line


class _Links:
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
            yield rule.span, [("token", rule.predicate, _TIMES)]
            yield from self._body(rule.body, ("rule", self._number, index), tokens, ())
        for index, predicate in enumerate(self._program.predicates):
            yield from self._body(predicate.body, ("predicate", self._number, index), {0: predicate.name}, ())
        yield from self._body(self._program.script, ("script", self._number), {}, ())

    def loose(self, rule: RuleCode, scope: Key) -> Iterator[tuple[Span, str, Key, bool]]:
        """What a rule leaves loose: where that is declared, its name, the key under which other rules speak of it.

        The last says whether it is a local variable.
        """
        lines: dict[Key, set[int]] = defaultdict(set)
        declared: dict[Key, tuple[Span, str]] = {}
        steps = list(flat(rule.body))
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
                times = ("token", marked[0], _TIMES)
                is_event = any(("token", marked[one], _TIMES) in self._keys(step, scope, marked) for one in events)
                for key in self._keys(step, scope, marked):
                    if not (is_event and key == times):  # when an event comes leaves the end free
                        lines[key].add(step.span.line)
        for name in self._parameters[marked[0]]:
            declared["token", marked[0], name] = (rule.span, name)
        for key, (span, name) in declared.items():
            is_local = key[0] != "token"
            if len(lines[key]) < (2 if is_local else 1):
                yield span, name, () if is_local else ("token", str(key[1]).partition("#")[0], name), is_local
        if not lines["token", marked[0], _TIMES] and all(
            step.relation in _FREE for step in steps if isinstance(step, Child) and step.origin == 0
        ):
            yield rule.span, _DURATION, (), False

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
                yield from (("token", tokens[one], _TIMES) for one in (slot, origin) if one in tokens)
                yield (*scope, "child", slot)
            case NewToken(predicate=predicate):
                yield ("token", predicate, _TIMES)
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
            if owner.native in _RESOURCES:
                for each in self._predicates_of(owner.name):
                    yield ("token", each.name, _TIMES)
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
                    yield ("token", predicate, _TIMES)
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
