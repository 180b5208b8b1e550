"""Draw an agent from a seed: what its reactors own, what they ask of each other, what goes wrong, what is asked."""

import random
from dataclasses import dataclass, field, replace
from typing import Literal

from tests.executive.generated.agents import Coded, Goal, RandomAgent, Reactor
from tests.executive.generated.deepening import deepened
from tests.executive.generated.ranking import ranked
from tests.executive.generated.timelines import Child, Line

RELATIONS: tuple[Literal["contains", "meets", "met_by", "follows"], ...] = (
    "contains",
    "contains",
    "contains",
    "meets",
    "met_by",
    "follows",
)


@dataclass(slots=True)
class Writer:
    """Writes one agent."""

    chance: random.Random
    count: int = 0
    may_fail: bool = True
    reactors: list[Reactor] = field(default_factory=list)
    more: random.Random | None = None  # draws guards, ties and clocks

    def name(self, start: str) -> str:
        """A new name."""
        self.count += 1
        return f"{start}{self.count}"

    def happens(self, share: float) -> bool:
        """Whether something of this probability does."""
        return self.chance.random() < share

    def simulator(self) -> Reactor:
        """A reactor that looks one tick ahead: commands, and what happens by itself."""
        chance = self.chance
        one = Reactor(self.name("sim"), chance.choice((0, 0, 0, 1, 3)), 1)
        for _ in range(chance.randint(1, 2)):
            late = chance.choice((0, 0, 0, 4, 12))
            most = chance.choice((None, None, None, 2))
            one.lines.append(Line(self.name("arm"), "command", extra=chance.randint(0, 5), rest=late, most=most))
        if self.happens(0.6):
            steps = tuple(chance.randint(1, 14) for _ in range(chance.randint(2, 4)))
            breaks = self.may_fail and self.happens(0.25)
            one.lines.append(Line(self.name("src"), "script", steps, breaks))
        if self.happens(0.3):
            one.lines.append(Line(self.name("count"), "counter", (chance.randint(1, 9),)))
        if self.happens(0.08):
            one.lookahead = 0
        chance.shuffle(one.lines)
        return one

    def planner(self) -> Reactor:
        """A reactor that plans tasks over the timelines there are."""
        chance = self.chance
        one = Reactor(self.name("plan"), chance.choice((0, 1, 1, 2, 5)), chance.choice((2, 5, 20, 60, 200)))
        world = [line for other in self.reactors for line in other.lines]
        able = [line for line in world if line.kind in ("command", "task")]
        scripts = [line for line in world if line.kind == "script"]
        seen = [line for line in world if line.kind in ("script", "counter")]
        for _ in range(chance.randint(1, 2)):
            children = tuple(self.child(able) for _ in range(chance.choice((0, 1, 1, 1, 2))))
            least = chance.randint(1, 8)
            most = chance.choice((None, least, least + 6, least + 15, least + 15))
            if most is None and not children:
                most = least + 10
            within = chance.choice(scripts) if scripts and self.happens(0.15) else None
            children, ties = widened(self.more, children, able) if self.more is not None else (children, "")
            one.lines.append(
                Line(self.name("task"), "task", lasts=(least, most), children=children, ties=ties, within=within)
            )
        if seen and self.happens(0.5):
            one.lines.append(Line(self.name("lamp"), "mirror", copied=chance.choice(seen)))
        if self.may_fail and self.happens(0.06):
            one.max_steps = chance.choice((1, 3, 8))
        one.forbids_failed = self.happens(0.3)
        return one

    def child(self, able: list[Line]) -> Child:
        """What a task asks of another timeline."""
        chance = self.chance
        line, relation = chance.choice(able), chance.choice(RELATIONS)
        also = ""
        if relation == "contains":
            also = chance.choice(("", "", "{0}.start == start + 2;", "{0}.end == end;", "{0}.start <= start + 4;"))
        before = Child(line, "contains", 0) if relation == "contains" and self.happens(0.2) else None
        return Child(line, relation, chance.choice((0, 0, 1)), also, before)

    def goal(self, lines: list[Line], final_tick: int) -> Goal:
        """Something that is asked for at some tick."""
        chance = self.chance
        line = chance.choice(lines)
        at = chance.choice((0, 0, chance.randint(0, final_tick - 12)))
        first = at + chance.randint(0 if self.happens(0.2) else 1, 25)
        first = min(first, final_tick - 2)
        last = min(first + chance.choice((0, 0, 4, 15, 60)), final_tick)
        if last <= at:
            last = at + 1
        duration = None
        if self.happens(0.15):
            shortest = chance.randint(1, 8)
            duration = (shortest, shortest + chance.randint(0, 6))
        recall = at + chance.randint(1, 25) if self.happens(0.2) else None
        if recall is not None and recall >= final_tick:
            recall = None
        n = None if self.happens(0.06) else chance.randint(1, 4)
        return Goal(line, at, (first, last), n, self.happens(0.35), duration, recall)


def widened(more: random.Random, children: tuple[Child, ...], able: list[Line]) -> tuple[tuple[Child, ...], str]:
    """Children some of which are asked for under guards, and two that begin with their parent and end as it says."""
    found = [
        replace(
            child,
            least=more.choice((None, None, 2, 3)) if child.before is None else None,
            waits=child.relation in ("follows", "meets") and more.random() < 0.3,
        )
        for child in children
    ]
    if len(able) < 2 or more.random() < 0.5:
        return tuple(found), ""
    first = len(found)
    found += [Child(line, "beside", more.choice((0, 1))) for line in more.sample(able, 2)]
    other = more.choice((0, 0, 2, 6))
    relation = more.choice(("c{0}.end <= c{1}.end + {2};", "c{0}.end + {2} >= c{1}.end;", "c{0}.end == c{1}.end;"))
    return tuple(found), relation.format(first, first + 1, other)


MANAGERS = ("ResourceThreatManager", "ThreatManager", "OpenConditionManager", "UnboundVariableManager")
SOLVER = "\n".join(f'[[manager]]\ncomponent = "{name}"\n' for name in MANAGERS)


def enriched(rich: random.Random, agent: RandomAgent) -> RandomAgent:
    """An agent with draws, stores, numbers with fractions, and timelines that are early or late."""
    changed: dict[str, Line] = {}

    def renewed(line: Line) -> Line:
        """A timeline with what it speaks of."""
        if line.name in changed:
            return changed[line.name]
        found = replace(
            line,
            children=tuple(child_of(child) for child in line.children),
            within=None if line.within is None else renewed(line.within),
            copied=None if line.copied is None else renewed(line.copied),
        )
        if line.kind == "command" and rich.random() < 0.5:
            found = replace(found, drawn=rich.randint(1, 5), period=rich.choice((0, 1, 3, 10)))
        if line.kind == "task" and rich.random() < 0.5:
            found = replace(found, uses=rich.randint(1, 3), returns=rich.random() < 0.7)
        if line.kind in ("command", "task") and rich.random() < 0.4:
            found = replace(found, factor=rich.choice((0.5, 1.0, 3.3)))
        if line.kind == "task" and rich.random() < 0.1:
            found = replace(found, planned=(rich.randint(3, 30), rich.randint(1, 4)))
        if line.kind == "counter" and rich.random() < 0.5:
            found = replace(found, step=rich.choice((0.1, 0.25, 1.7)))
        changed[line.name] = found
        return found

    def child_of(child: Child) -> Child:
        before = None if child.before is None else child_of(child.before)
        return replace(child, line=renewed(child.line), before=before)

    for one in agent.reactors:
        one.lines = [renewed(line) for line in one.lines]
        for line in one.lines:
            if line.kind in ("command", "task") and rich.random() < 0.25:
                rich.choice((one.early, one.late)).append(line)
        if any(line.uses for line in one.lines) and rich.random() < 0.5:
            one.solver = SOLVER
    agent.goals = [replace(goal, line=renewed(goal.line)) for goal in agent.goals]
    for number, goal in enumerate(agent.goals):
        if goal.line.factor and rich.random() < 0.8:
            low = rich.choice((0.0, 0.3, 7.5))
            agent.goals[number] = replace(goal, x=(low, low + rich.choice((0.0, 0.0, 1.5))))
    if rich.random() < 0.5:
        add_hand(rich, agent)
    return agent


def add_hand(rich: random.Random, agent: RandomAgent) -> None:
    """Add a reactor in Python, which asks and takes back at run time, and lamps that show what it says."""
    planners = [one for one in agent.reactors if one.lookahead > 1]
    is_shown = rich.random() < 0.5  # then nothing that it uses may be its user's
    takers = [one for one in agent.reactors if one.lookahead == 1 or (one in planners and not is_shown)]
    lines = [line for one in takers for line in one.lines if line.kind in ("command", "task")]
    if not lines:
        return
    scripts = [line for one in agent.reactors for line in one.lines if line.kind == "script"]
    last = agent.final_tick
    horn = Line("horn", "horn")
    says = {rich.randint(1, last - 1): rich.randint(0, 3) for _ in range(rich.randint(0, 4))}
    asks = []
    for _ in range(rich.randint(0, 3)):
        at = rich.randint(0, last - 8)
        first = at + rich.randint(1, 12)
        recall = at + rich.choice((0, 0, rich.randint(1, 15)))
        asks.append((at, rich.choice(lines), rich.randint(1, 4), (first, first + rich.choice((0, 5, 30))), recall))
    answers = tuple((rich.choice(scripts), rich.choice(lines), rich.randint(1, 3)) for _ in range(bool(scripts)))
    hand = Coded("hand", 0, 0, [horn], says=((0, 0), *sorted(says.items())), asks=tuple(asks), answers=answers)
    if is_shown and not any(line.kind == "mirror" for line in planners[0].lines):
        planners[0].lines.append(Line("lamp0", "mirror", copied=horn))
    agent.reactors.insert(rich.randint(0, len(agent.reactors)), hand)


def random_agent(
    seed: int, plain: bool = False, wide: bool = False, rich: bool = False, deep: bool = False, ranks: bool = False
) -> RandomAgent:
    """The agent of a seed.

    A plain one can be written as an agent file of T-REX too, a wide one has guards and ties, a rich one is `enriched`,
    a deep one is a chain of reactors with objects and enumerations (`deepened`), one with ranks has priorities, shared
    stores and more simulators (`ranked`).
    """
    chance = random.Random(f"agent {seed}")
    writer = Writer(chance, more=random.Random(f"wide {seed}") if wide else None)
    writer.reactors += [writer.simulator() for _ in range(chance.choice((1, 1, 2)) + ranks)]
    writer.reactors += [writer.planner() for _ in range(chance.choice((1, 1, 2, 2)) + wide)]
    final_tick = chance.choice((40, 60, 90))
    takers = [one for one in writer.reactors if one.lookahead > 0]
    tops = [line for one in takers for line in one.lines if line.kind == "task"]
    arms = [line for one in takers for line in one.lines if line.kind == "command"]
    goals = [writer.goal(tops * 3 + arms, final_tick) for _ in range(chance.randint(1, 5))]
    on_failure = "abort_agent" if plain else chance.choice(("abort_agent", "kill_reactor", "kill_reactor"))
    if plain:
        goals = [Goal(g.line, g.at, g.start, g.n, g.is_mandatory, g.duration) for g in goals]
    chance.shuffle(writer.reactors)
    agent = RandomAgent(f"random{seed}", final_tick, on_failure, writer.reactors, goals)
    agent = enriched(random.Random(f"rich {seed}"), agent) if rich else agent
    agent = deepened(random.Random(f"deep {seed}"), agent) if deep else agent
    return ranked(random.Random(f"ranked {seed}"), agent) if ranks else agent
