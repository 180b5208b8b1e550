"""A mission and how to fly it in, the findings of a whole run out; what is finished is stored as it comes."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from checker.batch.identity import engine_digest, model_digest, run_id
from checker.batch.pool import Flyer, fly_all
from checker.batch.result import MissionResult
from checker.batch.store import Run, RunStore
from checker.batch.worker import Load, Task
from checker.findings import Fault, Findings, assess
from checker.mission import Mission
from checker.models import ModelSet
from checker.sampling.seeds import mission_seed
from checker.story import Story, tell

_MOST_STORIES = 8


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

    def fly(
        self,
        workers: int,
        store: RunStore | None,
        *,
        resume: bool,
        progress: Callable[[int, int], None],
    ) -> tuple[tuple[MissionResult, ...], bool]:
        """Fly what is not in the store yet; all results in mission order, and whether Ctrl-C came."""
        run, planned = self.run, self.mission.check.missions
        results = store.begin(run, keep=resume) if store is not None else {}
        tasks = [self.task(number) for number in range(1, planned + 1) if number not in results]

        def take(result: MissionResult) -> None:
            results[result.number] = result
            if store is not None:
                store.add(run, result)
            progress(len(results), planned)

        limit = self.mission.check.time_limit
        is_interrupted = fly_all(self.load, self.models.agent, tasks, workers, limit, take)
        if store is not None:
            store.flush()
        return tuple(results[number] for number in sorted(results)), is_interrupted

    def assess(
        self,
        results: tuple[MissionResult, ...],
        *,
        is_interrupted: bool = False,
        may_fly: bool = True,
        focus: int | None = None,
    ) -> Findings:
        """Judge the results; with `may_fly` thresholds are sharpened by flying examples again.

        With a `focus` that is done only for the fault that mission `focus` belongs to.
        """
        run, agent = self.run, self.models.agent
        with Flyer(self.load, agent, self.mission.check.time_limit) as flyer:
            refly = flyer.fly if may_fly and not is_interrupted else None
            return assess(
                self.mission,
                agent,
                run.id,
                run.seed,
                run.missions,
                results,
                refly,
                is_interrupted=is_interrupted,
                focus=focus,
            )

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
