"""Rank what a random agent decides: priorities in solvers' tables, and tasks of one planner that share its store."""

import random
from collections.abc import Callable
from dataclasses import replace

from tests.executive.generated.agents import Coded, RandomAgent, Reactor
from tests.executive.generated.timelines import Child, Line

SHARED = 3  # of a store of 5: two tasks at once have no room


def ranked(chance: random.Random, agent: RandomAgent) -> RandomAgent:
    """An agent whose reactors decide some predicates before others, and two of whose tasks share a store."""
    sharing = {
        line.name
        for one in agent.reactors
        for line in one.lines
        if sum(each.kind == "task" for each in one.lines) > 1 and line.kind == "task" and chance.random() < 0.7
    }
    rewrite(agent, lambda line: replace(line, uses=SHARED, returns=True) if line.name in sharing else line)
    for one in agent.reactors:
        if not isinstance(one, Coded):
            one.solver = table(chance, one)
    return agent


def table(chance: random.Random, one: Reactor) -> str:
    """The solver's table of a reactor; empty if it has none."""
    lines = [line for line in (*one.lines, *one.external()) if line.kind in ("command", "task")]
    is_sharing = any(line.uses for line in one.lines)
    if not lines or (not is_sharing and chance.random() < 0.3):
        return one.solver
    text = ['[[manager]]\ncomponent = "ResourceThreatManager"\n'] if is_sharing else []
    text += ['[[manager]]\ncomponent = "ThreatManager"\n', '[[manager]]\ncomponent = "OpenConditionManager"\n']
    for line in lines:
        if chance.random() < 0.7:
            text.append(
                '[[manager.handler]]\ncomponent = "StandardOpenConditionHandler"\n'
                f'predicate = "{line.class_name}.Do"\npriority = {chance.randint(1, 3)}\n'
            )
    return "\n".join([*text, '[[manager]]\ncomponent = "UnboundVariableManager"\n'])


def rewrite(agent: RandomAgent, change: Callable[[Line], Line]) -> None:
    """Change timelines wherever an agent speaks of them."""
    changed: dict[str, Line] = {}

    def renewed(line: Line) -> Line:
        if line.name not in changed:
            found = replace(
                line,
                children=tuple(child_of(child) for child in line.children),
                within=None if line.within is None else renewed(line.within),
                copied=None if line.copied is None else renewed(line.copied),
                visits=None if line.visits is None else renewed(line.visits),
            )
            changed[line.name] = change(found)
        return changed[line.name]

    def child_of(child: Child) -> Child:
        before = None if child.before is None else child_of(child.before)
        above = None if child.above is None else (renewed(child.above[0]), child.above[1])
        return replace(child, line=renewed(child.line), before=before, above=above)

    for one in agent.reactors:
        for lines in (one.lines, one.early, one.late):
            lines[:] = [renewed(line) for line in lines]
        if isinstance(one, Coded):
            one.asks = tuple((at, renewed(line), *rest) for at, line, *rest in one.asks)  # type: ignore[misc]
            one.answers = tuple((renewed(seen), renewed(line), n) for seen, line, n in one.answers)
    agent.goals = [replace(goal, line=renewed(goal.line)) for goal in agent.goals]
