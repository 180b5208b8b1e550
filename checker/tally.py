"""The losses of many missions in, what there is to say of the batch as a whole out: per goal, per line, per request."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from checker.batch.result import MissionResult
from checker.losses import GoalFate, Unmet
from checker.mission import Mission
from checker.oracle import Verdict
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.outcome import Reason, ReasonKind, SourcePlace


@dataclass(frozen=True, slots=True)
class GoalTally:
    """A goal of the mission file over all missions; `place` is its line, `reasons` why it was given up, how often.

    `example` is the first mission that gave it up.
    """

    goal: GoalConfiguration
    place: SourcePlace
    counts: tuple[tuple[GoalFate, int], ...]
    reasons: tuple[tuple[Reason, int], ...]
    example: int | None

    def count(self, fate: GoalFate) -> int:
        """In how many missions it ended so."""
        return dict(self.counts)[fate]

    @property
    def given_up(self) -> int:
        """In how many missions it was given up."""
        return self.count(GoalFate.LATE) + self.count(GoalFate.REJECTED)


@dataclass(frozen=True, slots=True)
class RepairTally:
    """Repairs for one reason at one line (None: it has no culprit), and in how many missions; the first of these."""

    reactor: str
    kind: ReasonKind | None
    place: SourcePlace | None
    count: int
    missions: int
    example: int


@dataclass(frozen=True, slots=True)
class UnmetTally:
    """Requests that were not met, for one reason, and in how many missions; the first of these."""

    sender: str
    timeline: str
    predicate: str
    kind: ReasonKind | None
    count: int
    missions: int
    example: int


@dataclass(frozen=True, slots=True)
class Tally:
    """What the missions of a batch cost, those left out that ended in an ERROR."""

    missions: int
    goals: tuple[GoalTally, ...]
    repairs: tuple[RepairTally, ...]
    requests: int
    undelivered: tuple[UnmetTally, ...]
    given_up: tuple[UnmetTally, ...]

    def count(self, fate: GoalFate) -> int:
        """How many goals ended so, over all missions."""
        return sum(goal.count(fate) for goal in self.goals)

    @property
    def optional(self) -> int:
        """How many goals of the mission file are optional: to lose them fails no mission."""
        return sum(not each.goal.mandatory for each in self.goals)

    @property
    def repaired(self) -> int:
        """How many repairs there were."""
        return sum(each.count for each in self.repairs)

    @property
    def lost(self) -> int:
        """How many requests were not delivered."""
        return sum(each.count for each in self.undelivered)

    @property
    def dropped(self) -> int:
        """How many requests were taken and given up."""
        return sum(each.count for each in self.given_up)


def _goal_places(mission: Mission) -> tuple[SourcePlace, ...]:
    """The line of each goal in the mission file."""
    spans = (mission.text.key_span(("goal", number)) for number in range(len(mission.agent.goals)))
    return tuple(mission.text.place(span, "[[goal]]", 2) for span in spans)


def tally(mission: Mission, results: Sequence[MissionResult]) -> Tally:
    """Count the losses of missions in their order."""
    counted = [result for result in results if result.verdict is not Verdict.ERROR]
    goals = tuple(
        _goal(number, goal, place, counted)
        for number, (goal, place) in enumerate(zip(mission.agent.goals, _goal_places(mission), strict=True))
    )
    return Tally(
        len(counted),
        goals,
        _repairs(counted),
        sum(result.losses.requests for result in counted),
        _unmet([(result.number, each) for result in counted for each in result.losses.undelivered]),
        _unmet([(result.number, each) for result in counted for each in result.losses.given_up]),
    )


def _goal(number: int, goal: GoalConfiguration, place: SourcePlace, results: Sequence[MissionResult]) -> GoalTally:
    counts = dict.fromkeys(GoalFate, 0)
    reasons: Counter[Reason] = Counter()
    example: int | None = None
    for result in results:
        end = next((one for one in result.losses.goals if one.number == number), None)
        counts[GoalFate.OPEN if end is None else end.fate] += 1
        if end is not None and end.fate in (GoalFate.LATE, GoalFate.REJECTED):
            example = result.number if example is None else example
            if end.reason is not None:
                reasons[end.reason] += 1
    return GoalTally(goal, place, tuple(counts.items()), tuple(reasons.most_common()), example)


def _repairs(results: Sequence[MissionResult]) -> tuple[RepairTally, ...]:
    found: dict[tuple[str, ReasonKind | None, SourcePlace | None], Counter[int]] = {}
    for result in results:
        for each in result.losses.repairs:
            found.setdefault((each.reactor, each.kind, each.place), Counter())[result.number] += each.count
    listed = [RepairTally(*key, sum(by.values()), len(by), min(by)) for key, by in found.items()]
    return tuple(sorted(listed, key=lambda one: -one.count))


def _unmet(found: Sequence[tuple[int, Unmet]]) -> tuple[UnmetTally, ...]:
    groups: dict[tuple[str, str, str, ReasonKind | None], Counter[int]] = {}
    for mission, each in found:
        key = (each.sender, each.timeline, each.predicate, each.kind)
        groups.setdefault(key, Counter())[mission] += each.count
    listed = [UnmetTally(*key, sum(by.values()), len(by), min(by)) for key, by in groups.items()]
    return tuple(sorted(listed, key=lambda one: -one.count))
