"""The cells of a study: each variant under each sampling, flown with common seeds; what each of them shows."""

import shutil
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from checker.batch.result import MissionResult
from checker.campaign import Campaign
from checker.mission import Mission
from checker.models import ModelSet
from checker.oracle import Verdict
from checker.statistics import Interval, exact_interval, mcnemar
from checker.study.reading import StudyFile, Variant
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from runtime.executive.distributions import DISTRIBUTIONS

_SURE = 0.05  # of McNemar's test, below which two samplings are told apart


@dataclass(frozen=True, slots=True)
class StudyCell:
    """A variant under one sampling: the missions flown, whether each failed, by seed.

    `apart` counts the missions whose seed was flown and does not fail in the variant that this one contains, `beyond`
    those of them that fail here; None where it contains none, or that one was not flown so far.
    """

    variant: Variant
    sampling: str
    planned: int
    failed: tuple[tuple[int, bool], ...]
    errors: int
    codes: tuple[tuple[str, int], ...]
    beyond: int | None = None
    apart: int | None = None

    @property
    def missions(self) -> int:
        """How many count."""
        return len(self.failed)

    @property
    def failures(self) -> int:
        """How many of these failed."""
        return sum(fails for _, fails in self.failed)

    @property
    def rate(self) -> float:
        """The share of failures."""
        return self.failures / self.missions if self.missions else 0.0

    @property
    def own_rate(self) -> float:
        """The share of failures by what this variant has beyond the one that it contains."""
        if self.beyond is None or self.apart is None:
            return self.rate
        return self.beyond / self.apart if self.apart else 0.0

    def interval(self, confidence: float) -> Interval:
        """The exact interval of the rate."""
        return exact_interval(self.failures, self.missions, confidence)

    def is_expected(self, corridor: float) -> bool | None:
        """Whether the own rate lies within the corridor around the expected one; None where nothing is expected."""
        wanted = self.variant.expected.get(self.sampling)
        return None if wanted is None or not self.missions else abs(self.own_rate - wanted) <= corridor + 1e-9


@dataclass(frozen=True, slots=True)
class StudyFinding:
    """Which samplings find a variant, the best first, and which of the others are surely worse than the best."""

    variant: Variant
    finds: tuple[StudyCell, ...]
    worse: tuple[StudyCell, ...]
    missed: tuple[StudyCell, ...]  # in which no mission failed


def lay_out(study: StudyFile, variant: Variant, folder: Path) -> Path:
    """Copy the models into `folder` with the variant's edits; the mission file of the copy."""
    copy = folder / variant.name
    if copy.exists():
        shutil.rmtree(copy)
    ignored = shutil.ignore_patterns(".*", "__pycache__", "nddlc-*")
    shutil.copytree(study.root, copy, ignore=ignored)
    for edit in variant.edits:
        file = copy / edit.file
        text = file.read_text(encoding="utf-8")
        file.write_text(text.replace(edit.old, edit.new), encoding="utf-8", newline="")
    return copy / study.mission


def _sampled_as(agent: AgentConfiguration, sampling: str) -> AgentConfiguration:
    """The agent with every parameter that chance has a part in drawn in one way, such as `normal intra`."""
    shape, _, mode = sampling.partition(" ")
    return replace(agent, parameters=tuple(_drawn(one, shape, mode) for one in agent.parameters))


def _drawn(parameter: ParameterConfiguration, shape: str, mode: str) -> ParameterConfiguration:
    distribution = DISTRIBUTIONS[parameter.distribution]
    if distribution.is_determined or not distribution.has_range:
        return parameter
    return replace(
        parameter, distribution=shape, mode="intra" if mode == "intra" else "inter", mean=None, deviation=None
    )


def campaign_of(study: StudyFile, variant: Variant, sampling: str, base: Campaign) -> Campaign:
    """The batch of a cell, from that of its mission file; the seeds are those of every other cell."""
    agent = _sampled_as(base.models.agent, sampling)
    check = replace(
        base.mission.check,
        seed=study.seed,
        missions=variant.missions,
        max_failure_rate=1.0,
        confidence=study.confidence,
        time_limit=study.time_limit,
    )
    mission: Mission = replace(base.mission, check=check)
    models: ModelSet = replace(base.models, agent=agent)
    return replace(base, mission=mission, models=models)


def cell_of(variant: Variant, sampling: str, planned: int, results: Sequence[MissionResult]) -> StudyCell:
    """What the results of a cell come to."""
    flown = [one for one in results if one.number > 0]
    counted = [one for one in flown if one.verdict is not Verdict.ERROR]
    codes: dict[str, int] = {}
    for one in counted:
        if one.verdict is Verdict.FAIL:
            codes[one.judgement.code] = codes.get(one.judgement.code, 0) + 1
    failed = tuple((one.seed, one.verdict is Verdict.FAIL) for one in counted)
    return StudyCell(variant, sampling, planned, failed, len(flown) - len(counted), tuple(sorted(codes.items())))


def with_beyond(cells: Sequence[StudyCell]) -> tuple[StudyCell, ...]:
    """The cells, with failures beyond those of the variants that they contain."""
    found = {(one.variant.name, one.sampling): one for one in cells}

    def counted(cell: StudyCell) -> StudyCell:
        inner = found.get((cell.variant.beyond, cell.sampling))
        if inner is None:
            return cell
        known = dict(inner.failed)
        apart = [fails for seed, fails in cell.failed if known.get(seed) is False]
        return replace(cell, beyond=sum(apart), apart=len(apart))

    return tuple(counted(cell) for cell in cells)


def findings_of(cells: Sequence[StudyCell]) -> Iterator[StudyFinding]:
    """For each variant the samplings that find it."""
    for variant in dict.fromkeys(one.variant.name for one in cells):
        own = [one for one in cells if one.variant.name == variant and one.missions]
        if own:
            finds = tuple(sorted((one for one in own if one.failures), key=lambda one: -one.rate))
            worse = tuple(one for one in own if finds and one is not finds[0] and _is_worse(one, finds[0]))
            yield StudyFinding(own[0].variant, finds, worse, tuple(one for one in own if not one.failures))


def _is_worse(cell: StudyCell, best: StudyCell) -> bool:
    """McNemar's test on the seeds that both have flown: the draws of one seed are shares of the same streams."""
    own, other = dict(cell.failed), dict(best.failed)
    common = own.keys() & other.keys()
    lost = sum(other[seed] and not own[seed] for seed in common)
    won = sum(own[seed] and not other[seed] for seed in common)
    return lost > won and mcnemar(won, lost) < _SURE
