"""A plan of one reactor: tokens over a network of numbers, rules that are carried out, places on timelines."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from itertools import pairwise

from tests.executive.second.description import (
    FAR,
    Apart,
    Between,
    Bound,
    Child,
    Description,
    Drawn,
    Guarded,
    Item,
    Part,
    Relation,
    Use,
)
from tests.executive.second.network import NOBODY, ORDER, ContradictionError, Network

Draw = Callable[[str, int], int]  # a parameter, the tick


@dataclass(eq=False, slots=True)
class Goal:
    """What somebody asked for."""

    number: int
    timeline: str
    predicate: str
    arguments: dict[str, int]
    start: tuple[int, int]
    end: tuple[int, int]
    duration: tuple[int, int]
    sender: str = ""  # of the mission file: empty
    state: str = "waiting"  # open, placed, begun, over, rejected, cut, gone
    recall: int | None = None
    order: int = 0
    is_told: bool = False  # that it was rejected
    failures: int = 0  # of the present, when what it had asked for began
    is_late: bool = False  # it runs, and its end cannot be as was asked

    @property
    def speaker(self) -> int:
        """Who says what it asks of end and length, in a network."""
        return -1000 - self.number


@dataclass(frozen=True, eq=False, slots=True)
class Token:
    """Its numbers in the network."""

    number: int
    timeline: str
    predicate: str
    start: int
    end: int
    length: int
    arguments: dict[str, int]
    parent: int | None = None
    label: str = ""
    goal: Goal | None = None


@dataclass(slots=True)
class Plan:
    """Copied before each choice."""

    description: Description
    part: Part
    draw: Draw
    now: int = -1
    net: Network = field(default_factory=Network)
    tokens: list[Token] = field(default_factory=list)
    state: list[str] = field(default_factory=list)  # open, active, begun, merged, dropped
    into: list[int] = field(default_factory=list)
    goals_of: list[tuple[Goal, ...]] = field(default_factory=list)
    sequence: dict[str, list[int]] = field(default_factory=dict)
    current: dict[str, int] = field(default_factory=dict)
    waiting: list[tuple[int, Item]] = field(default_factory=list)
    children: dict[tuple[int, str], int] = field(default_factory=dict)
    choices: int = 0  # that were open to the planner: more than one place
    decisions: int = 0
    uses: list[tuple[int, Use]] = field(default_factory=list)  # of stores, by tokens
    spent: tuple[tuple[str, int, int], ...] = ()  # of stores by what is forgotten: how much, when
    bare: frozenset[int] = frozenset()  # what is over and forgotten, but for that it has happened

    def copy(self) -> "Plan":
        """The same plan, to be changed."""
        return Plan(
            self.description, self.part, self.draw, self.now, self.net.copy(), self.tokens[:], self.state[:],
            self.into[:], self.goals_of[:], {key: value[:] for key, value in self.sequence.items()},
            dict(self.current), self.waiting[:], dict(self.children), self.choices, self.decisions, self.uses[:],
            self.spent, self.bare,
        )  # fmt: skip

    def new(
        self, timeline: str, predicate: str, parent: int | None = None, label: str = "", goal: Goal | None = None
    ) -> int:
        """An open token."""
        net, number = self.net, len(self.tokens)
        start, end, length = net.new(), net.new(), net.new(1)
        net.differ(start, end, 1, FAR)
        ranges = {one[2]: one[3:] for one in self.part.ranges if one[:2] == (timeline, predicate)}
        arguments = {
            name: net.new(*ranges.get(name, (-FAR, FAR)))
            for name in self.description.kind(timeline).parameters(predicate) or ()
        }
        self.tokens.append(Token(number, timeline, predicate, start, end, length, arguments, parent, label, goal))
        self.state.append("open")
        self.into.append(number)
        self.goals_of.append((goal,) if goal else ())
        return number

    def looks_back(self, number: int) -> bool:
        """Whether some rule asks for its like among all that has happened, on a timeline of others."""
        token = self.tokens[number]
        asked = [item for rule in self.part.rules for item in _items(rule.body) if isinstance(item, Child)]
        named = [(one.timeline, one.predicate) for one in asked if one.relation in ("any", "after")]
        return token.timeline not in self.part.internal and (token.timeline, token.predicate) in named

    def stands_for(self, number: int) -> int:
        """The token that it was merged with, itself if with none."""
        while self.state[number] == "merged":
            number = self.into[number]
        return number

    def term(self, number: int, name: str) -> int:
        """A number of a token."""
        token = self.tokens[number]
        return token.start if name == "start" else token.end if name == "end" else token.arguments[name]

    def dotted(self, number: int, name: str) -> int:
        """A number of a token, or of a child of it."""
        label, _, last = name.rpartition(".")
        return self.term(self.children[number, label] if label else number, last)

    def window(self, number: int) -> tuple[int, int]:
        """When it may start."""
        start = self.tokens[number].start
        return self.net.low[start], self.net.high[start]

    def ends(self, number: int) -> tuple[int, int]:
        """When it may end."""
        end = self.tokens[number].end
        return self.net.low[end], self.net.high[end]

    def values(self, number: int) -> dict[str, int | None]:
        """Its arguments, as far as they are known."""
        return {name: self.net.value(one) for name, one in self.tokens[number].arguments.items()}

    def open(self) -> list[int]:
        """Tokens that nothing is decided about."""
        return [number for number, state in enumerate(self.state) if state == "open"]

    def planned(self, timeline: str) -> list[int]:
        """Those that are to begin there, in order."""
        return [one for one in self.sequence.get(timeline, []) if self.state[one] == "active"]

    def insert(self, number: int, place: int) -> None:
        """Put an open token on its timeline, and carry out its rules."""
        token = self.tokens[number]
        line = self.sequence.setdefault(token.timeline, [])
        line.insert(place, number)
        self.state[number] = "active"
        self._order(line[max(0, place - 1) : place + 2])
        for rule in self.part.rules if number not in self.bare else ():
            if (rule.timeline, rule.predicate) == (token.timeline, token.predicate):
                for item in rule.body:
                    self.carry_out(number, item)
        self.settle()

    def _order(self, line: list[int]) -> None:
        self.net.speaker = ORDER
        for before, after in pairwise(line):
            self.net.differ(self.tokens[before].end, self.tokens[after].start, 0, FAR)
        self.net.speaker = NOBODY

    def descendants(self, number: int) -> set[int]:
        """A token that has not begun, with what it has asked for and what follows from that, as far as it has not."""
        found = {number} if self.state[number] != "begun" else set()
        for one in self.tokens if found else ():
            if one.parent == number:
                found |= self.descendants(one.number)
        return found

    def removed(self, gone: set[int]) -> "Plan":
        """The plan without tokens; what was merged with one of them is open again, what has begun goes on by itself."""
        plan = self.copy()
        merged = [one for one, state in enumerate(self.state) if state == "merged"]
        freed = [one for one in merged if one not in gone and self.into[one] in gone]
        plan.net = self.net.without({*gone, *freed, ORDER})
        for one in gone:
            if self.state[one] == "merged":
                kept = [goal for goal in plan.goals_of[self.into[one]] if goal not in self.goals_of[one]]
                plan.goals_of[self.into[one]] = tuple(kept)
            plan.state[one] = "dropped"
        for one in freed:
            plan.state[one], plan.into[one] = "open", one
        plan.tokens = [replace(one, parent=None) if one.parent in gone else one for one in plan.tokens]
        plan.waiting = [one for one in plan.waiting if one[0] not in gone]
        plan.uses = [one for one in plan.uses if one[0] not in gone]
        for timeline, line in plan.sequence.items():
            plan.sequence[timeline] = [one for one in line if one not in gone]
            plan._order(plan.sequence[timeline])
        plan.settle()
        return plan

    def begin(self, number: int, tick: int) -> None:
        """It begins now."""
        token = self.tokens[number]
        self.net.within(token.start, tick, tick)
        self.net.least(token.end, tick + 1)
        self.state[number] = "begun"
        self.current[token.timeline] = number
        self.settle()

    def merge(self, number: int, other: int) -> None:
        """An open token is another that is there."""
        mine, its = self.tokens[number], self.tokens[other]
        self.net.speaker = number
        self.net.differ(mine.start, its.start, 0, 0)
        self.net.differ(mine.end, its.end, 0, 0)
        self.net.differ(mine.length, its.length, 0, 0)
        for name, one in mine.arguments.items():
            self.net.differ(one, its.arguments[name], 0, 0)
        self.net.speaker = NOBODY
        self.state[number], self.into[number] = "merged", other
        self.goals_of[other] = (*self.goals_of[other], *self.goals_of[number])
        self.settle()

    def carry_out(self, number: int, item: Item) -> None:
        """One thing that a rule says of a token."""
        self.net.speaker = number
        self._carry_out(number, item)
        self.net.speaker = NOBODY

    def _carry_out(self, number: int, item: Item) -> None:
        net = self.net
        match item:
            case Bound("duration", low, high):
                self.last(number, low, high)
            case Bound(term, low, high):
                net.within(self.term(number, term), low, high)
            case Use():
                self.uses.append((number, item))
            case Drawn() | Guarded():
                self.waiting.append((number, item))
            case Child(relation, timeline, predicate, label, ties):
                child = self.new(timeline, predicate, number, label)
                self.children[number, label] = child
                self.relate(number, relation, child)
                for tie in ties:
                    if tie.term == "duration":
                        self.last(child, tie.low, tie.high)
                        continue
                    one = self.term(child, tie.term)
                    if tie.of_parent:
                        net.differ(self.term(number, tie.of_parent), one, tie.low, tie.high)
                    else:
                        net.within(one, tie.low, tie.high)
            case Apart(term, "", low, high) if term.endswith(".duration"):
                child = self.children[number, term.rpartition(".")[0]]
                self.last(child, low, high)
            case Apart(term, "", low, high):
                net.within(self.dotted(number, term), low, high)
            case Apart(term, other, low, high):
                net.differ(self.dotted(number, other), self.dotted(number, term), low, high)
            case Between(first, relation, second):
                self.relate(self.children[number, first], relation, self.children[number, second])

    def last(self, number: int, low: int, high: int) -> None:
        """It takes so long."""
        token = self.tokens[number]
        self.net.differ(token.start, token.end, low, high)
        self.net.within(token.length, low, high)

    def relate(self, number: int, relation: Relation, other: int) -> None:
        """A relation of one token to another."""
        mine, its, net = self.tokens[number], self.tokens[other], self.net
        if relation in ("equals", "starts"):
            net.differ(mine.start, its.start, 0, 0)
        if relation in ("equals", "ends"):
            net.differ(mine.end, its.end, 0, 0)
        if relation == "equals":
            net.differ(mine.length, its.length, 0, 0)
        if relation in ("meets", "before"):
            net.differ(mine.end, its.start, 0, 0 if relation == "meets" else FAR)
        if relation in ("met_by", "after"):
            net.differ(its.end, mine.start, 0, 0 if relation == "met_by" else FAR)
        if relation == "starts_during":
            net.differ(its.start, mine.start, 0, FAR)
            net.differ(mine.start, its.end, 1, FAR)
        if relation in ("contains", "contained_by"):
            outer, inner = (mine, its) if relation == "contains" else (its, mine)
            net.differ(outer.start, inner.start, 0, FAR)
            net.differ(inner.end, outer.end, 0, FAR)
            net.differ(inner.length, outer.length, 0, FAR)

    def settle(self) -> None:
        """Carry out what waited, as far as its time has come."""
        moved = True
        while moved:
            moved = False
            for one in self.waiting[:]:
                number, item = one
                fires = self._fires(number, item)
                if fires is None:
                    continue
                self.waiting.remove(one)
                moved = True
                if fires and isinstance(item, Guarded):
                    for inner in item.body:
                        self.carry_out(number, inner)
                elif isinstance(item, Drawn):
                    self._drawn(number, item)

    def _drawn(self, number: int, item: Drawn) -> None:
        value = self.draw(item.parameter, max(0, self.window(number)[0]))
        if item.term == "duration":
            self.last(number, value, value)
        else:
            self.net.within(self.term(number, item.term), value, value)

    def _fires(self, number: int, item: Item) -> bool | None:
        if isinstance(item, Drawn):
            redrawn = any(one.update for one in self.description.parameters if one.name == item.parameter)
            return True if not redrawn or self.state[number] == "begun" else None
        assert isinstance(item, Guarded)
        if not item.parameter:
            low, high = self.window(number)
            return True if high <= self.now else False if low >= FAR else None
        one = self.tokens[number].arguments[item.parameter]
        if not self.net.low[one] <= item.value <= self.net.high[one]:
            return False
        return True if self.net.value(one) is not None else None

    def targets(self, number: int) -> list[int]:
        """What an open token might be merged with, what has happened first."""
        token = self.tokens[number]
        line = self.sequence.get(token.timeline, [])
        return [one for one in line if self.tokens[one].predicate == token.predicate]

    def places(self, number: int) -> list[int]:
        """Where an open token might go: behind all that may begin no later, then from left to right."""
        token = self.tokens[number]
        line = self.sequence.get(token.timeline, [])
        first = sum(self.state[one] == "begun" for one in line)
        busy = self.ends(line[first - 1])[0] if first else 0
        low = self._wish(number, busy)
        wanted = max([first, *(place + 1 for place in range(first, len(line)) if self._wish(line[place], busy) <= low)])
        return [wanted, *(place for place in range(first, len(line) + 1) if place != wanted)]

    def _wish(self, number: int, busy: int) -> int:
        """The earliest start that a token would like, on a timeline that is busy until a time."""
        goals = self.goals_of[number]
        return max(busy, min(goal.start[0] for goal in goals) if goals else self.window(number)[0])

    def resolved(self, number: int, makes: bool = True) -> Iterator["Plan"]:
        """Plans in which an open token is decided: merged with what there is, else put somewhere."""
        for target in self.targets(number):
            plan = self.copy()
            try:
                plan.merge(number, target)
            except ContradictionError:
                continue
            yield plan
        if makes:
            for place in self.places(number):
                plan = self.copy()
                try:
                    plan.insert(number, place)
                except ContradictionError:
                    continue
                yield plan


def _items(body: tuple[Item, ...]) -> Iterator[Item]:
    for item in body:
        yield item
        if isinstance(item, Guarded):
            yield from _items(item.body)
