"""Contrast: a failed mission in, what sets it apart from the nearest mission that passes out.

Delta debugging (Zeller and Hildebrandt, 2002) over the parameters that are drawn once: the smallest set that makes the
passing mission fail. Then the two missions that differ in that set alone, tick by tick from where they part.
"""

from collections.abc import Callable, Container, Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations, groupby, takewhile

from checker.batch.result import MissionResult
from checker.buckets import bucket_key
from checker.conditions.space import Point, Space
from checker.oracle import Verdict
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.outcome import Event, EventKind

Trace = Callable[[AgentConfiguration, int, int], MissionResult]  # agent, number, seed; with the events kept
_MOST_RUNS = 31
_MOST_TRIED = 3  # missions that pass, the nearest first
_PAIRS = 6  # parameters of which all pairs are tried
_MOST_TICKS = 6  # that are shown


@dataclass(frozen=True, slots=True)
class Difference:
    """A parameter with its value in the failing mission and in the passing one."""

    parameter: str
    failing: float
    passing: float


@dataclass(frozen=True, slots=True)
class Parting:
    """One tick at which the two missions differ: what happened in one of them only."""

    tick: int
    failing: tuple[Event, ...]
    passing: tuple[Event, ...]


@dataclass(frozen=True, slots=True)
class Contrast:
    """Mission `passing` passes; with the `decisive` values of the failed one it fails as that does.

    `is_smallest`: no smaller set does; else only no part of this one. `partings` are the first ticks that differ, of
    `differing` in all.
    """

    passing: int
    decisive: tuple[Difference, ...]
    is_smallest: bool
    flights: int
    partings: tuple[Parting, ...]
    differing: int


def find_contrast(
    failed: MissionResult,
    results: Sequence[MissionResult],
    agent: AgentConfiguration,
    trace: Trace,
    suspects: Container[str] = (),
) -> Contrast | None:
    """The contrast of a failed mission; None where no mission passes, or what is redrawn decides.

    The values of `suspects` alone are tried before those of all parameters: most flights pass, and last to the end.
    """
    space = Space(agent, results, redrawn=False)
    row = space.row(failed)
    passing = [result for result in results if result.verdict is Verdict.PASS]
    if row is None or not passing or not space.parameters:
        return None
    failing_point = space.point(row)
    passing.sort(key=lambda one: (_distance(space, failing_point, one), one.number))
    for nearest in passing[:_MOST_TRIED]:
        nearest_row = space.row(nearest)
        assert nearest_row is not None
        search = SubsetSearch(space, failed, failing_point, space.point(nearest_row), trace)
        # What is redrawn comes from the failed mission: with that the values of the other need not pass.
        if search.failing == search.passing or search.passes(()):
            break
    else:
        return None
    differing = tuple(n for n, (a, b) in enumerate(zip(search.failing, search.passing, strict=True)) if a != b)
    likely = tuple(n for n in differing if space.names[n] in suspects)
    if not differing:
        return None
    begun = likely if likely and search.fails(likely) else differing
    if not search.fails(begun):
        return None
    decisive, is_smallest = search.smallest(begun, differing)
    chosen, other = search.flown[decisive], search.flown[()]
    assert chosen.outcome is not None and other.outcome is not None
    partings = _partings(chosen.outcome.events, other.outcome.events)
    names = space.names
    return Contrast(
        nearest.number,
        tuple(Difference(names[n], search.failing[n], search.passing[n]) for n in decisive),
        is_smallest,
        len(search.flown),
        partings[:_MOST_TICKS],
        len(partings),
    )


def nearest_passing(
    example: MissionResult, results: Sequence[MissionResult], agent: AgentConfiguration
) -> MissionResult | None:
    """The passing mission whose draws are nearest to those of a failing one, in units of the ranges."""
    wide = {one.name: max(one.upper - one.lower, 1e-9) for one in agent.parameters}

    def values(result: MissionResult) -> dict[str, float]:
        return {draw.parameter: draw.value for draw in (result.outcome.draws if result.outcome is not None else ())}

    own = values(example)

    def distance(result: MissionResult) -> float:
        drawn = values(result)
        return sum(((drawn[name] - own[name]) / wide.get(name, 1.0)) ** 2 for name in own.keys() & drawn.keys())

    passing = [result for result in results if result.verdict is Verdict.PASS]
    return min(passing, key=distance, default=None)


class SubsetSearch:
    """Flies the passing mission with some of the failing values."""

    def __init__(self, space: Space, failed: MissionResult, failing: Point, passing: Point, trace: Trace) -> None:
        self.space, self.failed, self.failing, self.passing, self.trace = space, failed, failing, passing, trace
        self.flown: dict[tuple[int, ...], MissionResult] = {}

    def passes(self, chosen: tuple[int, ...]) -> bool:
        """Whether it passes with the failing values of the parameters `chosen`."""
        return self._flown(chosen).verdict is Verdict.PASS

    def fails(self, chosen: tuple[int, ...]) -> bool:
        """Whether it fails as the failed mission does with the failing values of the parameters `chosen`."""
        result = self._flown(chosen)
        return result.verdict is Verdict.FAIL and bucket_key(result) == bucket_key(self.failed)

    def _flown(self, chosen: tuple[int, ...]) -> MissionResult:
        result = self.flown.get(chosen)
        if result is None:
            point = tuple(self.failing[n] if n in chosen else value for n, value in enumerate(self.passing))
            result = self.trace(self.space.agent_at(point), self.failed.number, self.failed.seed)
            self.flown[chosen] = result
        return result

    def smallest(self, chosen: tuple[int, ...], whole: tuple[int, ...]) -> tuple[tuple[int, ...], bool]:
        """A set of which no part fails, and whether none of the `whole` is smaller: singles and pairs are all tried."""
        for number in chosen:
            rest = tuple(one for one in chosen if one != number)
            if rest and self.fails(rest):
                chosen = rest
        for size in (1, 2):
            if len(chosen) <= size:
                return chosen, True
            if size == 2 and len(whole) > _PAIRS:
                break
            for candidate in combinations(whole, size):
                if len(self.flown) >= _MOST_RUNS:
                    return chosen, False
                if self.fails(candidate):
                    return candidate, True
        return chosen, len(chosen) <= 3 and len(whole) <= _PAIRS


def _distance(space: Space, point: Point, result: MissionResult) -> float:
    row = space.row(result)
    assert row is not None
    pairs = zip(space.parameters, point, space.point(row), strict=True)
    return sum(abs(a - b) / parameter.width for parameter, a, b in pairs)


def _partings(failing: Sequence[Event], passing: Sequence[Event]) -> tuple[Parting, ...]:
    """The ticks at which two traces differ, until the first one ends; draws, which differ by construction, left out."""
    end = failing[-1].tick if failing else 0
    one, other = _by_tick(failing), _by_tick(takewhile(lambda event: event.tick <= end, passing))
    found = []
    for tick in sorted({*one, *other}):
        here, there = one.get(tick, {}), other.get(tick, {})
        only_here = tuple(event for key, event in here.items() if key not in there)
        only_there = tuple(event for key, event in there.items() if key not in here)
        if only_here or only_there:
            found.append(Parting(tick, only_here, only_there))
    return tuple(found)


def _by_tick(events: Iterable[Event]) -> dict[int, dict[object, Event]]:
    """What happened at each tick, by what can be compared: numbers of events, tokens and requests may differ."""
    kept = [event for event in events if event.kind is not EventKind.SAMPLE]
    grouped = groupby(kept, key=lambda event: event.tick)
    return {tick: {_comparable(event): event for event in group} for tick, group in grouped}


def _comparable(event: Event) -> object:
    reason = event.reason.kind if event.reason is not None else None
    said = (event.reactor, event.timeline, event.predicate, event.arguments)
    return (event.kind, *said, event.stage, event.code, reason)
