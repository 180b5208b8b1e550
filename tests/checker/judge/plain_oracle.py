"""An oracle of records: what was executed, held against the model by trying, without what the judge is made of.

Of a record it takes what anybody could have seen: tokens with their times, objects and arguments, and what was
published. Which rules ran, which token was taken for which child and what locals came to be, it finds out: a rule is
kept if some choice of children among the tokens keeps it. Where anything is open, or a repair has forgotten, it does
not object: what it objects to breaks the model, what it lets pass may yet do so.
"""

from collections.abc import Iterator
from math import inf

from compiler.program import (
    DURATION,
    FIRST_PARAMETER,
    OBJECT,
    STATE,
    Assign,
    Child,
    Constant,
    Field,
    GlobalVariable,
    Guard,
    Instruction,
    LocalVariable,
    NewObject,
    NewVariable,
    ObjectLoop,
    Operand,
    Post,
    Program,
    Relate,
    Sample,
    TokenVariable,
    UnionOf,
)
from nddl_lang.semantics.relations import Point
from runtime.executive.record import ReactorRecord, TokenRecord
from tests.checker.judge.plain_tries import (
    Frame,
    LoopRound,
    Mission,
    Step,
    Token,
    distances,
    hull,
    may_relate,
    narrow,
    times_of,
)
from tests.checker.judge.plain_values import Box, answer, box_of, box_of_constant, computed, overlap, truth

_TRIES = 1500
_CLOCKS = ("AGENT_CLOCK", "TICK_DURATION")


class _TiredError(Exception):
    """Too many choices were tried."""


class PlainOracle:
    """The rules of one model over one record."""

    def __init__(self, program: Program, record: ReactorRecord, mission: Mission) -> None:
        self.program, self.record, self.mission = program, record, mission
        self.bases = {code.name: code.base for code in program.classes}
        self.members = {code.name: [one.name for one in code.members] for code in program.classes}
        self.objects = {one.name: one for one in record.objects}
        codes = {code.name: code for code in program.predicates}
        self.tokens = [
            Token(one, codes[one.predicate], self._boxes(one))
            for one in record.tokens
            if one.state == "active" and times_of(box_of(one.start))[0] <= record.last_tick
        ]
        self.by_name: dict[str, list[Token]] = {}
        for token in self.tokens:
            self.by_name.setdefault(token.code.name.rpartition(".")[2], []).append(token)
        self.tries = 0
        self.undecided = 0

    @staticmethod
    def _boxes(one: TokenRecord) -> list[Box]:
        values = [box_of(value) for value in (one.object, one.duration, one.start, one.end, *one.arguments)]
        return [frozenset({one.state.upper()}), *values]

    def is_kind_of(self, class_name: str, other: str) -> bool:
        """Whether a class is another, or extends it."""
        known: str | None = class_name
        while known is not None and known != other:
            known = self.bases.get(known)
        return known == other

    # ---- what a model says of a token ----

    def objections(self) -> Iterator[str]:
        """The tokens of which no choice keeps what the model says."""
        for token in self.tokens:
            name = f"{token.code.name}#{token.record.key} at {token.record.start}"
            if (what := self._of_itself(token)) is not None:
                yield f"{name}: {what}"
            if token.record.fate == "cut" or not self._must_have_fired(token):
                continue
            for number in token.code.rules:
                rule = self.program.rules[number]
                if rule.declared_at and token.record.origin in ("fact", "goal"):
                    continue
                if not self._is_kept(token, rule.body):
                    yield f"{name}: no choice keeps the rule of {rule.predicate} at line {rule.span.line}"

    def _must_have_fired(self, token: Token) -> bool:
        """Of what a repair has forgotten, and what lies outside of the mission, nothing is known."""
        is_inside = token.end[1] > 0 and token.start[0] < self.mission.final_tick
        return is_inside and token.start[0] > self.mission.repaired

    def _of_itself(self, token: Token) -> str | None:
        start, end, duration = token.start, token.end, times_of(token.boxes[DURATION])
        if end[0] - start[1] > duration[1] or end[1] - start[0] < duration[0]:
            return "start + duration is not end"
        if end[1] - start[0] < (0 if token.code.is_event else 1):
            return "it ends before it has begun"
        for parameter, box in zip(token.code.parameters, token.boxes[FIRST_PARAMETER:], strict=True):
            for domain in (parameter.type.domain, parameter.domain):
                if domain is not None and overlap(box_of_constant(domain), box) is False:
                    return f"`{parameter.name}` is outside of its declaration"
        return None if self._is_kept(token, token.code.body) else "no choice keeps the body of its predicate"

    def _is_kept(self, token: Token, body: tuple[Instruction, ...]) -> bool:
        self.tries = 0
        try:
            return self._run(token, list(body), Frame({}, {0: token}))
        except _TiredError:
            self.undecided += 1
            return True

    # ---- one try ----

    def _run(self, token: Token, steps: list[Step], frame: Frame) -> bool:
        """Whether what is left of a body can be kept."""
        while steps:
            step = steps.pop(0)
            match step:
                case NewVariable():
                    if not self._declare(step, frame):
                        return False
                case Post():
                    frame.pending.append(step)
                    if not self._settle(frame):
                        return False
                case Sample():
                    if not self._drawn(token, step, frame):
                        return False
                case Assign():
                    if not self._assigned(step, frame):
                        return False
                case Relate():
                    a, b = frame.tokens.get(step.origin), frame.tokens.get(step.target)
                    if a is not None and b is not None and not may_relate(step.relation, step.bounds, a, b):
                        return False
                case ObjectLoop():
                    things = self._read(step.collection, frame)
                    names = [name for name in self.objects if isinstance(things, frozenset) and name in things]
                    inner: list[Step] = []
                    for name in names:
                        domain = frozenset({name})
                        inner += [LoopRound(step.slot, domain), *step.body]
                    steps[:0] = inner
                case LoopRound():
                    if not self._settle(frame):
                        return False
                    if branches := self._branches(frame):
                        steps[:0] = [*branches, step]
                        continue
                    frame.pending.clear()  # what is open of the round before, whose slots are filled anew
                    frame.guards.clear()
                    frame.slots[step.slot] = step.box
                case Guard():
                    if not self._settle(frame):
                        return False
                    frame.guards.append(step)
                case Child():
                    return self._choose(token, step, steps, frame)
                case NewObject():
                    if step.slot is not None:
                        frame.slots[step.slot] = None
                case _:
                    pass
            if not steps:
                steps += self._branches(frame)
        return self._settle(frame)

    def _branches(self, frame: Frame) -> list[Instruction]:
        """What the guards say whose conditions are known now."""
        found: list[Instruction] = []
        for guard in list(frame.guards):
            value = self._read(guard.condition, frame)
            holds = True if isinstance(value, frozenset) and len(value) == 1 else truth(value)
            if holds is not None:
                frame.guards.remove(guard)
                found += guard.then if holds else guard.otherwise
        return found

    def _choose(self, token: Token, child: Child, steps: list[Step], frame: Frame) -> bool:
        """Whether some token can be this child."""
        origin = frame.tokens.get(child.origin)
        given: Box = None
        if child.object == "own":
            given = token.boxes[OBJECT]
        elif not isinstance(child.object, str):
            given = self._read(child.object, frame)
        wanted, _, name = child.predicate.rpartition(".")
        for other in self.by_name.get(name, ()):
            if not self.is_kind_of(other.code.class_name, wanted):
                continue
            if overlap(other.boxes[OBJECT], given) is False:
                continue
            if origin is not None and not may_relate(child.relation, child.bounds, origin, other):
                continue
            self.tries += 1
            if self.tries > _TRIES:
                raise _TiredError
            next_frame = frame.copy()
            next_frame.tokens[child.slot] = other
            if self._run(token, list(steps), next_frame):
                return True
        if origin is not None and not self._may_be_outside(child, origin, given, wanted):
            return False
        frame.tokens[child.slot] = None
        return self._run(token, steps, frame)

    def _may_be_outside(self, child: Child, origin: Token, given: Box, wanted: str) -> bool:
        """Whether a child may lie after what is known, before the mission, or where nobody looks."""
        for thing in self.objects.values():
            if self.is_kind_of(thing.class_name, wanted) and (given is None or overlap(given, frozenset({thing.name}))):
                modes = dict(zip(self.members[thing.class_name], thing.members, strict=True))
                if modes.get("mode") == "Ignore":
                    return True
        low = {Point.TARGET_START: -inf, Point.TARGET_END: -inf}
        high = {Point.TARGET_START: inf, Point.TARGET_END: inf}
        at = {Point.ORIGIN_START: origin.start, Point.ORIGIN_END: origin.end}
        for earlier, later, least, most in distances(child.relation, child.bounds):
            if earlier in at and later in low:
                low[later] = max(low[later], at[earlier][0] + least)
                high[later] = min(high[later], at[earlier][1] + most)
            elif later in at and earlier in low:
                low[earlier] = max(low[earlier], at[later][0] - most)
                high[earlier] = min(high[earlier], at[later][1] - least)
        latest = min(high[Point.TARGET_START], high[Point.TARGET_END])
        if latest >= self.record.last_tick or max(low.values()) <= 0:
            return True
        return self.mission.failed and origin.end[1] >= self.record.last_tick

    # ---- variables and constraints ----

    def _declare(self, new: NewVariable, frame: Frame) -> bool:
        frame.slots[new.slot] = None
        for domain in (new.type.domain, new.domain):
            if domain is not None and not narrow(new.slot, box_of_constant(domain), frame):
                return False
        if new.type.kind == "object" and new.domain is None:
            names = [one.name for one in self.objects.values() if self.is_kind_of(one.class_name, new.type.type_name)]
            frame.slots[new.slot] = frozenset(names)
        return True

    def _drawn(self, token: Token, sample: Sample, frame: Frame) -> bool:
        start = token.record.start
        value = self.mission.draw(sample.parameter, start) if isinstance(start, int) else None
        if value is None:
            return True
        box = (value - 1e-9 * (1 + abs(value)), value + 1e-9 * (1 + abs(value)))
        if isinstance(sample.target, LocalVariable):
            return narrow(sample.target.slot, box, frame)
        return overlap(self._read(sample.target, frame), box) is not False

    def _assigned(self, given: Assign, frame: Frame) -> bool:
        if isinstance(given.value, NewObject):
            return True
        value = self._read(given.value, frame) if given.value is not None else None
        if given.domain is not None:
            value = box_of_constant(given.domain)
        if isinstance(given.target, LocalVariable):
            return narrow(given.target.slot, value, frame)
        return overlap(self._read(given.target, frame), value) is not False

    def _settle(self, frame: Frame) -> bool:
        """Compute what follows, and tell whether nothing contradicts it."""
        moves = True
        while moves:
            moves = False
            for post in list(frame.pending):
                boxes = [self._read(one, frame) for one in post.operands]
                holds = answer(post.name, boxes)
                if holds is False:
                    return False
                if holds:
                    frame.pending.remove(post)
                    continue
                for place, operand in enumerate(post.operands):
                    if not isinstance(operand, LocalVariable):
                        continue
                    found = computed(post.name, boxes, place)
                    before = frame.slots.get(operand.slot)
                    if found is None or (before is not None and not isinstance(found, frozenset)):
                        continue
                    if not narrow(operand.slot, found, frame):
                        return False
                    moves = moves or frame.slots[operand.slot] != before
        return True

    def _read(self, operand: Operand, frame: Frame) -> Box:
        match operand:
            case Constant(domain=domain):
                return box_of_constant(domain)
            case GlobalVariable(index=index):
                name = self.program.globals[index][0]
                return None if name in _CLOCKS else box_of(self.record.globals[index])
            case LocalVariable(slot=slot):
                return frame.slots.get(slot)
            case TokenVariable(token=number, variable=variable):
                token = frame.tokens.get(number)
                if token is None or variable == STATE or variable >= len(token.boxes):
                    return None
                if variable == DURATION:
                    return token.end[0] - token.start[1], token.end[1] - token.start[0]
                return token.boxes[variable]
            case Field(base=base, members=members):
                value = None if base is None else self._read(base, frame)
                for member in members:
                    value = self._member(value, member)
                return value
            case UnionOf(operands=operands):
                return hull([self._read(one, frame) for one in operands])

    def _member(self, things: Box, member: str) -> Box:
        if not isinstance(things, frozenset):
            return None
        found: list[Box] = []
        for name in sorted(things):
            thing = self.objects.get(name)
            if thing is None or member not in self.members[thing.class_name]:
                return None
            found.append(box_of(thing.members[self.members[thing.class_name].index(member)]))
        return hull(found)
