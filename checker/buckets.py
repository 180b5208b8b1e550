"""Failed missions in, groups out: the same code at the same line of the model counts as one fault."""

from dataclasses import dataclass

from checker.batch.result import MissionResult
from checker.causes import Blame, blame
from checker.oracle import Verdict

Key = tuple[str, str, int, str]


@dataclass(frozen=True, slots=True)
class Bucket:
    """Missions that failed alike. `share` is that of all ordinary missions; `example` is the first of them."""

    code: str
    blame: Blame
    reason: str
    reactor: str
    missions: tuple[int, ...]
    share: float
    first_tick: int
    last_tick: int

    @property
    def example(self) -> int:
        """The mission that stands for all."""
        return self.missions[0]


def bucket_key(result: MissionResult) -> Key:
    """What a failure is grouped by: its code and the culprit's place, or its reason where no line is to blame."""
    assert result.outcome is not None
    abort = result.outcome.abort
    found = blame(abort.conflict if abort else None).place
    if found is not None:
        return (result.judgement.code, found.file, found.line, "")
    return (result.judgement.code, "", 0, f"{abort.reactor if abort else ''}: {result.judgement.reason}")


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
    ticks = [member.outcome.last_tick for member in members if member.outcome is not None]
    return Bucket(
        members[0].judgement.code,
        blame(example.abort.conflict if example.abort else None),
        members[0].judgement.reason,
        example.abort.reactor if example.abort else "",
        tuple(member.number for member in members),
        round(len(members) / counted, 9),
        min(ticks),
        max(ticks),
    )
