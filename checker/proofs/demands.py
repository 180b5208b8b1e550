"""The body of a rule, followed along a recorded run: what it demands of the variables of the plan, line by line."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import isinf

import z3

from checker.judge.relations import demands as relation_demands
from checker.judge.values import ENDLESS
from checker.proofs.claims import Claim, Number, claim_of, is_silent
from checker.proofs.operands import ProgramNames, Symbols, name_of, number, token_number
from compiler.program import (
    END,
    START,
    Assign,
    Child,
    Constant,
    Guard,
    Instruction,
    NewObject,
    NewVariable,
    ObjectLoop,
    Operand,
    Post,
    Relate,
    Sample,
)
from nddl_lang.text.source import Span
from runtime.executive.record import NOBODY, BodyRun, GuardRun, ObjectRecord, OpenValues, Value, ValueRange


@dataclass(frozen=True, eq=False, slots=True)
class Demand:
    """One demand on variables: a constraint `name` of `numbers`, or a claim by itself (`name` empty).

    `name` is `gap` for `lower <= numbers[1] - numbers[0] <= upper`. `span` is its line, None for what no line says;
    `token` whose rule it is of. `structure`: it says which structure is meant (order, branches), not what must hold.
    """

    name: str
    numbers: tuple[Number, ...]
    claim: Claim
    span: Span | None
    token: str = ""
    reactor: str = ""
    is_structure: bool = False


def gap(
    earlier: Number, later: Number, lower: float, upper: float, span: Span | None, token: str = "", reactor: str = ""
) -> Demand:
    """`lower <= later - earlier <= upper`; infinite ends are none."""
    if lower == upper:
        numbers = (earlier, z3.IntVal(int(lower)), later)
        return Demand("temporalDistance", numbers, later - earlier == int(lower), span, token, reactor)
    parts = []
    if not isinf(lower):
        parts.append(later - earlier >= int(lower))
    if not isinf(upper):
        parts.append(later - earlier <= int(upper))
    bounds = (z3.IntVal(int(lower)) if not isinf(lower) else None, z3.IntVal(int(upper)) if not isinf(upper) else None)
    return Demand("gap", (earlier, later, *bounds), z3.And(*parts), span, token, reactor)


def equal(a: Number, b: Number, span: Span | None = None, *, is_structure: bool = False) -> Demand:
    """Two variables are one."""
    return Demand("eq", (a, b), a == b, span, is_structure=is_structure)


def _sampled(parameter: str, token: str = "") -> Number:
    """The value of a sampled parameter; of one that is drawn again and again, the value that `token` gets."""
    return z3.Real(f"sampled {parameter} of {token}" if token else f"sampled {parameter}")


class RunReader:
    """Follows the bodies of one token's rules; what it cannot tell is counted in `untold`, by name."""

    def __init__(
        self,
        names: ProgramNames,
        symbols: Symbols,
        reactor: str,
        predicates: Mapping[int, str],
        objects: Mapping[str, ObjectRecord],
        values: dict[str, Value],
        redrawn: frozenset[str],
        draws: dict[str, dict[str, None]],
    ) -> None:
        self.names = names
        self.symbols = symbols
        self.reactor = reactor
        self.predicates = predicates  # of the tokens that stand for each key
        self.objects = objects
        self.values = values
        self.redrawn = redrawn
        self.untold: dict[str, int] = {}
        self.silent: dict[str, Span | None] = {}  # constraints without a translation, with the first place
        self.lost: dict[str, Span | None] = {}  # those about something that the flight has no value of
        self.draws = draws  # the variables of each sampled parameter that was read are added
        self.slots: dict[int, Number] = {}
        self.loops: dict[int, str] = {}  # slots of loops, with the object they stand at
        self.keys: dict[int, int] = {}
        self.token_name = ""

    # ---- operands ----

    def token(self, slot: int) -> tuple[str, str] | None:
        """The token in a slot by name and predicate."""
        key = self.keys.get(slot)
        known = self.predicates.get(key) if key is not None else None
        return None if known is None else (f"{self.reactor}:{key}", known)

    def local(self, slot: int) -> Number | None:
        """The variable in a slot."""
        thing = self.loops.get(slot)
        return self.symbols.constant(thing, "object") if thing is not None else self.slots.get(slot)

    def world(self, index: int) -> Number | None:
        """A global variable."""
        name, code = self.names.program.globals[index]
        return None if name == "AGENT_CLOCK" else self.symbols.variable(f"{self.reactor}:{name}", code.kind)

    def member(self, base: Operand | None, members: Sequence[str]) -> Number | None:
        """The value of a member of an object that the record names."""
        thing: Value | None = None if base is None else self.value(base)
        kind = "int"
        for name in members:
            known = self.objects.get(str(thing))
            if known is None:
                return None
            code = next(each for each in self.names.program.classes if each.name == known.class_name)
            index = next((k for k, each in enumerate(code.members) if each.name == name), None)
            if index is None:
                return None
            thing, kind = known.members[index], code.members[index].type.kind
        return None if thing is None or isinstance(thing, tuple) else self.symbols.constant(thing, kind)

    def value(self, operand: Operand) -> Value | None:
        """The recorded value of an operand."""
        if isinstance(operand, Constant) and operand.domain.values is not None and len(operand.domain.values) == 1:
            return operand.domain.values[0]
        slot = getattr(operand, "slot", None)
        if slot is not None and slot in self.loops:
            return self.loops[slot]
        found = number(operand, self, [])
        return None if found is None else self.values.get(name_of(found))

    # ---- bodies ----

    def follow(self, body: Sequence[Instruction], run: BodyRun, own: int) -> Iterator[Demand]:
        """What one run of a rule's body demands."""
        self.slots, self.loops, self.keys = {}, {}, {0: own}
        yield from self._body(body, run)

    def bare(self, body: Sequence[Instruction], own: int) -> Iterator[Demand]:
        """What a body without locals on record demands (that of a predicate, or the script)."""
        self.slots, self.loops, self.keys = {}, {}, {0: own}
        yield from self._body(body, BodyRun(0, (), (), ()))

    def _body(self, body: Sequence[Instruction], run: BodyRun) -> Iterator[Demand]:
        yield from self._steps(body, iter(run.locals), iter(run.children), iter(run.guards))

    def _steps(self, body: Sequence[Instruction], locals_: Iterator, children: Iterator, guards: Iterator) -> Iterator:  # type: ignore[type-arg]
        for each in body:
            match each:
                case NewVariable():
                    yield from self._variable(each, locals_)
                case Post():
                    yield from self._post(each)
                case Sample():
                    yield from self._sample(each)
                case Child(slot=slot):
                    self.keys[slot] = next(children, NOBODY)
                    yield from self._related(each, each.origin, slot)
                case Relate(origin=origin, target=target):
                    yield from self._related(each, origin, target)
                case Assign():
                    yield from self._assign(each)
                case Guard():
                    yield from self._guard(each, next(guards, None))
                case ObjectLoop():
                    yield from self._loop(each, locals_, children, guards)
                case _:
                    pass

    def _variable(self, new: NewVariable, locals_: Iterator[Value]) -> Iterator[Demand]:
        target = self.slots[new.slot] = self.symbols.anonymous(new.type.kind)
        self.loops.pop(new.slot, None)
        if new.name is not None:
            value = next(locals_, None)
            if value is not None:
                self.values[name_of(target)] = value
        domains = [each for each in (new.type.domain, new.domain) if each is not None]
        if domains:
            yield self._demand(
                "", (target,), z3.And(*[self.symbols.within(target, each) for each in domains]), new.span
            )

    def _post(self, post: Post) -> Iterator[Demand]:
        if is_silent(post.name):
            return
        match post.name, post.operands:
            case "temporalDistance", (first, Constant(domain=domain), last) if domain.interval is not None:
                ends = number(first, self, []), number(last, self, [])
                if ends[0] is not None and ends[1] is not None:
                    lower, upper = (
                        float("inf") * (1 if each > 0 else -1) if abs(each) >= ENDLESS else each
                        for each in domain.interval
                    )
                    yield gap(*ends, lower, upper, post.span, self.token_name, self.reactor)
                    return
        base: list[Claim] = []
        numbers = [number(each, self, base) for each in post.operands]
        claim = None if any(each is None for each in numbers) else claim_of(post.name, numbers)
        if claim is None:
            self._omit(post.name)
            why = self.lost if any(each is None for each in numbers) else self.silent
            why.setdefault(post.name, post.span)
            return
        if base:
            yield self._demand("", tuple(numbers), z3.And(claim, *base), post.span)
        else:
            yield self._demand(post.name, tuple(numbers), claim, post.span)

    def _sample(self, sample: Sample) -> Iterator[Demand]:
        target = number(sample.target, self, [])
        if target is None:
            self._omit("sampledParameter")
            return
        value = _sampled(
            sample.parameter, f"{self.reactor}:{self.token_name}" if sample.parameter in self.redrawn else ""
        )
        self.draws.setdefault(sample.parameter, {}).setdefault(name_of(value))
        known = z3.ToInt(value) if z3.is_int(target) else value
        yield self._demand("eq", (target, known), target == known, sample.span)

    def _related(self, given: Child | Relate, origin: int, target: int) -> Iterator[Demand]:
        ends = self.token(origin), self.token(target)
        if ends[0] is None or ends[1] is None:
            self._omit(given.relation)
            return
        times = [
            token_number(*each, point, self.names, self.symbols) for each in ends if each for point in (START, END)
        ]
        for first, second, lower, upper in relation_demands(given.relation, given.bounds):
            yield gap(times[first], times[second], lower, upper, given.span, self.token_name, self.reactor)

    def _assign(self, given: Assign) -> Iterator[Demand]:
        base: list[Claim] = []
        target = number(given.target, self, base)
        if target is None or isinstance(given.value, NewObject):
            return
        if given.domain is not None:
            values, span = given.domain.values, given.span
            if values is not None and len(values) == 1:
                value = self.symbols.constant(values[0], given.domain.kind)
                yield self._demand("eq", (target, value), target == value, span)
            else:
                yield self._demand("", (target,), self.symbols.within(target, given.domain), span)
        elif given.value is not None:
            value = number(given.value, self, base)
            if value is not None and not base:
                yield self._demand("eq", (target, value), target == value, given.span)

    def _guard(self, guard: Guard, reached: GuardRun | None) -> Iterator[Demand]:
        if reached is None or reached.branch == "waiting":
            self._omit("a guard that waits")
            return
        branch, run = reached.branch, reached.run
        condition = number(guard.condition, self, [])
        if condition is not None and (z3.is_int(condition) or z3.is_real(condition)):
            claim = condition != 0 if branch == "then" else condition == 0
            yield Demand("", (condition,), claim, guard.span, self.token_name, self.reactor, is_structure=True)
        if run is not None:
            kept = dict(self.slots), dict(self.loops), dict(self.keys)
            yield from self._body(guard.then if branch == "then" else guard.otherwise, run)
            self.slots, self.loops, self.keys = kept

    def _loop(self, loop: ObjectLoop, locals_: Iterator, children: Iterator, guards: Iterator) -> Iterator[Demand]:  # type: ignore[type-arg]
        things = self.value(loop.collection)
        if things is None or isinstance(things, ValueRange):
            self._omit("a loop over objects")
            return
        wanted = {str(each) for each in things.values} if isinstance(things, OpenValues) else {str(things)}
        for name in self.objects:
            if name in wanted:
                self.loops[loop.slot] = name
                yield from self._steps(loop.body, locals_, children, guards)

    def _demand(self, name: str, numbers: tuple[Number, ...], claim: Claim, span: Span | None) -> Demand:
        return Demand(name, numbers, claim, span, self.token_name, self.reactor)

    def _omit(self, name: str) -> None:
        self.untold[name] = self.untold.get(name, 0) + 1
