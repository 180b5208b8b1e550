"""A mission in, one line out for each small fault that was made in its models: does it fail, and is the line found?

It measures two things: the checks of the mission (faults that stay silent), and explanations (the rank of the changed
line among the causes that a user would be shown).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import partial
from pathlib import Path

from checker.batch.process import Flyer
from checker.batch.result import MissionResult
from checker.buckets import group_failures
from checker.counterfactual.effort import Bounds
from checker.counterfactual.ranking import NO_CAUSES, Causes, RankedLine
from checker.counterfactual.search import CauseSearch, Suspended, sites_in
from checker.faults import faults_of
from checker.mission import Mission
from checker.models import ModelSet, load_models
from checker.mutation.choice import Mutant, mutants_of
from checker.mutation.edits import SmallEdit
from checker.mutation.kinds import DROPPED
from checker.mutation.variant import Overlay, load_over, open_over, with_edit
from checker.oracle import USER_CODE, Verdict, judge_losses
from checker.pinned import pinned
from checker.sampling.seeds import mission_seed
from nddl_lang.text.read import real_path
from runtime.user.fault import UserCodeError

TOP = 3
_MOST_SECONDS = 60.0  # for one flight, by the clock
_LEAST_SECONDS, _SLOW = 10.0, 15.0  # of the processor, and so many times as long as the slowest mission without a fault


class Fate(StrEnum):
    """What became of a mutant."""

    SILENT = "silent"  # all missions pass
    FAILS = "fails"
    ERROR = "error"  # a mission could not be flown, or engine and judge disagree


@dataclass(frozen=True, slots=True)
class MutantReport:
    """One mutant: `rank` is that of the changed line among the causes, `rule_rank` that of a line of its rule.

    Both count from 1, and are 0 where there is none. Its failures are `faults` faults to a user, who should see one.
    """

    edit: SmallEdit
    rule: str
    fate: Fate
    failed: int
    flown: int
    code: str = ""
    message: str = ""
    rank: int = 0
    rule_rank: int = 0
    faults: int = 0
    causes: Causes = NO_CAUSES

    @property
    def is_drop(self) -> bool:
        """Whether nothing is left where the fault is, so that its rule is what can be named."""
        return self.edit.kind in DROPPED

    @property
    def place(self) -> int:
        """The rank that counts: of a dropped line that of its rule."""
        return self.rule_rank if self.is_drop else self.rank


@dataclass(frozen=True, eq=False, slots=True)
class Ground:
    """What mutants of a mission are measured on: its passing missions, each with its number and seed.

    No flight of a mutant takes longer than `most_seconds` of the processor: a fault may leave a search without an end.
    """

    mission: Mission
    models: ModelSet
    seeds: tuple[tuple[int, int], ...]
    most_seconds: float


def with_mandatory_goals(mission: Mission) -> Mission:
    """The mission with every goal a mandatory one."""
    goals = tuple(replace(goal, mandatory=True) for goal in mission.agent.goals)
    return replace(mission, agent=replace(mission.agent, goals=goals))


def open_flyer(mission: Mission, models: ModelSet) -> Flyer:
    """A process for mutants and trials, in which no flight takes long."""
    return Flyer(pinned(models), models.agent, min(mission.check.time_limit, _MOST_SECONDS))


def prepare(mission: Mission, models: ModelSet, missions: int, flyer: Flyer) -> Ground:
    """Fly the unchanged mission: where it fails by itself, a mutant would show nothing; raises UserCodeError."""
    passing, slowest = [], 0.0
    for number in range(1, missions + 1):
        seed = mission_seed(mission.check.seed, number)
        begun = flyer.processor_seconds
        result = _judged(mission, flyer.fly(models.agent, number, seed))
        if result.judgement.code == USER_CODE:
            raise UserCodeError(result.judgement.message)
        if result.verdict is Verdict.PASS:
            passing.append((number, seed))
            slowest = max(slowest, flyer.processor_seconds - begun)
    return Ground(mission, models, tuple(passing), max(_LEAST_SECONDS, _SLOW * slowest))


def measure(ground: Ground, flyer: Flyer, seed: int, bounds: Callable[[], Bounds]) -> Iterator[MutantReport]:
    """Measure mutants, as many as the caller takes; those that are no models any more are left out."""
    agent = ground.models.agent
    sampled = {parameter.name for parameter in agent.parameters}
    sites = [site for site in sites_in(agent) if site.named not in sampled]
    for mutant in mutants_of(sites, seed):
        found = measure_mutant(ground, mutant, flyer, bounds())
        if found is not None:
            yield found


def measure_mutant(ground: Ground, mutant: Mutant, flyer: Flyer, bounds: Bounds) -> MutantReport | None:
    """Measure one mutant; None where it is no model any more."""
    overlay = with_edit((), mutant.edit)
    models = load_models(ground.mission, open_over(overlay), is_linted=True)
    return None if models.has_errors else _measured(ground, mutant, overlay, models, flyer, bounds)


def _measured(
    ground: Ground, mutant: Mutant, overlay: Overlay, models: ModelSet, flyer: Flyer, bounds: Bounds
) -> MutantReport:
    results: list[MissionResult] = []
    for number, seed in ground.seeds:
        load = partial(load_over, overlay)
        keeps = bool(ground.mission.check.limits)  # a mission that passes may fail by these
        result = flyer.fly(models.agent, number, seed, load, keeps_trace=keeps, most_seconds=ground.most_seconds)
        results.append(_judged(ground.mission, result))
        if results[-1].verdict is Verdict.ERROR:
            message = results[-1].judgement.message
            return MutantReport(mutant.edit, mutant.site.rule, Fate.ERROR, 0, len(results), message=message)
    failed = [result for result in results if result.verdict is Verdict.FAIL]
    if not failed:
        return MutantReport(mutant.edit, mutant.site.rule, Fate.SILENT, 0, len(results))
    programs = [models.programs[each.model] for each in models.agent.reactors]
    world = Suspended(
        models.agent, programs, ground.mission.check.limits, flyer, overlay, ground.mission, models.findings
    )
    root = Path(models.agent.root)
    faults = faults_of(group_failures(tuple(results)), results, CauseSearch(world, bounds))
    fullest, causes = faults[0]

    def first(is_it: Callable[[str, int], bool]) -> int:
        return next((k for k, cause in enumerate(causes.ranked, 1) if is_it(*_at(cause, root))), 0)

    return MutantReport(
        mutant.edit,
        mutant.site.rule,
        Fate.FAILS,
        len(failed),
        len(results),
        fullest.code,
        rank=first(mutant.is_at),
        rule_rank=first(mutant.is_in_rule),
        faults=len(faults),
        causes=causes,
    )


def _at(cause: RankedLine, root: Path) -> tuple[str, int]:
    return str(real_path(root / cause.place.file)), cause.place.line


def _judged(mission: Mission, result: MissionResult) -> MissionResult:
    return replace(result, judgement=judge_losses(result.judgement, result.losses, mission.check.limits))
