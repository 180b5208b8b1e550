"""A mission and how to fly it in, the findings of a whole run out; what is finished is stored as it comes."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from signal import Signals

from checker.batch.identity import engine_digest, model_digest, run_id
from checker.batch.pool import Flyer, fly_all
from checker.batch.progress import Progress
from checker.batch.result import MissionResult
from checker.batch.store import Run, RunStore
from checker.batch.worker import Load, Task, fly_one
from checker.contrast import Contrast, find_contrast
from checker.findings import Ending, Fault, Findings, assess
from checker.mission import Mission
from checker.models import ModelSet
from checker.oracle import Verdict, judge_losses
from checker.regression import RegressionCase, agent_of
from checker.sampling.seeds import mission_seed
from checker.shrink import Shrunk, shrink
from checker.story import Story, tell
from runtime.executive.configuration import AgentConfiguration

_MOST_STORIES = 8


@dataclass(frozen=True, slots=True)
class Enough:
    """When a run ends before all missions are flown; without a bound None."""

    seconds: float | None = None
    failures: int | None = None


_NO_BOUND = Enough()


@dataclass(frozen=True, slots=True)
class Flown:
    """The results of a run in mission order, why there are no more, and the signal that ended it."""

    results: tuple[MissionResult, ...]
    ending: Ending
    ended_by: Signals | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Campaign:
    """A mission with its models, ready to be flown many times by `load`."""

    mission: Mission
    models: ModelSet
    load: Load

    @property
    def run(self) -> Run:
        """The run that this campaign is: same content, same id."""
        check = self.mission.check
        digest = model_digest(self.models.texts)
        identity = run_id(self.models.agent, digest, check.seed, check.missions, engine_digest())
        path = Path(self.mission.source.name).resolve()
        return Run(identity, str(path), check.seed, check.missions)

    def task(self, number: int) -> Task:
        """Mission `number` with its seed."""
        return Task(number, mission_seed(self.mission.check.seed, number))

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
    ) -> Flown:
        """Fly what is not in the store yet, or with `fresh` all of it again."""
        run, planned = self.run, self.mission.check.missions
        kept = store.begin(run, keep=not fresh) if store is not None else {}
        kept = {number: result for number, result in kept.items() if number <= planned}
        tasks = [self.task(number) for number in range(1, planned + 1) if number not in kept]
        watch = _Watch(self, run, kept, store, enough, progress)
        ended_by = None
        if not watch.is_enough():
            limit = self.mission.check.time_limit
            ended_by = fly_all(self.load, self.models.agent, tasks, workers, limit, watch)
        if store is not None:
            store.flush()
        return watch.flown(ended_by)

    def assess(
        self,
        results: tuple[MissionResult, ...],
        *,
        ending: Ending = Ending.COMPLETE,
        may_fly: bool = True,
        focus: int | None = None,
    ) -> Findings:
        """Judge the results; with `may_fly` conditions are sought and tested by flights.

        With a `focus` that is done only for the fault that mission `focus` belongs to.
        """
        run, agent = self.run, self.models.agent
        with Flyer(self.load, agent, self.mission.check.time_limit) as flyer:

            def refly(changed: AgentConfiguration, number: int, seed: int) -> MissionResult:
                return self.judged(flyer.fly(changed, number, seed))

            return assess(
                self.mission,
                agent,
                run.id,
                run.seed,
                run.missions,
                [self.judged(result) for result in results],
                refly if may_fly and ending is not Ending.SIGNAL else None,
                ending=ending,
                focus=focus,
            )

    def contrast(self, failed: MissionResult, results: tuple[MissionResult, ...]) -> Contrast | None:
        """What sets a failed mission apart from the nearest one that passes; flown in this process."""

        return find_contrast(failed, results, self.models.agent, self._traced)

    def shrink(self, failed: MissionResult, results: tuple[MissionResult, ...]) -> Shrunk | None:
        """The simplest mission that fails as `failed` does; flown in this process."""
        return shrink(failed, results, self.models.agent, self._traced)

    def regressions(self, cases: tuple[RegressionCase, ...]) -> tuple[tuple[RegressionCase, MissionResult], ...]:
        """The missions that are to pass, flown."""
        agents = [(case, agent_of(case, self.models.agent)) for case in cases]
        with Flyer(self.load, self.models.agent, self.mission.check.time_limit) as flyer:
            flown = [(case, flyer.fly(agent, number, case.seed)) for number, (case, agent) in enumerate(agents, 1)]
        return tuple((case, self.judged(result)) for case, result in flown)

    def _traced(self, agent: AgentConfiguration, number: int, seed: int) -> MissionResult:
        return self.judged(fly_one(self.load(agent), Task(number, seed), keep_trace=True))

    def story(self, result: MissionResult, fault: Fault | None) -> Story:
        """Why a mission failed."""
        return tell(result, self.models.agent, self.models.influence, fault)

    def stories(self, findings: Findings) -> list[Story | None]:
        """The story of each fault's example; of very many faults, of the first ones."""
        by_number = {result.number: result for result in findings.results}
        return [
            self.story(by_number[fault.bucket.example], fault) if index < _MOST_STORIES else None
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
    ) -> None:
        self.campaign, self.run, self.store, self.enough, self.progress = campaign, run, store, enough, progress
        self.results = {number: campaign.judged(result) for number, result in kept.items()}
        self.kept = len(kept)
        self.planned = campaign.mission.check.missions
        self.failures = sum(result.verdict is Verdict.FAIL for result in self.results.values())
        self.errors = 0
        self.begun = time.monotonic()
        self.reached = 0  # missions 1 to `reached` are finished
        self.failures_reached = 0
        self.is_over = False

    def take(self, result: MissionResult) -> None:
        """Have one more result."""
        if self.store is not None:
            self.store.add(self.run, result)
        judged = self.campaign.judged(result)
        self.results[result.number] = judged
        self.failures += judged.verdict is Verdict.FAIL
        self.errors += judged.verdict is Verdict.ERROR

    def is_enough(self) -> bool:
        """Store what is due, tell how far it came, and say whether time is over or there are failures enough."""
        if self.store is not None:
            self.store.flush_if_due()
        seconds = time.monotonic() - self.begun
        most, failures = self.enough.seconds, self.enough.failures
        if self.progress is not None:
            done = len(self.results)
            self.progress(Progress(self.planned, done, self.kept, self.failures, self.errors, seconds, most))
        while (following := self.results.get(self.reached + 1)) is not None and self._wants_more():
            self.reached += 1
            self.failures_reached += following.verdict is Verdict.FAIL
        self.is_over = most is not None and seconds >= most
        return self.is_over or (failures is not None and not self._wants_more())

    def _wants_more(self) -> bool:
        return self.enough.failures is None or self.failures_reached < self.enough.failures

    def flown(self, ended_by: Signals | None) -> Flown:
        """What counts: all of a run that came to its end, else what has no gaps."""
        self.is_enough()
        if not self._wants_more() and (self.reached < self.planned or len(self.results) > self.reached):
            return Flown(self._first(), Ending.FAILURES)
        if ended_by is not None:
            return Flown(self._all(), Ending.SIGNAL, ended_by)
        if len(self.results) < self.planned:
            return Flown(self._first(), Ending.SECONDS)
        return Flown(self._all(), Ending.COMPLETE)

    def _all(self) -> tuple[MissionResult, ...]:
        return tuple(self.results[number] for number in sorted(self.results))

    def _first(self) -> tuple[MissionResult, ...]:
        return tuple(self.results[number] for number in range(1, self.reached + 1))
