"""Deepen a random agent: chains of planners, objects and enumerations as arguments, what is seen, few steps a tick."""

import random
from dataclasses import replace

from tests.executive.generated.agents import Coded, RandomAgent, Reactor
from tests.executive.generated.timelines import Child, Line

PACES = ("", "Pace.slow", "Pace.fast")


def deepened(deep: random.Random, agent: RandomAgent) -> RandomAgent:
    """An agent with planners above its planners, whose timelines have more arguments."""
    changed: dict[str, Line] = {}

    def renewed(line: Line) -> Line:
        """A timeline with its other arguments."""
        if line.name in changed:
            return changed[line.name]
        found = replace(
            line,
            children=tuple(child_of(child) for child in line.children),
            within=None if line.within is None else renewed(line.within),
            copied=None if line.copied is None else renewed(line.copied),
        )
        if line.kind in ("command", "task") and deep.random() < 0.4:
            found = replace(found, paced=True)
        if line.kind == "command" and deep.random() < 0.4:
            found = replace(found, placed=True)
        moods = random.Random(f"{agent.name} {line.name}")
        if found.drawn and found.period and moods.random() < 0.4:
            found = replace(found, latest=moods.randint(0, found.drawn - 1))
        changed[line.name] = found
        return found

    def child_of(child: Child) -> Child:
        before = None if child.before is None else child_of(child.before)
        return replace(child, line=renewed(child.line), before=before, pace=deep.choice(PACES))

    for one in agent.reactors:
        one.lines = [renewed(line) for line in one.lines]
        one.early = [renewed(line) for line in one.early]
        one.late = [renewed(line) for line in one.late]
        if isinstance(one, Coded):
            one.asks = tuple((at, renewed(line), n, start, recall) for at, line, n, start, recall in one.asks)
            one.answers = tuple((renewed(seen), renewed(line), n) for seen, line, n in one.answers)
            if deep.random() < 0.15:
                one.raises = deep.randint(0, agent.final_tick)
    agent.goals = [replace(goal, line=renewed(goal.line)) for goal in agent.goals]
    for _ in range(deep.choice((1, 1, 2))):
        add_planner(deep, agent)
    tops = [line for line in agent.reactors[-1].lines if line.kind == "task"]
    for number, goal in enumerate(agent.goals):
        line = deep.choice(tops) if deep.random() < 0.6 else goal.line
        pace = deep.choice(("", "slow", "fast")) if line.paced else ""
        spot = deep.choice(("", "near", "remote")) if line.placed else ""
        agent.goals[number] = replace(goal, line=line, pace=pace, spot=spot, x=goal.x if line.factor else None)
    if deep.random() < 0.4:
        agent.steps = deep.choice((1, 2, 5, 40))
    deep.shuffle(agent.reactors)
    return agent


def add_planner(deep: random.Random, agent: RandomAgent) -> None:
    """Add a planner whose task asks for the task of the planner that was added last."""
    number = len(agent.reactors)
    takers = [one for one in agent.reactors if one.lookahead > 0]
    tasks = [line for one in takers for line in one.lines if line.kind == "task"]
    arms = [line for one in takers for line in one.lines if line.kind == "command"]
    seen = [line for one in agent.reactors for line in one.lines if line.kind == "counter"]
    one = Reactor(f"top{number}", deep.choice((0, 0, 1, 2)), deep.choice((5, 20, 60, 200)))
    children = [Child(tasks[-1], deep.choice(("contains", "contains", "meets", "follows")), deep.choice((0, 0, 1)))]
    if arms and deep.random() < 0.5:
        children.append(Child(deep.choice(arms), deep.choice(("contains", "met_by", "meets"))))
    if seen and deep.random() < 0.4:
        children[-1] = replace(children[-1], above=(deep.choice(seen), deep.randint(1, 3)))
    paced = deep.random() < 0.4
    children = [replace(child, pace=deep.choice((*PACES, "pace") if paced else PACES)) for child in children]
    least = deep.randint(1, 6)
    placed = [line for line in arms if line.placed]
    visits = deep.choice(placed) if placed and deep.random() < 0.4 else None
    most = deep.choice((None, least + 15, least + 40))
    name = f"goal{number}"
    one.lines.append(Line(name, "task", lasts=(least, most), children=tuple(children), visits=visits, paced=paced))
    agent.reactors.append(one)
