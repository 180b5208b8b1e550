"""Random missions of the family in which the text says what must come out; a seed in, a description out."""

from dataclasses import dataclass, field, replace

from numpy.random import Generator, default_rng

from tests.executive.second.description import (
    FAR,
    Between,
    Bound,
    Child,
    Description,
    Drawn,
    Guarded,
    Item,
    Kind,
    Parameter,
    Part,
    Relation,
    Rule,
    Store,
    Tie,
    Use,
    Wish,
)

SAME = (Tie("n", "n"),)


@dataclass(slots=True)
class Mission:
    """A mission that is being made up."""

    dice: Generator
    kinds: list[Kind] = field(default_factory=list)
    parts: list[Part] = field(default_factory=list)
    parameters: list[Parameter] = field(default_factory=list)
    sources: list[str] = field(default_factory=list)
    arms: list[str] = field(default_factory=list)
    tasks: list[str] = field(default_factory=list)
    lengths: dict[str, int] = field(default_factory=dict)  # how long what is asked of a timeline takes, about

    def below(self, most: int) -> int:
        """A number from 0 on."""
        return int(self.dice.integers(most))

    def one_of(self, *choices: int) -> int:
        """One of some numbers."""
        return choices[self.below(len(choices))]

    def happens(self, percent: int) -> bool:
        """Whether it does."""
        return self.below(100) < percent


def bounded_mission(seed: int) -> Description:
    """The mission of a seed, some of whose goals say how long they may take."""
    found, dice = random_mission(seed), default_rng((seed, 1))
    wishes = []
    for wish in found.wishes:
        low, slack = int(dice.choice((1, 2, 3, 5, 8, 12))), int(dice.choice((0, 0, 2, 4, 10)))
        wishes.append(replace(wish, duration=(low, low + slack)) if dice.integers(2) else wish)
    return replace(found, name=f"bounded_{seed}", wishes=tuple(wishes))


def following_mission(seed: int) -> Description:
    """The mission of a seed, in which a planner uses a valve of which its model says what follows."""
    found, dice = random_mission(seed), default_rng((seed, 2))
    length = int(dice.choice((0, 0, 4, 9)))
    kind = Kind("valve", (("Shut", ()), ("Open", ())))
    lasting = (Bound("duration", 1, length),) if length else ()
    own = Part("tap", 0, int(dice.choice((1, 1, 5))), ("valve",), rules=(Rule("valve", "Open", lasting),))
    relation: Relation = "contained_by" if dice.integers(2) else "starts"
    parts = []
    for part in found.parts:
        if part.name == "plan0":
            asked = Child(relation, "valve", "Open" if dice.integers(3) else "Shut", "o")
            one, other = ("Open", "Shut") if dice.integers(2) else ("Shut", "Open")
            turn = Rule("valve", one, (Child("meets", "valve", other, "t"),))
            rules = _asking_also(part, "Do", asked)
            part = replace(part, external=tuple(sorted((*part.external, "valve"))), rules=(*rules, turn))
        parts.append(part)
    kinds = (*found.kinds, kind)
    return replace(found, name=f"following_{seed}", kinds=kinds, parts=(own, *parts))


def storing_mission(seed: int) -> Description:
    """The mission of a seed, in which a planner, what it looks at, or an owner uses a store of its own model."""
    found, dice = random_mission(seed), default_rng((seed, 5))
    capacity, first = int(dice.choice((3, 4, 6))), 0
    is_reusable = bool(dice.integers(10) < 4)
    first = capacity if is_reusable else int(dice.choice((capacity, capacity, capacity - 1, 2)))
    store = Store("store", "Reusable" if is_reusable else "Reservoir", first, 0, capacity)
    side = Kind("side", (("Calm", ()), ("Run", ())))
    length = int(dice.choice((2, 4, 7)))
    parts = []
    for part in found.parts:
        if part.name == "plan0":
            own = Rule("side", "Run", (Bound("duration", length, length + int(dice.choice((0, 0, 3)))),))
            rules = [_using(rule, store, dice) for rule in (*part.rules, own)]
            if not is_reusable:
                rules.append(
                    Rule("task0", "Halt", (Bound("duration", 3, 3), Use("store", int(dice.integers(1, 4)), "end")))
                )
            orders = bool(dice.integers(4))
            part = replace(part, internal=(*part.internal, "side"), rules=tuple(rules), stores=(store,), orders=orders)
        elif part.name in ("owner0", "sim0") and dice.integers(3) == 0:
            part = replace(part, rules=tuple(_using(rule, store, dice) for rule in part.rules), stores=(store,))
        parts.append(part)
    wishes = []
    for wish in found.wishes:
        kind = int(dice.integers(6))
        if wish.timeline == "task0" and kind == 0:
            wish = replace(wish, predicate="Halt", arguments=())
        wishes.append(wish)
        if kind > 2:
            late = int(dice.integers(12))
            start = (wish.start[0] + late, wish.start[1] + late)
            wishes.append(replace(wish, timeline="side", predicate="Run", start=start, recall=None, arguments=()))
    kinds = (*found.kinds, side)
    return replace(found, name=f"storing_{seed}", kinds=kinds, parts=tuple(parts), wishes=tuple(wishes))


def _using(rule: Rule, store: Store, dice: Generator) -> Rule:
    """A rule whose token uses a store, mostly if it is asked for."""
    if rule.predicate not in ("Do", "Run", "Act", "B") or dice.integers(5) >= (2 if rule.predicate == "B" else 4):
        return rule
    amount = int(dice.integers(1 + store.most // 3, store.most + 1))
    if store.kind == "Reusable":
        return replace(rule, body=(*rule.body, Use("store", -amount, "all")))
    when = int(dice.integers(5))
    uses = [Use("store", -amount, "start" if when < 4 else "end")]
    if when < 2:
        uses.append(Use("store", amount, "end"))
    elif when == 3 and rule.predicate == "B":
        uses = [Use("store", amount, "start")]
    return replace(rule, body=(*rule.body, *uses))


def prioritised_mission(seed: int) -> Description:
    """The mission of a seed, in which one planner decides goals of one predicate before those of another."""
    found, dice = random_mission(seed), default_rng((seed, 4))
    length, order = int(dice.choice((2, 4, 7))), ("Halt", "Do") if dice.integers(2) else ("Do", "Halt")
    parts = []
    for part in found.parts:
        if part.name == "plan0":
            halt = Rule("task0", "Halt", (Bound("duration", length, length),))
            part = replace(part, rules=(*part.rules, halt), first=order)
        parts.append(part)
    wishes = []
    for wish in found.wishes:
        if wish.timeline == "task0" and dice.integers(2):
            wish = replace(wish, predicate="Halt", arguments=())
        wishes.append(wish)
    return replace(found, name=f"prioritised_{seed}", parts=tuple(parts), wishes=tuple(wishes))


def windowed_mission(seed: int) -> Description:
    """The mission of a seed, one of whose simulators lets things begin only while it has a gate open itself."""
    found, dice = random_mission(seed), default_rng((seed, 3))
    kind = Kind("gate", (("Shut", ()), ("Open", ())))
    shut, opened = int(dice.choice((3, 6, 11))), int(dice.choice((2, 5, 9)))
    relation: Relation = "contained_by" if dice.integers(2) else "starts_during"
    turns = [Rule("gate", "Shut", (Bound("duration", shut, shut), Child("meets", "gate", "Open", "o")))]
    if dice.integers(2):
        turns.append(Rule("gate", "Open", (Bound("duration", opened, opened), Child("meets", "gate", "Shut", "s"))))
    parts = []
    for part in found.parts:
        if part.name == "owner0":
            rules = _asking_also(part, "Act", Child(relation, "gate", "Open", "g"))
            internal = [part.internal[place] for place in dice.permutation(len(part.internal))]
            internal.insert(int(dice.integers(len(internal) + 1)), "gate")
            part = replace(part, lookahead=1, internal=tuple(internal), rules=(*rules, *turns))
        parts.append(part)
    return replace(found, name=f"windowed_{seed}", kinds=(*found.kinds, kind), parts=tuple(parts))


def _asking_also(part: Part, predicate: str, child: Child) -> list[Rule]:
    """The rules of a reactor, of which those of one predicate ask for one more thing."""
    return [replace(one, body=(*one.body, child)) if one.predicate == predicate else one for one in part.rules]


def random_mission(seed: int) -> Description:
    """The mission of a seed."""
    mission = Mission(default_rng(seed))
    for place in range(mission.one_of(1, 1, 2)):
        _source(mission, place)
    for place in range(mission.one_of(1, 1, 2)):
        _arm(mission, place)
    for place in range(mission.one_of(1, 1, 1, 2)):
        _planner(mission, place)
    if mission.happens(40):
        _top(mission)
    final = mission.one_of(30, 40, 60)
    parts = list(mission.parts)
    if mission.happens(50):
        parts = [parts[place] for place in mission.dice.permutation(len(parts))]
    return Description(
        f"second_{seed}", final, tuple(mission.kinds), tuple(parts), tuple(_wishes(mission, final)),
        tuple(one for one in mission.parameters if _samples(parts, one.name)), mission.happens(25),
    )  # fmt: skip


def _samples(parts: list[Part], name: str) -> bool:
    items = [item for part in parts for rule in part.rules for item in rule.body]
    return any(isinstance(item, Drawn) and item.parameter == name for item in items)


def _source(mission: Mission, place: int) -> None:
    """A simulator whose timeline goes round by itself."""
    name = f"src{place}"
    mission.kinds.append(Kind(name, (("A", ()), ("B", ("k",)))))
    mission.sources.append(name)
    length = mission.one_of(5, 7, 10, 12, 21)
    first: tuple[Item, ...] = (Bound("duration", length, length),)
    if mission.happens(25):
        parameter = f"SEA{place}"
        mission.parameters.append(Parameter(parameter, (3, 5, 8), mission.one_of(0, 10)))
        first = (Drawn("duration", parameter),)
    value = mission.below(3)
    follows = Child("meets", name, "B", "next", (Tie("k", "", value, value),))
    rules = [Rule(name, "A", (*first, follows))] if mission.happens(85) else []
    if rules and mission.happens(60):
        again = mission.one_of(4, 6, 9)
        rules.append(Rule(name, "B", (Bound("duration", again, again), Child("meets", name, "A", "next"))))
    mission.parts.append(Part(f"sim{place}", 0, 1, (name,), rules=tuple(rules)))


def _arm(mission: Mission, place: int) -> None:
    """A reactor that does what it is asked for."""
    name = f"arm{place}"
    mission.kinds.append(Kind(name, (("Rest", ()), ("Act", ("n",)))))
    mission.arms.append(name)
    length = mission.one_of(2, 3, 5, 5, 8)
    mission.lengths[name] = length
    body: tuple[Item, ...] = (Bound("duration", length, length),)
    if mission.happens(15):
        parameter = f"WORK{place}"
        mission.parameters.append(Parameter(parameter, (length, length + 2)))
        body = (Drawn("duration", parameter),)
    rules = [Rule(name, "Act", body)]
    internal = [name]
    if mission.happens(20):
        other = f"lamp{place}"
        mission.kinds.append(Kind(other, (("Off", ()), ("On", ("n",)))))
        internal.append(other)
        rules = [Rule(name, "Act", (*body, Child("equals", other, "On", "light", SAME)))]
    ranges = ((name, "Act", "n", 0, 5),) if mission.happens(8) else ()
    lookahead = mission.one_of(0, 1, 1, 1, 5, 20, 60, 60) if mission.happens(90) else 1
    latency = mission.one_of(0, 0, 0, 1, 3)
    mission.parts.append(
        Part(f"owner{place}", latency, lookahead, tuple(internal), rules=tuple(rules), ranges=ranges)
    )  # fmt: skip


def _asks(mission: Mission, place: int, label: str, timelines: list[str], predicate: str) -> list[Item]:
    """What a rule asks of one timeline."""
    timeline = timelines[mission.below(len(timelines))]
    length = mission.lengths[timeline]
    kind = mission.below(9)
    ties: tuple[Tie, ...] = SAME
    relation: Relation = "equals"
    if kind in (1, 2):
        relation = "contains"
        ties += (Tie("start", "start", kind := mission.below(4), kind),)
    elif kind == 3:
        relation = "starts"
    elif kind == 4:
        relation = "any"
        gap = mission.below(4)
        ties += (Tie("start", "end", gap, gap),)
    elif kind == 5:
        relation = "any"
        gap = mission.one_of(8, 10, 12)
        ties += (Tie("start", "start", -gap, -gap), Tie("start", "", 0, FAR))
    elif kind == 6:
        relation = "contains"
    if relation == "contains" and mission.happens(30):
        ties += (Tie("duration", "", length, length),)
    return [Child(relation, timeline, predicate, label, ties)]


def _planner(mission: Mission, place: int) -> None:
    """A planner that uses arms and looks at sources."""
    name, mood = f"task{place}", f"mood{place}"
    mission.kinds.append(Kind(name, (("Idle", ()), ("Do", ("n",)), ("Halt", ()))))
    mission.tasks.append(name)
    body = _asks(mission, place, "a", mission.arms, "Act")
    used = {one.timeline for one in body if isinstance(one, Child)}
    length = mission.one_of(0, 0, 5, 8, 12)
    if length:
        low = length if mission.happens(70) else 1
        body.append(Bound("duration", low, length))
    mission.lengths[name] = length or 5
    internal, watched, rules = [name], [], []
    if mission.happens(30):
        extra = _asks(mission, place, "b", mission.arms, "Act")
        child = extra[0]
        assert isinstance(child, Child)
        extra = [
            Child(child.relation, child.timeline, child.predicate, "b", (Tie("n", "n", 100, 100), *child.ties[1:]))
        ]
        used.add(child.timeline)
        if mission.happens(30):
            body.append(Guarded("n", mission.one_of(1, 2), tuple(extra)))
        elif mission.happens(30):
            body.append(Guarded("", 0, tuple(extra)))
        else:
            body += extra
            first = body[0]
            assert isinstance(first, Child)
            if mission.happens(40) or first.timeline == child.timeline:
                body.append(Between("a", "before", "b"))
    if mission.happens(70):
        source = mission.sources[mission.below(len(mission.sources))]
        watched.append(source)
        kind = mission.below(6)
        if kind in (0, 1):
            internal.append(mood)
            mission.kinds.append(Kind(mood, (("Low", ()), ("High", ()))))
            rules.append(Rule(source, "A", (Child("equals", mood, "Low", "l"),)))
            rules.append(Rule(source, "B", (Child("equals", mood, "High", "h"),)))
        elif kind == 2:
            limit = mission.one_of(5, 9, 11, 20)
            rules.append(Rule(source, "A", (Bound("duration", -FAR, limit),)))
        elif kind == 3:
            gap = mission.below(5)
            body += [
                Child("any", source, "B", "seen", (Tie("start", "", 0, FAR), Tie("start", "start", -FAR, -gap))),
            ]  # fmt: skip
        elif kind == 4:
            body.append(Child("any", source, "B", "seen", (Tie("start", "start", 0, mission.one_of(5, 10, 15)),)))
        else:
            rules.append(Rule(source, "B", (Child("equals", name, "Halt", "h"),)))
    rules.append(Rule(name, "Do", tuple(body)))
    lookahead = mission.one_of(10, 30, 60, 60)
    early = (name,) if mission.happens(8) else ()
    late = (name,) if not early and mission.happens(8) else ()
    mission.parts.append(
        Part(
            f"plan{place}", mission.one_of(0, 1, 1, 2), lookahead, tuple(internal), tuple(sorted(used)), tuple(watched),
            tuple(rules), early=early, late=late,
        )
    )  # fmt: skip


def _top(mission: Mission) -> None:
    """A planner above planners."""
    mission.kinds.append(Kind("job", (("Free", ()), ("Make", ("n",)), ("Stop", ()))))
    body = _asks(mission, 0, "d", mission.tasks, "Do")
    used = [one.timeline for one in body if isinstance(one, Child)]
    length = mission.one_of(0, 0, 5, 10)
    if length:
        body.append(Bound("duration", length if mission.happens(60) else 1, length))
    rules = [Rule("job", "Make", tuple(body))]
    watched: list[str] = []
    if mission.happens(30):
        watched = [mission.sources[0]]
        rules.append(Rule(mission.sources[0], "B", (Child("equals", "job", "Stop", "s"),)))
    mission.lengths["job"] = length or 5
    mission.parts.append(
        Part("top", mission.one_of(0, 1, 1), 60, ("job",), tuple(used), tuple(watched), tuple(rules))
    )  # fmt: skip


def _wishes(mission: Mission, final: int) -> list[Wish]:
    jobs = any(kind.timeline == "job" for kind in mission.kinds)
    found = []
    for place in range(mission.one_of(1, 2, 2, 3, 4)):
        timeline, predicate = mission.tasks[mission.below(len(mission.tasks))], "Do"
        if jobs and mission.happens(60):
            timeline, predicate = "job", "Make"
        elif mission.happens(10):
            timeline, predicate = mission.arms[mission.below(len(mission.arms))], "Act"
        low = 1 + mission.below(final + 3)
        start = (low, low + mission.one_of(0, 0, 0, 2, 6, 30))
        at = mission.one_of(0, 0, 0, max(0, low - 1), max(0, low - 6), mission.below(final))
        recall = mission.below(final) if mission.happens(12) else None
        if recall is not None and recall <= min(at, final - 1):
            recall = None
        found.append(
            Wish(timeline, predicate, (("n", place + 1),), start, None, min(at, final - 1), mission.happens(50), recall)
        )
    return found
