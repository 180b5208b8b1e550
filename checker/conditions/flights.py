"""Labelled flights: the example of a bucket flown at chosen points, each point once, within a budget."""

from collections.abc import Callable
from enum import Enum

from checker.batch.result import MissionResult
from checker.buckets import Bucket
from checker.conditions.condition import Row
from checker.conditions.space import Point, Space
from checker.oracle import Verdict
from runtime.executive.configuration import AgentConfiguration

Refly = Callable[[AgentConfiguration, int, int], MissionResult]  # agent, number, seed
HasTime = Callable[[float], bool]  # whether less than this share of the time for a condition is over
_EVENTS = 200_000  # of all flights of one bucket together, about
_LEAST, _MOST = 60, 400
_TESTED = 0.6  # of as many, for the test on fresh missions
_EDGES = 0.6  # the share of its time in which edges are sought


class Ended(Enum):
    """How a mission ended, seen from one bucket."""

    FAILS = "fails"  # as the missions of the bucket
    OTHER = "other"  # in another way
    PASSES = "passes"


class SpentError(Exception):
    """The budget or its time is spent, or the tool failed in a flight: nothing more is to be had."""


def forever(share: float) -> bool:
    """Whether there is time, where it is not counted."""
    return share > 0.0


def flight_budget(example: MissionResult) -> int:
    """How many flights one bucket is worth: fewer where missions are long. A function of the mission, not of time."""
    events = len(example.outcome.events) if example.outcome is not None else 0
    return max(_LEAST, min(_MOST, _EVENTS // (1 + events)))


def fresh_budget(example: MissionResult) -> int:
    """How many fresh missions its condition is tested on."""
    return int(_TESTED * flight_budget(example))


def label_of(result: MissionResult, bucket: Bucket) -> Ended | None:
    """How a mission ended, seen from a bucket; None where the tool failed."""
    if result.verdict is Verdict.ERROR:
        return None
    if result.verdict is Verdict.PASS:
        return Ended.PASSES
    return Ended.FAILS if bucket.holds(result) else Ended.OTHER


class Flights:
    """Flies the example at other points and remembers how that ended."""

    def __init__(
        self,
        bucket: Bucket,
        example: MissionResult,
        space: Space,
        refly: Refly,
        budget: int,
        has_time: HasTime = forever,
    ) -> None:
        self.bucket, self.example, self.space, self.refly, self.budget = bucket, example, space, refly, budget
        self.has_time = has_time
        self.count = 0
        self.known: dict[Point, Ended] = {}

    def label(self, point: Point) -> Ended:
        """How the example ends at `point`; raises SpentError."""
        found = self.known.get(point)
        if found is None:
            if self.count >= self.budget or not self.has_time(_EDGES):
                raise SpentError
            self.count += 1
            result = self.refly(self.space.agent_at(point), self.example.number, self.example.seed)
            found = label_of(result, self.bucket)
            if found is None:
                self.budget = 0
                raise SpentError
            self.known[point] = found
        return found

    def fails(self, point: Point) -> bool:
        """Whether the example fails at `point`, in whatever way."""
        return self.label(point) is not Ended.PASSES

    def rows(self) -> list[tuple[Row, Ended]]:
        """All that was flown."""
        return [(self.space.as_row(point), label) for point, label in self.known.items()]
