"""Missions with their points in, the failure rate out: estimate, interval, method, and the decision against a limit.

Random missions count alike, weighted ones by their weights. Missions that a design has chosen say nothing about the
rate unless all were chosen so as to fill the space; then their share is told, and an interval is refused.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from checker.betting import betting_interval
from checker.sampling.sampler import MissionRole, SamplePoint
from checker.statistics import DIGITS, Interval, confidence_sequence, exact_interval


class Method(StrEnum):
    """How an interval was found."""

    EXACT = "exact"  # Clopper and Pearson's, for a number of missions that was fixed beforehand
    SEQUENCE = "confidence sequence"  # for missions that were looked at while they flew
    WEIGHTED = "weighted"  # bets on weighted missions: at any time, for any adaptive choice
    NONE = "none"  # refused: the missions are not independent, and no weights are known


@dataclass(frozen=True, slots=True)
class Rate:
    """How often missions fail, and what that says about the limit.

    `failures` of `missions` failed; the estimate `observed` rests on `counted` of them, of which `counted_failures`
    failed. The rule: the check fails when `observed` is above the limit, with a limit of 0 when any mission fails, and
    where missions failed that a design chose, unless the others show that the rate is within the limit (`exceeds`).
    Whether the interval agrees is said beside it: `is_certain` where the limit lies outside of it, on the side of the
    decision.
    """

    failures: int
    missions: int
    observed: float
    confidence: float
    interval: Interval | None
    method: Method
    limit: float
    exceeds: bool
    is_certain: bool
    counted: int
    counted_failures: int
    has_gaps: bool = False  # missions were left in flight: what came after the first of them is not counted


def judge_rate(failures: int, missions: int, limit: float, confidence: float) -> Rate:
    """The rate of plain random missions."""
    flown = [(True, SamplePoint())] * failures + [(False, SamplePoint())] * (missions - failures)
    return judge_missions(flown, limit, confidence)


def judge_missions(
    flown: Sequence[tuple[bool, SamplePoint]],
    limit: float,
    confidence: float,
    *,
    most_weight: float = 1.0,
    is_sequential: bool = False,
    gapless: int | None = None,
) -> Rate:
    """The rate of missions, each with whether it failed; `is_sequential` if what was seen decided when to stop.

    Only the first `gapless` missions are counted, if given: after a mission that is still in flight those come first
    that are soon over, and these fail more often than others.
    """
    failures = sum(failed for failed, _ in flown)
    first = flown[:gapless]
    counted = [(failed, point) for failed, point in first if point.role is not MissionRole.DESIGNED] or list(first)
    hits = sum(failed for failed, _ in counted)
    observed = _estimate(counted)
    interval, method = rate_interval(first, confidence, most_weight=most_weight, is_sequential=is_sequential)
    is_proof = limit == 0.0 and failures > 0
    is_shown = interval is None or interval[1] <= limit
    are_beside = any(failed and point.role is MissionRole.DESIGNED for failed, point in first)
    exceeds = observed > limit or is_proof or (are_beside and not is_shown)
    if interval is None:
        is_certain = is_proof
    else:
        is_certain = interval[0] > limit or is_proof if exceeds else is_shown
    return Rate(
        failures, len(flown), round(observed, DIGITS), confidence, interval, method, limit, exceeds, is_certain,
        len(counted), hits, len(first) < len(flown),
    )  # fmt: skip


def rate_interval(
    flown: Sequence[tuple[bool, SamplePoint]],
    confidence: float,
    *,
    most_weight: float = 1.0,
    is_sequential: bool = False,
) -> tuple[Interval | None, Method]:
    """The interval of the failure rate, and how it was found; None where none would be honest."""
    counted = [(failed, point) for failed, point in flown if point.role is not MissionRole.DESIGNED]
    if flown and not counted:
        return None, Method.NONE
    if any(point.role is MissionRole.WEIGHTED for _, point in counted):
        values = [point.weight if failed else 0.0 for failed, point in counted]
        return betting_interval(values, max(most_weight, 1.0), confidence), Method.WEIGHTED
    failures = sum(failed for failed, _ in counted)
    if is_sequential:
        return confidence_sequence(failures, len(counted), confidence), Method.SEQUENCE
    return exact_interval(failures, len(counted), confidence), Method.EXACT


def _estimate(counted: Sequence[tuple[bool, SamplePoint]]) -> float:
    return sum(point.weight for failed, point in counted if failed) / len(counted) if counted else 0.0
