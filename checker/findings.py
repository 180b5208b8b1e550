"""All missions of a run in, what there is to say about it out: the rate, and each fault with its line and condition."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import partial

from checker.batch.interruption import uninterrupted
from checker.batch.result import MissionResult
from checker.broken_plans import blamed
from checker.buckets import Bucket, group_failures, joined
from checker.conditions.condition import Condition
from checker.conditions.find import find_condition
from checker.conditions.flights import HasTime, Refly, forever
from checker.conditions.record import Conditions
from checker.counterfactual.effort import Allowance
from checker.counterfactual.ranking import CANCELLED, NO_CAUSES, Causes
from checker.counterfactual.tried import TrialsEnd
from checker.faults import MOST_SOUGHT, Interruptible, Seeker, Sought, faults_of, found_before, missions_of
from checker.mission import Mission
from checker.oracle import Verdict
from checker.proofs.conflict import Confirmation, confirm
from checker.proofs.places import ModelText
from checker.rate import Rate, judge_missions, rate_interval
from checker.regression import FlownCase
from checker.sensitivity import Sensitivity, sensitivities
from checker.statistics import Interval
from checker.tally import Tally, tally
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.outcome import SourcePlace


class Ending(StrEnum):
    """Why no more missions were flown."""

    COMPLETE = "complete"
    SIGNAL = "signal"  # Ctrl-C, SIGTERM, a hang-up
    SECONDS = "seconds"  # the time that was given is over
    FAILURES = "failures"  # there are as many as were asked for
    DECIDED = "decided"  # the stopping rule has its answer
    STUCK = "stuck"  # none of the first missions came to its end in time


@dataclass(frozen=True, slots=True)
class Fault:
    """Failures of one cause with what is known about them; `confirmation` is z3's word on the example's conflict.

    `causes` are lines that were tried, empty where that was not asked for.
    """

    bucket: Bucket
    condition: Condition | None
    confirmation: Confirmation | None
    causes: Causes = NO_CAUSES
    interval: Interval | None = None  # of the rate of this fault alone
    is_cut: bool = False  # a signal ended the search for its condition
    is_tested: bool = False  # its condition was sought by flights

    @property
    def places(self) -> tuple[SourcePlace, ...]:
        """The lines to look at: the likeliest cause, then where the example's conflict gave way, and what limits it."""
        first = self.causes.first
        found = [first.place] if first is not None else []
        known = {(place.file, place.line) for place in found}
        for place in (self.bucket.culprit.place, *self.bucket.culprit.limits):
            if place is not None and (place.file, place.line) not in known:
                known.add((place.file, place.line))
                found.append(place)
        return tuple(found)


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
    is_cut: bool = False  # a signal ended the search for causes and conditions
    is_stored: bool = True  # so that `nddlc explain` can tell more of it

    @property
    def is_interrupted(self) -> bool:
        """Whether a signal ended the run before its time."""
        return self.ending is Ending.SIGNAL

    @property
    def is_whole(self) -> bool:
        """Whether neither the run nor the search for causes was ended by a signal."""
        return not (self.is_interrupted or self.is_cut)

    def count(self, verdict: Verdict) -> int:
        """How many missions ended so."""
        return sum(result.verdict is verdict for result in self.results)

    @property
    def errors(self) -> tuple[MissionResult, ...]:
        """Missions that the tool could not fly; they are in no percentage."""
        return tuple(result for result in self.results if result.verdict is Verdict.ERROR)

    @property
    def is_unknown(self) -> bool:
        """Whether nothing can be said: no mission was flown to its end, and no regression case decides."""
        return self.rate.missions == 0 and not self.rate.exceeds

    @property
    def holds(self) -> bool:
        """Whether the model may be believed: every planned mission counted, and not too many of them failed."""
        return not (self.rate.exceeds or self.errors or self.is_interrupted or self.is_unknown)


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
    seeker: Seeker | None = None,
    conditions: Conditions | None = None,
    causes: Mapping[int, Causes] | None = None,
    sought: Sequence[Sought] | None = None,
    text: ModelText | None = None,
    cases: tuple[FlownCase, ...] = (),
    let: Interruptible = uninterrupted,
    allowance: Allowance | None = None,
) -> Findings:
    """Judge a run; `refly` flies single missions again with changed parameters, None where that is not wanted.

    With a `focus` it does so only for the fault that mission `focus` belongs to. So does `seeker`, which finds causes;
    without a focus, buckets of one cause become one fault. `conditions` and `causes` are known already, or all
    that was `sought` before; `text` is what z3 reads the meaning of lines from. `let` carries out each search, and ends
    it where a signal comes. Flights are made for conditions within an `allowance` of time.
    """
    by_number = sorted(results, key=lambda result: result.number)
    ordered = tuple(result for result in by_number if result.number > 0)
    check = mission.check
    flown = [one for one in ordered if one.verdict is not Verdict.ERROR]
    gapless = _gapless(ordered) if ending is Ending.SIGNAL else len(flown)
    rate = judge_missions(
        [(one.verdict is Verdict.FAIL, one.point) for one in flown],
        check.max_failure_rate,
        check.confidence,
        most_weight=sampling.most_weight,
        is_sequential=sampling.is_sequential,
        gapless=gapless,
    )
    if regressed(cases, check.max_failure_rate):
        rate = replace(rate, exceeds=True, is_certain=True)
    faults: list[Fault] = []
    buckets = _alike(group_failures(ordered), conditions or {})
    if sought is None:
        pairs = _with_causes(buckets, ordered, seeker, focus, causes or {}, let)
    else:
        pairs = found_before(buckets, sought)
        conditions = {one.parts[0]: one.condition for one in sought}
    for position, (bucket, found) in enumerate(sorted(pairs, key=lambda one: -len(one[0].missions))):
        is_wanted = position < MOST_SOUGHT if focus is None else focus in bucket.missions
        members = set(bucket.missions)
        interval, _ = rate_interval(
            [(one.number in members, one.point) for one in flown[:gapless]],
            check.confidence,
            most_weight=sampling.most_weight,
            is_sequential=sampling.is_sequential,
        )
        flier = refly if is_wanted and (allowance is None or allowance()) else None
        has_time = forever if allowance is None else allowance.begin()
        asked = None if focus is None or is_wanted else Fault(bucket, None, None)  # nobody asks for this one
        known, most = conditions or {}, sampling.most_weight
        fault = asked or let(partial(_fault, bucket, ordered, agent, seed, flier, known, text, has_time, most))
        fault = Fault(bucket, None, None, is_cut=True) if fault is None else fault
        faults.append(replace(fault, interval=interval, causes=found))
    is_cut = any(one.is_cut or one.causes.ended is TrialsEnd.CANCELLED for one in faults)
    return Findings(
        run_id, mission, agent, seed, planned, ordered, rate, tuple(faults), tally(mission, ordered), ending,
        sampling, sensitivities(agent, ordered, check.confidence), cases, is_cut,
    )  # fmt: skip


def _gapless(results: Sequence[MissionResult]) -> int:
    """How many missions that are no ERROR come before the first that was not finished."""
    reached = next((at for at, one in enumerate(results) if one.number != at + 1), len(results))
    return sum(one.verdict is not Verdict.ERROR for one in results[:reached])


def _with_causes(
    buckets: tuple[Bucket, ...],
    results: tuple[MissionResult, ...],
    seeker: Seeker | None,
    focus: int | None,
    known: Mapping[int, Causes],
    let: Interruptible,
) -> list[tuple[Bucket, Causes]]:
    """Buckets, those of one fault joined, with the causes that a seeker finds; with a focus only for its bucket."""
    if seeker is None:
        return [(bucket, known.get(bucket.example, NO_CAUSES).among(len(bucket.missions))) for bucket in buckets]
    if focus is None:
        return faults_of(buckets, results, seeker, let)
    found: list[tuple[Bucket, Causes]] = []
    for one in buckets:
        causes = known.get(one.example, NO_CAUSES) if focus in one.missions else NO_CAUSES
        if focus in one.missions and not causes.is_sought:
            causes = let(partial(seeker.causes, missions_of(one, results, focus))) or CANCELLED
            causes = causes.among(len(one.missions))
        found.append((one, causes))
    return found


def _fault(
    bucket: Bucket,
    results: tuple[MissionResult, ...],
    agent: AgentConfiguration,
    seed: int,
    refly: Refly | None,
    known: Conditions,
    text: ModelText | None,
    has_time: HasTime,
    most_weight: float,
) -> Fault:
    example = next(result for result in results if result.number == bucket.example)
    conflict = blamed(example).conflict
    confirmation = confirm(conflict, text) if conflict is not None else None
    condition = known.get(bucket.example, bucket.example)
    if isinstance(condition, int):
        condition = find_condition(bucket, results, agent, seed, refly, has_time, most_weight)
    return Fault(bucket, condition, confirmation, is_tested=refly is not None and bool(agent.parameters))


def _alike(buckets: tuple[Bucket, ...], known: Conditions) -> tuple[Bucket, ...]:
    """The buckets, those joined that are known to be of one fault."""
    groups: dict[int, list[Bucket]] = {}
    for bucket in sorted(buckets, key=lambda one: isinstance(known.get(one.example), int)):
        same = known.get(bucket.example)
        groups.setdefault(same if isinstance(same, int) else bucket.example, []).append(bucket)
    return tuple(joined(group) for group in groups.values())
