"""The missions of a run in the order in which they are flown: regression cases, then the sampler's generations.

A generation depends on the results of all missions before it and on nothing else, so that a run is the same whatever
the number of workers, and goes on where it ended.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from checker.batch.result import MissionResult
from checker.batch.worker import Task
from checker.limits import Limit
from checker.oracle import Verdict
from checker.regression import FlownCase, RegressionCase, agent_of
from checker.sampling.sampler import MissionRole, SamplePoint, Sampler, Trial, with_point
from checker.sampling.seeds import mission_seed
from runtime.executive.configuration import AgentConfiguration

_PROMOTED = 1_000_000  # numbers of promoted cases lie below minus this, out of the way of those that are stored


def make_task(agent: AgentConfiguration, number: int, seed: int, point: SamplePoint) -> Task:
    """Mission `number` with its seed, flown at its point."""
    return Task(number, seed, with_point(agent, point) if point.shares else None, point)


def _trial_of(result: MissionResult) -> Trial:
    """What a sampler may know of a result."""
    failed = None if result.verdict is Verdict.ERROR else result.verdict is Verdict.FAIL
    losses = result.losses
    given_up = sum(one.reason is not None for one in losses.goals)
    distress = float(losses.repaired + losses.lost + losses.dropped + 3 * given_up) - result.least_margin
    behaviour = frozenset(result.outcome.behaviour if result.outcome is not None else ())
    return Trial(result.point, failed, distress, behaviour)


class Schedule:
    """Knows the points of missions 1 to n as far as these are chosen, and which of them are still to be flown."""

    def __init__(
        self,
        agent: AgentConfiguration,
        sampler: Sampler,
        seed: int,
        planned: int,
        cases: Sequence[RegressionCase],
        results: Mapping[int, MissionResult],
        limits: tuple[tuple[Limit, int], ...] = (),
    ) -> None:
        self._agent, self._sampler, self._seed, self.planned = agent, sampler, seed, planned
        self._results, self._limits = results, limits
        self.points: list[SamplePoint] = []
        self.cases: dict[int, RegressionCase] = {}  # those that are no missions of the run, by their numbers below 0
        self._cases = sorted(cases, key=lambda one: one.is_promoted)  # so that those of the store keep their numbers
        self._is_begun = False

    @property
    def is_complete(self) -> bool:
        """Whether all points are chosen."""
        return len(self.points) >= self.planned

    def more(self) -> list[Task]:
        """The tasks of the next generation of which something is still to be flown; none at the end."""
        while not self.is_complete:
            first = len(self.points)
            trials = [_trial_of(self._results[number]) for number in range(1, first + 1)]
            self.points += self._sampler.choose(trials, self.planned - first)[: self.planned - first]
            assert len(self.points) > first, "a sampler chooses at least one point"
            tasks = [self.task(number) for number in range(first + 1, len(self.points) + 1)]
            if not self._is_begun:
                tasks = self._cases_first(tasks)
            tasks = [replace(task, limits=self._limits) for task in tasks if not self.is_flown(task)]
            if tasks:
                return tasks
        return []

    def task(self, number: int) -> Task:
        """Mission `number`, of a generation that was chosen."""
        return make_task(self._agent, number, mission_seed(self._seed, number), self.points[number - 1])

    def is_flown(self, task: Task) -> bool:
        """Whether there is a result of this very task."""
        found = self._results.get(task.number)
        return found is not None and (found.seed, found.point) == (task.seed, task.point)

    def flown_cases(self) -> tuple[FlownCase, ...]:
        """The regression cases that have a result, promoted ones first."""
        found = []
        for number, case in self.cases.items():
            result = self._results.get(number)
            if result is not None and (result.seed, result.point) == (case.seed, case.point):
                found.append(FlownCase(case, result))
        return tuple(sorted(found, key=lambda one: not one.case.is_promoted))

    def _cases_first(self, tasks: list[Task]) -> list[Task]:
        """What failed before comes first; what is no mission of this run has a number below 0."""
        self._is_begun = True
        known = {(task.seed, task.point): task for task in tasks}
        first: list[Task] = []
        promoted: list[Task] = []
        strange = 0
        for one in self._cases:
            same = None if one.is_promoted else known.pop((one.seed, one.point), None)
            if same is None:
                strange += 1
                number = -strange - (_PROMOTED if one.is_promoted else 0)
                self.cases[number] = one
                same = Task(number, one.seed, agent_of(one, self._agent), one.point)
            (promoted if one.is_promoted else first).append(same)
        return [*promoted, *first, *known.values()]


def counted(results: Sequence[MissionResult]) -> list[tuple[bool, SamplePoint]]:
    """Whether each mission failed, and its point; ERRORs are counted nowhere."""
    return [(one.verdict is Verdict.FAIL, one.point) for one in results if one.verdict is not Verdict.ERROR]


def is_random(points: Sequence[SamplePoint]) -> bool:
    """Whether all missions are plain random ones."""
    return all(point.role is MissionRole.RANDOM for point in points)
