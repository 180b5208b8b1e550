"""Buckets of failures in, faults out: those that the same change mends are one fault, with the causes tried for it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Protocol, TypeVar

from checker.batch.interruption import uninterrupted
from checker.batch.result import MissionResult
from checker.buckets import Bucket, joined
from checker.conditions.condition import Condition
from checker.counterfactual.examples import examples_of, violated_by_all
from checker.counterfactual.missions import Missions
from checker.counterfactual.ranking import CANCELLED, NO_CAUSES, Causes, Claim, RankedLine
from checker.oracle import Verdict
from runtime.executive.outcome import SourcePlace

_Found = TypeVar("_Found")
_Mends = Callable[[RankedLine, MissionResult], bool]

MOST_SOUGHT = 8  # buckets whose causes and conditions are sought by flights
_MOST_TOLD = 3  # missions of a bucket on which the cause of a later one is tried
_WHOLE = (Claim.MENDS, Claim.LOOSENS)  # what a change does that may take the place of another one


class Seeker(Protocol):
    """What finds causes by trials."""

    def causes(self, missions: Missions) -> Causes:
        """The causes of one fault."""

    def mends(self, cause: RankedLine, failed: MissionResult, beside: frozenset[str]) -> bool:
        """Whether the change of a cause makes another failed mission pass, with all goals.

        Properties that are violated `beside` what every failure is about do not count.
        """


class Interruptible(Protocol):
    """What carries out a search, and gives None where a signal ends it."""

    def __call__(self, search: Callable[[], _Found], /) -> _Found | None:
        """What the search finds."""


@dataclass(frozen=True, eq=False, slots=True)
class Sought:
    """The buckets of a fault, by their examples, and what was found of it when it was sought before."""

    parts: tuple[int, ...]
    causes: Causes
    condition: Condition | None


def found_before(buckets: Sequence[Bucket], known: Sequence[Sought]) -> list[tuple[Bucket, Causes]]:
    """The faults behind buckets, as they were found."""
    by_example = {bucket.example: bucket for bucket in buckets}
    return [(joined([by_example[part] for part in one.parts]), one.causes) for one in known]


def faults_of(
    buckets: Sequence[Bucket],
    results: Sequence[MissionResult],
    seeker: Seeker,
    let: Interruptible = uninterrupted,
) -> list[tuple[Bucket, Causes]]:
    """The faults behind buckets, each with its causes: what the first cause of one mends, or the same statement, where
    it was flown, is one. So is a bucket before that the first cause of a later one mends as well: it is that of both.

    Where a signal ends the search, buckets that it did not come to are faults of their own.
    """
    by_number = {result.number: result for result in results}
    mends = partial(_mends, seeker, violated_by_all(results))
    found: list[tuple[Bucket, Causes]] = []
    for position, bucket in enumerate(buckets):
        causes = NO_CAUSES
        same = let(partial(_mended, found, by_number[bucket.example], mends))
        if same is None and position < MOST_SOUGHT:
            causes = let(partial(seeker.causes, missions_of(bucket, results))) or CANCELLED
            same = _at_one_place(found, causes)
        if same is None:
            earlier = let(partial(_also_mended, found, causes, by_number, mends)) or []
            joining = [bucket, *(one for one, _ in earlier)]
            found = [one for one in found if one not in earlier]
            found.append((joined(joining) if earlier else bucket, causes))
        else:
            found[same] = (joined((found[same][0], bucket)), found[same][1])
    return [(bucket, causes.among(len(bucket.missions))) for bucket, causes in found]


def missions_of(bucket: Bucket, results: Sequence[MissionResult], first: int | None = None) -> Missions:
    """The missions of a bucket on which changes are tried, mission `first` before others."""
    members = [result for result in results if result.number in bucket.missions]
    members.sort(key=lambda result: (result.number != first, result.number))
    found = examples_of(members, [result for result in results if result.verdict is Verdict.PASS])
    return replace(found, beside=violated_by_all(results))


def _mends(seeker: Seeker, beside: frozenset[str], cause: RankedLine, failed: MissionResult) -> bool:
    return seeker.mends(cause, failed, beside)


def _mended(found: Sequence[tuple[Bucket, Causes]], failed: MissionResult, mends: _Mends) -> int | None:
    for number, (_, causes) in enumerate(found):
        if causes.first is not None and mends(causes.first, failed):
            return number
    return None


def _also_mended(
    found: Sequence[tuple[Bucket, Causes]], causes: Causes, results: Mapping[int, MissionResult], mends: _Mends
) -> list[tuple[Bucket, Causes]]:
    """The buckets before that the first cause of a later one mends.

    Where one has a change of its own that helped, which does not mend the later one, several of its missions tell.
    """
    first = causes.first
    if first is None or first.change is None:
        return []
    mended = []
    for bucket, known in found:
        is_helpless = known.first is None or known.first.change is None
        others = [number for number in bucket.missions if number != bucket.example][: _MOST_TOLD - 1]
        tried = [bucket.example] if is_helpless else [bucket.example, *others]
        if (is_helpless or first.claim in _WHOLE) and all(mends(first, results[one]) for one in tried):
            mended.append((bucket, known))
    return mended


def _at_one_place(found: Sequence[tuple[Bucket, Causes]], causes: Causes) -> int | None:
    if causes.first is None or causes.first.change is None:  # what was not flown joins nothing
        return None
    place = causes.first.place
    return next((k for k, (_, one) in enumerate(found) if one.first and _is_same(one.first.place, place)), None)


def _is_same(one: SourcePlace, other: SourcePlace) -> bool:
    """Whether both are the same statement: a line may have several."""
    return (one.file, one.line, one.column) == (other.file, other.line, other.column)
