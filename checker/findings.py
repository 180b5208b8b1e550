"""All missions of a run in, what there is to say about it out: the rate, and each fault with its line and condition."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

from checker.batch.result import MissionResult
from checker.buckets import Bucket, group_failures
from checker.conditions.condition import Condition
from checker.conditions.find import find_condition
from checker.conditions.flights import Refly
from checker.conditions.record import Conditions
from checker.counterfactual.examples import examples_of
from checker.counterfactual.ranking import NO_CAUSES, Causes
from checker.counterfactual.trials import Missions
from checker.mission import Mission
from checker.oracle import Verdict
from checker.rate import Rate, judge_missions, rate_interval
from checker.regression import FlownCase
from checker.sensitivity import Sensitivity, sensitivities
from checker.smt.confirm import Confirmation, confirm
from checker.statistics import Interval
from checker.tally import Tally, tally
from runtime.executive.configuration import AgentConfiguration

Find = Callable[[Missions], Causes]
_MOST_SHARPENED = 8  # buckets whose conditions are sought by flying again; the rest must do with samples


class Ending(StrEnum):
    """Why no more missions were flown."""

    COMPLETE = "complete"
    SIGNAL = "signal"  # Ctrl-C, SIGTERM, a hang-up
    SECONDS = "seconds"  # the time that was given is over
    FAILURES = "failures"  # there are as many as were asked for
    DECIDED = "decided"  # the stopping rule has its answer


@dataclass(frozen=True, slots=True)
class Fault:
    """A bucket of failures with what is known about it; `confirmation` is z3's word on the example's conflict.

    `causes` are lines that were tried, empty where that was not asked for.
    """

    bucket: Bucket
    condition: Condition | None
    confirmation: Confirmation | None
    causes: Causes = NO_CAUSES
    interval: Interval | None = None  # of the rate of this fault alone


@dataclass(frozen=True, slots=True)
class Sampling:
    """How the missions of a run were chosen, and what that allows to say."""

    name: str = "random"
    most_weight: float = 1.0
    is_sequential: bool = False  # what was seen decided when to stop
    shown: bool | None = None  # what a stopping rule `rule` came to
    rule: str = ""


RANDOMLY = Sampling()


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
    sampling: Sampling = RANDOMLY
    sensitivities: tuple[Sensitivity, ...] = ()
    cases: tuple[FlownCase, ...] = ()  # regression cases, flown first; they are in no percentage

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


def regressed(cases: Sequence[FlownCase], limit: float) -> tuple[FlownCase, ...]:
    """The cases that had to pass and did not: promoted ones, and where no mission may fail all."""
    return tuple(one for one in cases if not one.passes and (one.case.is_promoted or limit == 0.0))


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
    sampling: Sampling = RANDOMLY,
    find: Find | None = None,
    conditions: Conditions | None = None,
    cases: tuple[FlownCase, ...] = (),
) -> Findings:
    """Judge a run; `refly` flies single missions again with changed parameters, None where that is not wanted.

    With a `focus` it does so only for the fault that mission `focus` belongs to, whose causes `find` then finds.
    Of `conditions` are those that are known already.
    """
    by_number = sorted(results, key=lambda result: result.number)
    ordered = tuple(result for result in by_number if result.number > 0)
    check = mission.check
    flown = [one for one in ordered if one.verdict is not Verdict.ERROR]
    rate = judge_missions(
        [(one.verdict is Verdict.FAIL, one.point) for one in flown],
        check.max_failure_rate,
        check.confidence,
        most_weight=sampling.most_weight,
        is_sequential=sampling.is_sequential,
    )
    if regressed(cases, check.max_failure_rate):
        rate = replace(rate, exceeds=True, is_certain=True)
    faults: list[Fault] = []
    for position, bucket in enumerate(group_failures(ordered)):
        is_wanted = position < _MOST_SHARPENED if focus is None else focus in bucket.missions
        members = set(bucket.missions)
        interval, _ = rate_interval(
            [(one.number in members, one.point) for one in flown],
            check.confidence,
            most_weight=sampling.most_weight,
            is_sequential=sampling.is_sequential,
        )
        fault = _fault(bucket, ordered, agent, seed, refly if is_wanted else None, conditions or {})
        is_sought = focus is not None and is_wanted
        causes = _causes(bucket, ordered, find, focus) if is_sought else NO_CAUSES
        faults.append(replace(fault, interval=interval, causes=causes))
    return Findings(
        run_id, mission, agent, seed, planned, ordered, rate, tuple(faults), tally(mission, ordered), ending,
        sampling, sensitivities(agent, ordered, check.confidence), cases,
    )  # fmt: skip


def _fault(
    bucket: Bucket,
    results: tuple[MissionResult, ...],
    agent: AgentConfiguration,
    seed: int,
    refly: Refly | None,
    known: Conditions,
) -> Fault:
    example = next(result for result in results if result.number == bucket.example)
    abort = example.outcome.abort if example.outcome else None
    confirmation = confirm(abort.conflict) if abort and abort.conflict else None
    if bucket.example in known:
        return Fault(bucket, known[bucket.example], confirmation)
    return Fault(bucket, find_condition(bucket, results, agent, seed, refly), confirmation)


def _causes(bucket: Bucket, results: tuple[MissionResult, ...], find: Find | None, focus: int | None) -> Causes:
    """The causes of a fault, tried on mission `focus` first."""
    if find is None:
        return NO_CAUSES
    members = [result for result in results if result.number in bucket.missions]
    members.sort(key=lambda result: (result.number != focus, result.number))
    return find(examples_of(members, [result for result in results if result.verdict is Verdict.PASS]))
