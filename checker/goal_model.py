"""The goals of a mission file as NDDL: what a planner would be asked for, as a model that can be planned at once."""

from collections.abc import Iterator
from math import inf

from runtime.executive.configuration import AgentConfiguration, Bounds, GoalConfiguration, ReactorConfiguration, Value


def planners_of(agent: AgentConfiguration) -> list[ReactorConfiguration]:
    """The reactors that own a timeline of a goal, in the order of the file."""
    asked = {goal.timeline for goal in agent.goals}
    return [reactor for reactor in agent.reactors if asked.intersection(reactor.internal)]


def goal_model(agent: AgentConfiguration, reactor: ReactorConfiguration) -> str:
    """The reactor's model with the goals for its timelines; those that are not mandatory may be rejected."""
    lines = [f'#include "{reactor.model}"\n']
    own = [goal for goal in agent.goals if goal.timeline in reactor.internal]
    for number, goal in enumerate(own, 1):
        lines += _goal(f"goal{number}", goal, float(agent.final_tick))
    return "".join(lines)


def _goal(name: str, goal: GoalConfiguration, final: float) -> Iterator[str]:
    yield f"{'goal' if goal.mandatory else 'rejectable'}({goal.timeline}.{goal.predicate} {name});\n"
    first = float(goal.at) if goal.start is None else max(float(goal.at), goal.start[0])
    yield from _bounds(f"{name}.start", (first, inf if goal.start is None else goal.start[1]), is_whole=True)
    least, most = (-inf, inf) if goal.end is None else goal.end
    yield from _bounds(f"{name}.end", (least, min(most, final)), is_whole=True)
    if goal.duration is not None:
        yield from _bounds(f"{name}.duration", goal.duration, is_whole=True)
    for parameter, value in goal.parameters:
        if isinstance(value, tuple):
            yield from _bounds(f"{name}.{parameter}", value, is_whole=all(isinstance(each, int) for each in value))
        else:
            yield f"{name}.{parameter} == {_written(value)};\n"


def _bounds(variable: str, bounds: Bounds, *, is_whole: bool) -> Iterator[str]:
    for sign, bound in zip((">=", "<="), bounds, strict=True):
        if abs(bound) < inf:
            yield f"{variable} {sign} {int(bound) if is_whole else repr(float(bound))};\n"


def _written(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return value if isinstance(value, str) else repr(value)
