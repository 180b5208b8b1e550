"""All missions of a run in, what there is to say about it out: the rate, and each fault with its line and condition."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from checker.batch.result import MissionResult
from checker.buckets import Bucket, group_failures
from checker.conditions.condition import Condition
from checker.conditions.find import find_condition
from checker.conditions.flights import Refly
from checker.mission import Mission
from checker.oracle import Verdict
from checker.smt.confirm import Confirmation, confirm
from checker.statistics import Rate, judge_rate
from checker.tally import Tally, tally
from runtime.executive.configuration import AgentConfiguration

_MOST_SHARPENED = 8  # buckets whose conditions are sought by flying again; the rest must do with samples


class Ending(StrEnum):
    """Why no more missions were flown."""

    COMPLETE = "complete"
    SIGNAL = "signal"  # Ctrl-C, SIGTERM, a hang-up
    SECONDS = "seconds"  # the time that was given is over
    FAILURES = "failures"  # there are as many as were asked for


@dataclass(frozen=True, slots=True)
class Fault:
    """A bucket of failures with what is known about it; `confirmation` is z3's word on the example's conflict."""

    bucket: Bucket
    condition: Condition | None
    confirmation: Confirmation | None


@dataclass(frozen=True, eq=False, slots=True)
class Findings:
    """What a run has shown. Equal runs give equal findings, whatever the number of workers."""

    run_id: str
    mission: Mission
    agent: AgentConfiguration  # the mission's, with what the models add
    seed: int
    planned: int
    results: tuple[MissionResult, ...]
    rate: Rate
    faults: tuple[Fault, ...]
    tally: Tally
    ending: Ending

    @property
    def is_interrupted(self) -> bool:
        """Whether a signal ended the run before its time."""
        return self.ending is Ending.SIGNAL

    def count(self, verdict: Verdict) -> int:
        """How many missions ended so."""
        return sum(result.verdict is verdict for result in self.results)

    @property
    def errors(self) -> tuple[MissionResult, ...]:
        """Missions that the tool could not fly; they are in no percentage."""
        return tuple(result for result in self.results if result.verdict is Verdict.ERROR)

    @property
    def holds(self) -> bool:
        """Whether the model may be believed: every planned mission counted, and not too many of them failed."""
        return not (self.rate.exceeds or self.errors or self.is_interrupted)


def assess(
    mission: Mission,
    agent: AgentConfiguration,
    run_id: str,
    seed: int,
    planned: int,
    results: Sequence[MissionResult],
    refly: Refly | None,
    *,
    ending: Ending = Ending.COMPLETE,
    focus: int | None = None,
) -> Findings:
    """Judge a run; `refly` flies single missions again with changed parameters, None where that is not wanted.

    With a `focus` it does so only for the fault that mission `focus` belongs to.
    """
    ordered = tuple(sorted(results, key=lambda result: result.number))
    counted = sum(result.verdict is not Verdict.ERROR for result in ordered)
    failures = sum(result.verdict is Verdict.FAIL for result in ordered)
    check = mission.check
    rate = judge_rate(failures, counted, check.max_failure_rate, check.confidence)
    faults: list[Fault] = []
    for position, bucket in enumerate(group_failures(ordered)):
        is_wanted = position < _MOST_SHARPENED if focus is None else focus in bucket.missions
        faults.append(_fault(bucket, ordered, agent, seed, refly if is_wanted else None))
    return Findings(
        run_id, mission, agent, seed, planned, ordered, rate, tuple(faults), tally(mission, ordered), ending
    )


def _fault(
    bucket: Bucket, results: tuple[MissionResult, ...], agent: AgentConfiguration, seed: int, refly: Refly | None
) -> Fault:
    example = next(result for result in results if result.number == bucket.example)
    abort = example.outcome.abort if example.outcome else None
    confirmation = confirm(abort.conflict) if abort and abort.conflict else None
    return Fault(bucket, find_condition(bucket, results, agent, seed, refly), confirmation)
