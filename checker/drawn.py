"""Which missions are drawn, and their paths: findings in, flights where events were not kept, tracks out."""

from collections.abc import Sequence
from dataclasses import dataclass

from checker.batch.process import Flyer
from checker.batch.result import MissionResult
from checker.conditions.space import fixed
from checker.figures import Figures
from checker.findings import Findings
from checker.oracle import Verdict
from checker.report.paths import DrawnPath
from checker.report.timelines import Pair
from checker.report.track import Track, track_of
from checker.sampling.sampler import with_point
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.distributions import DISTRIBUTIONS

_MOST_FAULTS = 6
_MOST_PASSING = 4


@dataclass(frozen=True, eq=False, slots=True)
class Drawn:
    """Paths on one map, and those missions that are drawn by themselves, with captions."""

    paths: tuple[DrawnPath, ...]
    closer: tuple[tuple[str, Track], ...]
    cell: float


def drawn_paths(
    figures: Figures, agent: AgentConfiguration, findings: Findings, pairs: Sequence[Pair | None], flyer: Flyer
) -> Drawn | None:
    """The standard path (each parameter in the middle of its range), one of each fault, and some that pass."""
    by_number = {result.number: result for result in findings.results}
    failing: list[tuple[DrawnPath, MissionResult]] = []
    for index, fault in enumerate(findings.faults[:_MOST_FAULTS]):
        result = by_number[fault.bucket.example]
        track = _track(result, figures)
        if track is not None:
            caption = f"mission {result.number} fails ({result.judgement.code})"
            failing.append((DrawnPath(track, caption, f"f{index % 6}"), result))
    passing: list[tuple[DrawnPath, MissionResult]] = []
    for result in _passing(findings, pairs):
        if not result.has_trace:
            near = with_point(agent, result.point)
            result = flyer.fly(near, result.number, result.seed, keeps_trace=True)
        track = _track(result, figures)
        if track is not None:
            passing.append((DrawnPath(track, f"mission {result.number} passes", "passed"), result))
    standard = _track(flyer.fly(_middle(agent), 0, findings.seed, keeps_trace=True), figures)
    paths = [one for one, _ in (*passing, *failing)]
    if standard is not None:
        paths.append(DrawnPath(standard, "every parameter in the middle of its range", "standard"))
    if not paths:
        return None
    richest = max(passing, key=lambda one: (len(one[0].track.samples), len(one[0].track.phases)), default=None)
    closer = [(one.caption, one.track) for one, _ in failing[:1]]
    closer += [(richest[0].caption, richest[0].track)] if richest is not None else []
    return Drawn(tuple(paths), tuple(closer), figures.cell)


def _passing(findings: Findings, pairs: Sequence[Pair | None]) -> list[MissionResult]:
    """Passing missions: those that are set against failing ones, then the first."""
    beside = [pair.passing for pair in pairs if pair is not None]
    known = {result.number for result in beside}
    first = [result for result in findings.results if result.verdict is Verdict.PASS and result.number not in known]
    return [*{result.number: result for result in beside}.values(), *first][:_MOST_PASSING]


def _track(result: MissionResult, figures: Figures) -> Track | None:
    return track_of(result.outcome, figures) if result.outcome is not None and result.has_trace else None


def _middle(agent: AgentConfiguration) -> AgentConfiguration:
    """The agent with all that is drawn from a range in the middle of it."""
    drawn = [one for one in agent.parameters if not DISTRIBUTIONS[one.distribution].is_determined]
    middle = {one.name: (one.lower + one.upper) / 2.0 for one in drawn if DISTRIBUTIONS[one.distribution].has_range}
    whole = {one.name for one in drawn if one.is_whole}
    return fixed(agent, {name: float(round(value)) if name in whole else value for name, value in middle.items()})
