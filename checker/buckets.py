"""Failed missions in, groups out: failures with one culprit, a line of the model, count as one fault."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from checker.batch.result import MissionResult
from checker.causes import failed_by, missed_after
from checker.culprit import Culprit, culprit_of
from checker.limits import Limit
from checker.losses import GoalFate, Repairs
from checker.oracle import Judgement, Verdict, given_up
from runtime.executive.outcome import Event, OpenGoal

# File and line of the culprit; without one the code, the reactor and what the reason is about. Never the number of a
# token, a tick, or which goals stayed open: these differ between missions that fail alike.
Key = tuple[str, str, int, tuple[str, ...]]


@dataclass(frozen=True, slots=True)
class Bucket:
    """Missions that failed alike. `share` is that of all ordinary missions; `example` is the first of them.

    `judgement` and `open_goals` are those of the example. Where several groups turned out to be of one fault, `parts`
    are their examples, and the first of them stands for all.
    """

    judgement: Judgement
    open_goals: tuple[OpenGoal, ...]
    culprit: Culprit
    reactor: str
    missions: tuple[int, ...]
    share: float
    first_tick: int
    last_tick: int
    keys: frozenset[Key]
    parts: tuple[int, ...]
    refusal: Event | None = None  # what the example missed had been refused with

    @property
    def code(self) -> str:
        """The class of failure."""
        return self.judgement.code

    @property
    def example(self) -> int:
        """The mission that stands for all."""
        return self.parts[0]

    def holds(self, result: MissionResult) -> bool:
        """Whether a failed mission failed as these did."""
        return bucket_key(result) in self.keys


def bucket_key(result: MissionResult) -> Key:
    """What a failure is grouped by: the culprit's place, or what it is about where there is none."""
    assert result.outcome is not None
    abort, reason = given_up(result.outcome), result.judgement.reason
    place = _culprit(result).place
    if place is not None:
        return ("", place.file, place.line, ())
    about = [abort.reactor if abort else ""]
    if result.judgement.broken is not None:
        about.append(result.judgement.broken.name)
    if result.judgement.exceeded is not None:
        about += _lost(result, result.judgement.exceeded.limit)
    lost = next((goal.reason for goal in result.open_goals if goal.reason is not None), None)
    for one in (reason, lost, lost.repair if lost is not None else None):
        if one is not None:
            about += [one.kind, one.token.predicate if one.token else "", one.predicate, one.timeline]
    return (result.judgement.code, "", 0, tuple(about))


def _culprit(result: MissionResult) -> Culprit:
    """The culprit: of the conflict that ended the mission, of what was repaired too often, or Python that raised."""
    abort = given_up(result.outcome) if result.outcome is not None else None
    if abort is None and result.judgement.exceeded is not None and result.judgement.exceeded.limit is Limit.REPAIRS:
        at: Repairs = max(result.losses.repairs, key=lambda one: one.count)
        return Culprit(at=at.place)
    if abort is not None and abort.reason.raised is not None:
        return Culprit(at=abort.reason.raised)
    return culprit_of(failed_by(result.outcome).conflict if result.outcome is not None else None)


def _lost(result: MissionResult, limit: Limit) -> list[str]:
    """What a mission lost more of than allowed: the goals that it gave up, with their reasons, or the requests."""
    if limit is Limit.UNDELIVERED:
        return sorted({f"{one.sender}.{one.timeline}.{one.predicate}" for one in result.losses.undelivered})
    wanted = (GoalFate.LATE,) if limit is Limit.LATE else (GoalFate.LATE, GoalFate.REJECTED)
    goals = [one for one in result.losses.goals if one.fate in wanted]
    return sorted({str(one.reason.kind) if one.reason is not None else "" for one in goals})


def group_failures(results: tuple[MissionResult, ...]) -> tuple[Bucket, ...]:
    """The buckets of a batch, the fullest first; results are in mission order."""
    groups: dict[Key, list[MissionResult]] = {}
    for result in results:
        if result.verdict is Verdict.FAIL:
            groups.setdefault(bucket_key(result), []).append(result)
    counted = sum(result.verdict is not Verdict.ERROR for result in results)
    ordered = sorted(groups.items(), key=lambda item: (-len(item[1]), item[0]))
    return tuple(_bucket(members, counted) for _, members in ordered)


def _bucket(members: list[MissionResult], counted: int) -> Bucket:
    example = members[0].outcome
    assert example is not None
    outcomes = [member.outcome for member in members if member.outcome is not None]
    ends = [given_up(one) for one in outcomes]
    ticks = [one.last_tick if end is None else end.tick for one, end in zip(outcomes, ends, strict=True)]
    return Bucket(
        members[0].judgement,
        members[0].open_goals,
        _culprit(members[0]),
        ends[0].reactor if ends[0] else "",
        tuple(member.number for member in members),
        round(len(members) / counted, 9),
        min(ticks),
        max(ticks),
        frozenset({bucket_key(members[0])}),
        (members[0].number,),
        missed_after(example),
    )


def joined(buckets: Sequence[Bucket]) -> Bucket:
    """Several buckets as one; the first stands for all."""
    return replace(
        buckets[0],
        missions=tuple(sorted(number for one in buckets for number in one.missions)),
        share=round(sum(one.share for one in buckets), 9),
        first_tick=min(one.first_tick for one in buckets),
        last_tick=max(one.last_tick for one in buckets),
        keys=frozenset(key for one in buckets for key in one.keys),
        parts=tuple(part for one in buckets for part in one.parts),
    )
