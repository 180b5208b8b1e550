"""A mission and how to fly it in, the findings of a whole run out; what is finished is stored as it comes."""

import math
import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from signal import Signals

from checker.batch.connection import Run
from checker.batch.engine import engine_digest
from checker.batch.identity import model_digest, run_id
from checker.batch.interruption import uninterrupted
from checker.batch.pool import Batch, FlyBatch, fly_all, nothing_more
from checker.batch.process import Flyer
from checker.batch.progress import Progress
from checker.batch.result import MissionResult
from checker.batch.store import RunStore
from checker.batch.worker import Load, Task, fly_one
from checker.broken_plans import broken_plan, usual_breaking
from checker.conditions.record import Conditions
from checker.contrast import Contrast, Trace, find_contrast, nearest_passing
from checker.counterfactual.effort import Allowance, Bounds
from checker.counterfactual.ranking import Causes
from checker.counterfactual.search import CauseSearch, Suspended
from checker.coverage import branches_taken
from checker.drawn import Drawn, drawn_paths
from checker.faults import Interruptible, Sought
from checker.findings import RANDOMLY, Ending, Fault, Findings, Sampling, assess
from checker.mission import Mission
from checker.models import ModelSet
from checker.oracle import HUNG, OUT_OF_TIME, Verdict, judge_losses
from checker.pinned import overlay_of
from checker.proofs.places import ModelText, text_of
from checker.regression import FlownCase, RegressionCase, worth_keeping
from checker.report.timelines import Pair
from checker.sampling.sampler import RANDOM_POINT, RandomSampler, Sampler, Setting, axes_of, with_point
from checker.sampling.seeds import mission_seed
from checker.schedule import Schedule, counted, is_random, make_task
from checker.shrink import Shrunk, shrink
from checker.stopping import StopRule
from checker.story import Story, suspects, tell
from runtime.executive.configuration import AgentConfiguration

_MOST_STORIES = 8
_MOST_PAIRS = 4
_BY_THE_CLOCK = (Ending.SECONDS, Ending.SIGNAL, Ending.STUCK)
_MOST_STUCK = 4  # missions that take too long, where no other has ended


@dataclass(frozen=True, slots=True)
class Enough:
    """When a run ends before all missions are flown; without a bound None."""

    seconds: float | None = None
    failures: int | None = None
    rule: StopRule | None = None
    missions: int | None = None  # the first ones of those planned


_NO_BOUND = Enough()


@dataclass(frozen=True, slots=True)
class Flown:
    """The results of a run in mission order, why there are no more, and the signal that ended it."""

    results: tuple[MissionResult, ...]
    ending: Ending
    ended_by: Signals | None = None
    sampling: Sampling = RANDOMLY
    cases: tuple[FlownCase, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class Campaign:
    """A mission with its models, ready to be flown many times by `load`."""

    mission: Mission
    models: ModelSet
    load: Load
    sampler_name: str = "random"
    make_sampler: Callable[[Setting], Sampler] = RandomSampler
    fly_batch: FlyBatch = fly_all

    @property
    def sampler(self) -> Sampler:
        """The sampler, for this agent, batch seed and number of missions."""
        check = self.mission.check
        return self.make_sampler(Setting(axes_of(self.models.agent), check.seed, check.missions))

    @property
    def run(self) -> Run:
        """The run that this campaign is: same content, same id."""
        check = self.mission.check
        digest = model_digest(self.models.texts)
        agent, sampler = self.models.agent, self.sampler_name
        identity = run_id(agent, digest, check.seed, check.missions, engine_digest(), sampler)
        path = Path(self.mission.source.name).resolve()
        return Run(identity, str(path), check.seed, check.missions, sampler)

    def task(self, number: int, result: MissionResult | None = None) -> Task:
        """Mission `number` with its seed, at the point of its result; without one, of a plain random mission."""
        seed = mission_seed(self.mission.check.seed, number) if result is None else result.seed
        return make_task(self.models.agent, number, seed, RANDOM_POINT if result is None else result.point)

    def judged(self, result: MissionResult) -> MissionResult:
        """A result with the limits of [check] applied; these may change without a flight."""
        judgement = judge_losses(result.judgement, result.losses, self.mission.check.limits)
        return result if judgement is result.judgement else replace(result, judgement=judgement)

    def fly(
        self,
        workers: int,
        store: RunStore | None,
        *,
        fresh: bool = False,
        enough: Enough = _NO_BOUND,
        progress: Callable[[Progress], None] | None = None,
        keeps_failures: bool = True,
        promoted: tuple[RegressionCase, ...] = (),
    ) -> Flown:
        """Fly what is not in the store yet, or with `fresh` all of it again; `promoted` cases come first.

        With `keeps_failures` those of earlier runs follow, and those of this one are kept.
        """
        run, check = self.run, self.mission.check
        kept = store.begin(run, keep=not fresh) if store is not None else {}
        planned = min(check.missions, enough.missions or check.missions)
        kept = {number: result for number, result in kept.items() if number <= planned}
        failures = store.failures(run) if store is not None and keeps_failures else ()
        watch = _Watch(self, run, kept, store, enough, progress, (*promoted, *failures))
        ended_by = None
        tasks = watch.schedule.more()
        if not watch.is_enough():
            more = nothing_more if watch.schedule.is_complete else watch.schedule.more
            if tasks:
                agent, limit = self.models.agent, check.time_limit
                ended_by = self.fly_batch(Batch(self.load, agent, tasks, workers, limit, more), watch)
        if store is not None:
            store.flush()
        flown = watch.flown(ended_by)
        if store is not None and keeps_failures:
            store.keep_failures(run, worth_keeping(flown.results, flown.cases))
        return flown

    def assess(
        self,
        results: tuple[MissionResult, ...],
        *,
        ending: Ending = Ending.COMPLETE,
        may_fly: bool = True,
        tests_conditions: bool = True,
        focus: int | None = None,
        sampling: Sampling | None = None,
        bounds: Bounds | None = None,
        seconds: float = math.inf,
        conditions: Conditions | None = None,
        causes: Mapping[int, Causes] | None = None,
        sought: Sequence[Sought] | None = None,
        cases: tuple[FlownCase, ...] = (),
        progress: Callable[[int], None] | None = None,
        let: Interruptible = uninterrupted,
    ) -> Findings:
        """Judge the results; with `may_fly` conditions are sought and tested by flights, which `progress` counts.

        Unless it `tests_conditions`: they come of the results alone then, and flights are made for causes only.

        Lines that may be the cause of a fault are tried within `bounds`, for all faults together no longer than
        `seconds`, and conditions, one after the other, begun within as many, each half as long. With a `focus` that is
        done only for the fault of mission `focus`. `conditions` and `causes` are known already, by example, or all that
        was `sought` before. `let` carries out each search, and ends it where a signal comes.
        """
        run, agent, is_flying = self.run, self.models.agent, may_fly and ending is not Ending.SIGNAL
        points = {result.number: result.point for result in results}
        with Flyer(self.load, agent, self.mission.check.time_limit, progress) as flyer:

            def refly(changed: AgentConfiguration, number: int, seed: int) -> MissionResult:
                changed = with_point(changed, points.get(number, RANDOM_POINT))
                return self.judged(flyer.fly(changed, number, seed))

            findings = assess(
                self.mission,
                agent,
                run.id,
                run.seed,
                run.missions,
                [self.judged(result) for result in results],
                refly if is_flying and tests_conditions else None,
                ending=ending,
                focus=focus,
                conditions=conditions,
                causes=causes,
                sought=sought,
                text=self._text(),
                cases=cases,
                sampling=sampling or Sampling(self.sampler_name, self.sampler.most_weight),
                seeker=self._seeker(flyer, bounds, seconds) if is_flying and bounds is not None else None,
                let=let,
                allowance=Allowance(seconds, seconds / 2, lambda: flyer.processor_seconds),
            )
            if findings.is_cut:
                flyer.dismiss()  # it may be in the middle of a flight
            return findings

    def contrast(
        self,
        failed: MissionResult,
        results: Sequence[MissionResult],
        fault: Fault | None = None,
        trace: Trace | None = None,
    ) -> Contrast | None:
        """What sets a failed mission apart from the nearest one that passes; flown in this process, or by `trace`."""
        broken = broken_plan(failed, usual_breaking(results))
        wanted = suspects(failed.outcome, fault, broken) if failed.outcome is not None else ()
        agent = with_point(self.models.agent, failed.point)
        return find_contrast(failed, results, agent, trace or self._traced, wanted)

    def shrink(self, failed: MissionResult, results: tuple[MissionResult, ...]) -> Shrunk | None:
        """The simplest mission that fails as `failed` does; flown in this process."""
        return shrink(failed, results, with_point(self.models.agent, failed.point), self._traced)

    def _traced(self, agent: AgentConfiguration, number: int, seed: int) -> MissionResult:
        return self.judged(fly_one(self.load(agent), Task(number, seed), keep_trace=True))

    def _seeker(self, flyer: Flyer, bounds: Bounds, seconds: float) -> CauseSearch:
        models, limits = self.models, self.mission.check.limits
        programs = [models.programs[each.model] for each in models.agent.reactors]
        world = Suspended(models.agent, programs, limits, flyer, overlay_of(models), self.mission, models.findings)
        return CauseSearch(world, bounds, seconds)

    def _text(self) -> ModelText:
        return text_of(self.models.agent, self.models.programs)

    def story(
        self,
        result: MissionResult,
        fault: Fault | None,
        results: Sequence[MissionResult] = (),
        contrast: Contrast | None = None,
    ) -> Story:
        """Why a mission failed; what passes all the same among `results` is no reason."""
        models, outcome = self.models, result.outcome
        behaviour = outcome.behaviour if outcome is not None and models.programs else ()  # none: in error by now
        programs = [models.programs[each.model] for each in models.agent.reactors] if behaviour else []
        taken = branches_taken(programs, behaviour) if programs else None
        decisive = [one.parameter for one in contrast.decisive] if contrast is not None else ()
        usual = usual_breaking(results)
        return tell(result, models.agent, models.influence, fault, self._text(), taken, usual, decisive)

    def pairs(self, findings: Findings) -> list[Pair | None]:
        """The example of each fault with a passing mission near to it, which is flown again for its events."""
        by_number = {result.number: result for result in findings.results}
        found: list[Pair | None] = []
        with Flyer(self.load, self.models.agent, self.mission.check.time_limit) as flyer:
            for fault in findings.faults[:_MOST_PAIRS]:
                example = by_number[fault.bucket.example]
                near = nearest_passing(example, findings.results, findings.agent)
                if near is None or example.outcome is None or not findings.is_whole:
                    found.append(None)
                    continue
                agent = with_point(self.models.agent, near.point)
                again = flyer.fly(agent, near.number, near.seed, keeps_trace=True)
                found.append(Pair(example, again) if again.outcome is not None else None)
        return found

    def drawn(self, findings: Findings, pairs: Sequence[Pair | None]) -> Drawn | None:
        """The paths that the mission file asks figures of."""
        figures = self.mission.figures
        if figures is None or not findings.is_whole:
            return None
        agent = self.models.agent
        with Flyer(self.load, agent, self.mission.check.time_limit) as flyer:
            return drawn_paths(figures, agent, findings, pairs, flyer)

    def stories(self, findings: Findings) -> list[Story | None]:
        """The story of each fault's example; of very many faults, of the first ones."""
        by_number = {result.number: result for result in findings.results}
        return [
            self.story(by_number[fault.bucket.example], fault, findings.results) if index < _MOST_STORIES else None
            for index, fault in enumerate(findings.faults)
        ]


class _Watch:
    """Takes the results of a run, stores them, and knows when there are enough.

    Failures are counted in mission order, without gaps: so a run that ends at the k-th failure counts the same
    missions however many workers flew it.
    """

    def __init__(
        self,
        campaign: Campaign,
        run: Run,
        kept: dict[int, MissionResult],
        store: RunStore | None,
        enough: Enough,
        progress: Callable[[Progress], None] | None,
        cases: tuple[RegressionCase, ...],
    ) -> None:
        self.campaign, self.run, self.store, self.enough, self.progress = campaign, run, store, enough, progress
        self.results = {number: campaign.judged(result) for number, result in kept.items()}
        self.kept = sum(number > 0 for number in kept)
        self.counts: Counter[Verdict] = Counter()
        self.timeouts = 0
        self.has_interval = True  # missions are plain random ones
        for result in self.results.values():
            self._count(result)
        planned = campaign.mission.check.missions
        self.planned = min(planned, enough.missions or planned)
        self.begun = time.monotonic()
        self.reached = 0  # missions 1 to `reached` are finished
        self.failures_reached = 0
        self.shown: bool | None = None  # what the stopping rule came to
        self.sampler = campaign.sampler
        seed = campaign.mission.check.seed
        agent, limits = campaign.models.agent, campaign.mission.check.limits
        self.schedule = Schedule(agent, self.sampler, seed, self.planned, cases, self.results, limits)

    def take(self, result: MissionResult) -> None:
        """Have one more result."""
        case = self.schedule.cases.get(result.number)
        if self.store is not None and (case is None or not case.is_promoted):
            self.store.add(self.run, result)
        self.results[result.number] = judged = self.campaign.judged(result)
        self._count(judged)

    def _count(self, result: MissionResult) -> None:
        """Count a mission of the run; regression cases are none."""
        if result.number > 0:
            self.counts[result.verdict] += 1
            self.timeouts += result.verdict is Verdict.ERROR and result.judgement.code in (OUT_OF_TIME, HUNG)
            self.has_interval = self.has_interval and is_random([result.point])

    def is_enough(self) -> bool:
        """Store what is due, tell how far it came, and say whether time is over or there are failures enough."""
        if self.store is not None:
            self.store.flush_if_due()
        seconds = time.monotonic() - self.begun
        most = self.enough.seconds
        if self.progress is not None:
            self.progress(self._progress(seconds, most))
        while (following := self.results.get(self.reached + 1)) is not None and self._wants_more():
            self.reached += 1
            self.failures_reached += following.verdict is Verdict.FAIL
            if self.enough.rule is not None:
                self.shown = self.enough.rule.outcome(counted(self._first()), self.sampler.most_weight)
        if (most is not None and seconds >= most) or self._is_stuck():
            return True
        return not self._wants_more() and len(self.schedule.flown_cases()) == len(self.schedule.cases)

    def _progress(self, seconds: float, most: float | None) -> Progress:
        counts = self.counts
        failures, errors = counts[Verdict.FAIL], counts[Verdict.ERROR]
        flown = failures + errors + counts[Verdict.PASS]
        return Progress(self.planned, flown, self.kept, failures, errors, seconds, most, self.has_interval)

    def _is_stuck(self) -> bool:
        """Whether no mission of the run came to its end in time: the others would take as long."""
        return self.timeouts >= _MOST_STUCK and self.timeouts == sum(self.counts.values())

    def _wants_more(self) -> bool:
        failures = self.enough.failures
        return (failures is None or self.failures_reached < failures) and self.shown is None

    def flown(self, ended_by: Signals | None) -> Flown:
        """What counts: all of a run that came to its end, else what has no gaps."""
        self.is_enough()
        numbers = [number for number in self.results if number > 0]
        if not self._wants_more() and (self.reached < self.planned or len(numbers) > self.reached):
            ending = Ending.FAILURES if self.shown is None else Ending.DECIDED
            return self._flown(self._first(), ending)
        if ended_by is not None:
            return self._flown(self._all(), Ending.SIGNAL, ended_by)
        if len(numbers) < self.planned:
            return self._flown(self._first(), Ending.STUCK if self._is_stuck() else Ending.SECONDS)
        return self._flown(self._all(), Ending.COMPLETE)

    def _flown(self, results: tuple[MissionResult, ...], ending: Ending, ended_by: Signals | None = None) -> Flown:
        """With the regression cases, and what the sampling allows to say.

        An exact interval keeps its confidence where plain random missions end with the last or the k-th failure; when
        time is over, how long missions take has decided which of them count.
        """
        rule = self.enough.rule
        is_plain = is_random([result.point for result in results])
        is_sequential = rule is not None or ending in _BY_THE_CLOCK or (ending is Ending.FAILURES and not is_plain)
        sampling = Sampling(
            self.campaign.sampler_name, self.sampler.most_weight, is_sequential, self.shown, rule.text if rule else ""
        )
        return Flown(results, ending, ended_by, sampling, self.schedule.flown_cases())

    def _all(self) -> tuple[MissionResult, ...]:
        return tuple(self.results[number] for number in sorted(self.results) if number > 0)

    def _first(self) -> tuple[MissionResult, ...]:
        return tuple(self.results[number] for number in range(1, self.reached + 1))
