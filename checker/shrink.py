"""Shrinking: a failed mission in, the simplest one that fails alike out.

Fewest off-nominal parameters (the middle of a range is nominal), then the simplest values for these, the fewest goals,
the shortest mission. Every step is a flight, and is kept only if the culprit is the same.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from checker.batch.result import MissionResult
from checker.buckets import bucket_key
from checker.conditions.space import Point, Space
from checker.contrast import SubsetSearch, Trace
from checker.oracle import PROPERTY, Verdict
from runtime.executive.configuration import AgentConfiguration, PropertyKind

_MOST_DIGITS = 4  # behind the point


@dataclass(frozen=True, slots=True)
class Shrunk:
    """The simplest mission found: `result` is that of `agent`, whose free parameters are fixed to `values`.

    `off` are those that are not nominal; `redrawn` stay as they are drawn from the seed. `goals` are numbers of the
    mission's goals, from 0.
    """

    result: MissionResult
    agent: AgentConfiguration
    values: tuple[tuple[str, float], ...]
    off: tuple[str, ...]
    redrawn: tuple[str, ...]
    goals: tuple[int, ...]
    final_tick: int
    flights: int


class _Shrinker:
    """Flies candidates and keeps the last that failed alike."""

    def __init__(self, failed: MissionResult, agent: AgentConfiguration, trace: Trace) -> None:
        self.failed, self.agent, self.trace = failed, agent, trace
        self.result = failed
        self.flights = 0

    def fails(self, agent: AgentConfiguration) -> bool:
        """Whether a mission fails alike; then it is the best so far."""
        self.flights += 1
        result = self.trace(agent, self.failed.number, self.failed.seed)
        if result.verdict is not Verdict.FAIL or bucket_key(result) != bucket_key(self.failed):
            return False
        self.agent, self.result = agent, result
        return True


def shrink(
    failed: MissionResult, results: Sequence[MissionResult], agent: AgentConfiguration, trace: Trace
) -> Shrunk | None:
    """The simplest mission that fails as `failed` does; None where it does not fail again when flown."""
    shrinker = _Shrinker(failed, agent, trace)
    if not shrinker.fails(agent):
        return None
    space = _space(shrinker, results)
    row = space.row(failed)
    assert row is not None
    point = space.point(row)
    off: tuple[int, ...] = ()
    if space.parameters:
        point, off = _nominal(shrinker, space, failed, point)
        point = _simplest(shrinker, space, point, off)
    if _lacks_what_was_promised(failed, agent):  # without goals nothing would come about
        goals = tuple(range(len(agent.goals)))
    else:
        goals = _fewest_goals(shrinker)
        _shortest(shrinker)
    free = {one.name for one in Space(agent, results).parameters}
    return Shrunk(
        shrinker.result,
        shrinker.agent,
        tuple(zip(space.names, point, strict=True)),
        tuple(space.names[number] for number in off),
        tuple(sorted(free - set(space.names))),
        goals,
        shrinker.agent.final_tick,
        shrinker.flights,
    )


def _lacks_what_was_promised(failed: MissionResult, agent: AgentConfiguration) -> bool:
    """Whether a mission fails since something did not come about that a property promises."""
    broken = {one.name for one in failed.outcome.properties if not one.is_kept} if failed.outcome else set()
    kinds = {one.kind for one in agent.properties if one.name in broken}
    return failed.judgement.code == PROPERTY and not kinds.isdisjoint((PropertyKind.REACHED, PropertyKind.UNTIL))


def _space(shrinker: _Shrinker, results: Sequence[MissionResult]) -> Space:
    """All free parameters, if the mission fails alike with each fixed to one of its draws; else those drawn once."""
    whole = Space(shrinker.agent, results)
    row = whole.row(shrinker.failed)
    assert row is not None
    if whole.has_redrawn and not shrinker.fails(whole.agent_at(whole.point(row))):
        return Space(shrinker.agent, results, redrawn=False)
    return whole


def _nominal(shrinker: _Shrinker, space: Space, failed: MissionResult, point: Point) -> tuple[Point, tuple[int, ...]]:
    """The fewest parameters that must keep their values, the others at the middle of their ranges."""
    middle = tuple(parameter.at(0.5) for parameter in space.parameters)
    search = SubsetSearch(space, failed, point, middle, shrinker.trace)
    if search.fails(()):
        chosen: tuple[int, ...] = ()
    else:
        apart = tuple(n for n, (a, b) in enumerate(zip(point, middle, strict=True)) if a != b)
        chosen, _ = search.smallest(apart, apart)
    mixed = tuple(point[number] if number in chosen else value for number, value in enumerate(middle))
    shrinker.flights += len(search.flown)
    return (mixed, chosen) if shrinker.fails(space.agent_at(mixed)) else (point, tuple(range(len(point))))


def _simplest(shrinker: _Shrinker, space: Space, point: Point, off: Sequence[int]) -> Point:
    """Each value that matters, with as few digits as will do."""
    for number in off:
        if space.parameters[number].choices is None:
            lower, upper = space.parameters[number].lower, space.parameters[number].upper
            for value in (one for one in _rounded(point[number]) if lower <= one <= upper):
                candidate = (*point[:number], value, *point[number + 1 :])
                if shrinker.fails(space.agent_at(candidate)):
                    point = candidate
                    break
    return point


def _rounded(value: float) -> Iterator[float]:
    """A value with ever more digits, each time the next number above and below it."""
    for digits in range(_MOST_DIGITS + 1):
        scale = 10.0**digits
        for simple in sorted({math.floor(value * scale), math.ceil(value * scale)}, key=abs, reverse=True):
            yield simple / scale


def _fewest_goals(shrinker: _Shrinker) -> tuple[int, ...]:
    """Leave out goals from the last to the first."""
    kept = list(range(len(shrinker.agent.goals)))
    goals = shrinker.agent.goals
    for number in reversed(range(len(goals))):
        rest = [one for one in kept if one != number]
        if shrinker.fails(replace(shrinker.agent, goals=tuple(goals[one] for one in rest))):
            kept = rest
    return tuple(kept)


def _shortest(shrinker: _Shrinker) -> None:
    """End soon after the abort; a mission that goes to its end fails for what it left open, so it stays as long."""
    outcome = shrinker.result.outcome
    if outcome is None or outcome.abort is None:
        return
    whole, last = outcome.final_tick, outcome.last_tick
    for share in (0.0, 0.25, 0.5):
        final = last + 1 + int(share * (whole - last))
        if final < whole and shrinker.fails(replace(shrinker.agent, final_tick=final)):
            return
