"""Test of a condition on fresh missions: both sides, near an edge and far away; precision and recall with intervals.

Draws are known before a flight where a parameter is drawn once a mission: then seeds are chosen by what they draw, in
four strata (holds or not, near an edge or not) of known probability, and shares are weighted by it. Else missions are
flown as they come.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from checker.betting import betting_interval
from checker.buckets import Bucket
from checker.conditions.condition import Conjunction, Literal, Row, Share, holds
from checker.conditions.flights import Ended, HasTime, Refly, forever, label_of
from checker.conditions.space import Space
from checker.sampling.seeds import mission_seed
from checker.statistics import exact_interval

_CONFIDENCE = 0.95
_FIRST = 2_000_000_000  # number of the first fresh mission: no run has so many
_SCAN, _LONGEST_SCAN = 4000, 40_000
_NEAR = 0.25  # the share of each side that counts as near
_ENOUGH_INSIDE = 60
_SIDES = 2
_LEAST_TURNS = 3  # fresh missions of each stratum, and four times as many as they come, whatever the time
_TELLING, _LEAST_FAILING = 4, 0.5  # missions for which one part alone holds: how many tell, and how many have to fail


@dataclass(frozen=True, slots=True)
class Quality:
    """Precision and recall, over how many missions, and how many of them were near an edge.

    `inside` are the missions for which it holds, each with whether it failed; `outside` is the share of the others that
    failed, None where there were none.
    """

    precision: Share
    recall: Share
    fresh: int
    near: int
    inside: tuple[tuple[Row, bool], ...]
    outside: float | None


@dataclass(slots=True)
class _Stratum:
    """Fresh missions of one kind: how likely it is, and what came of those that were flown."""

    seeds: list[tuple[tuple[int, int], Row]]  # each with the number of its mission, and what it draws
    weight: float
    flown: int = 0
    failed: int = 0  # in whatever way
    alike: int = 0  # as the bucket
    ends: list[tuple[Row, bool]] = field(default_factory=list)  # of those that were flown, each with whether it failed

    def interval(self, count: int) -> tuple[float, float]:
        return exact_interval(count, self.flown, 1.0 - (1.0 - _CONFIDENCE) / _SIDES)


def measure(
    conjunctions: Sequence[Conjunction],
    space: Space,
    bucket: Bucket,
    batch_seed: int,
    refly: Refly,
    flights: int,
    has_time: HasTime = forever,
) -> Quality | None:
    """Fly fresh missions, fewer where time is over; None where the tool failed in one, or a side has none."""
    if space.has_redrawn:
        rows = _as_they_come(space, bucket, batch_seed, refly, flights, has_time)
        return None if rows is None else measured_on(rows, conjunctions)
    strata = _strata(conjunctions, space, batch_seed)
    chosen: list[tuple[int, _Stratum, tuple[tuple[int, int], Row]]] = []
    for is_inside in (True, False):
        near, far = strata[is_inside, True], strata[is_inside, False]
        each = flights // 4 if is_inside else flights - flights // 4
        quota = each // 2
        for stratum, most in ((near, quota), (far, each - min(quota, len(near.seeds)))):
            chosen += [(turn, stratum, one) for turn, one in enumerate(stratum.seeds[:most])]
    # By turns: where time is over, all strata have been flown.
    for turn, stratum, ((number, seed), row) in sorted(chosen, key=lambda one: one[0]):
        if turn >= _LEAST_TURNS and not has_time(1.0):
            break
        label = label_of(refly(space.agent, number, seed), bucket)
        if label is None:
            return None
        stratum.flown += 1
        stratum.failed += label is not Ended.PASSES
        stratum.alike += label is Ended.FAILS
        stratum.ends.append((row, label is not Ended.PASSES))
    inside = [strata[True, True], strata[True, False]]
    outside = [strata[False, True], strata[False, False]]
    flown = sum(one.flown for one in strata.values())
    near_flown = strata[True, True].flown + strata[False, True].flown
    if not any(one.flown for one in inside):
        return None
    precision = _weighted(inside, [one.failed for one in inside])
    hit, lost = _total(inside), _total(outside)
    recall = Share(_part(hit[0], lost[0]), (_part(hit[1], lost[2]), _part(hit[2], lost[1])))
    beyond = None
    if any(one.flown for one in outside):
        beyond = _weighted(outside, [one.failed for one in outside]).value
    return Quality(precision, recall, flown, near_flown, tuple(end for one in inside for end in one.ends), beyond)


def measured_on(rows: Sequence[tuple[Row, Ended]], conjunctions: Sequence[Conjunction]) -> Quality:
    """Precision and recall on missions as they came."""
    inside = [(row, label) for row, label in rows if holds(conjunctions, row)]
    alike = sum(label is Ended.FAILS for _, label in rows)
    ends = tuple((row, label is not Ended.PASSES) for row, label in inside)
    hit = sum(label is Ended.FAILS for _, label in inside)
    failed = sum(has_failed for _, has_failed in ends)
    beyond = _failing_outside([(row, label, 1.0) for row, label in rows], conjunctions)
    return Quality(_share(failed, len(inside)), _share(hit, alike), len(rows), 0, ends, beyond)


def weighted_on(
    rows: Sequence[tuple[Row, Ended, float]], conjunctions: Sequence[Conjunction], most_weight: float
) -> Quality:
    """Precision and recall on missions with weights, none above `most_weight`; intervals hold for any adaptive choice.

    Each is a part of a sum of two probabilities, of which each has an interval of its own.
    """
    inside = [(row, label, weight) for row, label, weight in rows if holds(conjunctions, row)]

    def part(kind: Callable[[bool, Ended], bool], rest: Callable[[bool, Ended], bool]) -> Share:
        values = [
            [weight if of(holds(conjunctions, row), label) else 0.0 for row, label, weight in rows]
            for of in (kind, rest)
        ]
        confidence = 1.0 - (1.0 - _CONFIDENCE) / _SIDES
        (low, high), (least, most) = (betting_interval(one, max(most_weight, 1.0), confidence) for one in values)
        return Share(_part(sum(values[0]), sum(values[1])), (_part(low, most), _part(high, least)))

    precision = part(
        lambda is_inside, label: is_inside and label is not Ended.PASSES,
        lambda is_inside, label: is_inside and label is Ended.PASSES,
    )
    recall = part(
        lambda is_inside, label: is_inside and label is Ended.FAILS,
        lambda is_inside, label: not is_inside and label is Ended.FAILS,
    )
    ends = tuple((row, label is not Ended.PASSES) for row, label, _ in inside)
    return Quality(precision, recall, len(rows), 0, ends, _failing_outside(rows, conjunctions))


def _failing_outside(rows: Sequence[tuple[Row, Ended, float]], conjunctions: Sequence[Conjunction]) -> float | None:
    """The share, by weight, that fail of the missions for which it does not hold; None where there are none."""
    others = [(weight, label is not Ended.PASSES) for row, label, weight in rows if not holds(conjunctions, row)]
    failing = sum(weight for weight, has_failed in others if has_failed)
    return failing / sum(weight for weight, _ in others) if others else None


def parts_that_hold(conjunctions: Sequence[Conjunction], measured: Quality) -> tuple[Conjunction, ...]:
    """The conjunctions but for those that are refuted by missions for which no other one holds."""
    kept = []
    for one in conjunctions:
        others = [each for each in conjunctions if each is not one]
        own = [failed for row, failed in measured.inside if holds([one], row) and not holds(others, row)]
        if len(own) < _TELLING or sum(own) >= _LEAST_FAILING * len(own):
            kept.append(one)
    return tuple(kept)


def _as_they_come(
    space: Space, bucket: Bucket, batch_seed: int, refly: Refly, flights: int, has_time: HasTime
) -> list[tuple[Row, Ended]] | None:
    """Fresh missions with their ends, whatever side they are on; None where the tool failed in one."""
    rows: list[tuple[Row, Ended]] = []
    for number in range(flights):
        if number >= 4 * _LEAST_TURNS and not has_time(1.0):
            break
        result = refly(space.agent, _FIRST + number, mission_seed(batch_seed, _FIRST + number))
        label, row = label_of(result, bucket), space.row(result)
        if label is None or row is None:
            return None
        rows.append((row, label))
    return rows


def _strata(conjunctions: Sequence[Conjunction], space: Space, batch_seed: int) -> dict[tuple[bool, bool], _Stratum]:
    """Fresh seeds by side and nearness; the scan goes on until there are some on the rarer side."""
    scanned: list[tuple[tuple[int, int], Row]] = []
    counts = {True: 0, False: 0}
    while len(scanned) < _SCAN or (min(counts.values()) < _ENOUGH_INSIDE and len(scanned) < _LONGEST_SCAN):
        number = _FIRST + len(scanned)
        seed = mission_seed(batch_seed, number)
        row = space.drawn(seed)
        counts[holds(conjunctions, row)] += 1
        scanned.append(((number, seed), row))
    spreads = _spreads(conjunctions, [row for _, row in scanned])
    strata: dict[tuple[bool, bool], _Stratum] = {}
    for is_inside in (True, False):
        side = [(seed, row) for seed, row in scanned if holds(conjunctions, row) is is_inside]
        far_to_near = sorted(_distance(conjunctions, row, spreads) for _, row in side)
        limit = far_to_near[int(_NEAR * len(side))] if side else 0.0
        for is_near in (True, False):
            seeds = [(seed, row) for seed, row in side if (_distance(conjunctions, row, spreads) <= limit) is is_near]
            strata[is_inside, is_near] = _Stratum(seeds, len(seeds) / len(scanned))
    return strata


def _spreads(conjunctions: Sequence[Conjunction], rows: Sequence[Row]) -> dict[Literal, float]:
    """How far the values of each literal's feature lie apart."""
    spreads = {}
    for literal in dict.fromkeys(one for each in conjunctions for one in each):
        values = sorted(value for row in rows if not math.isnan(value := literal.feature.value(row)))
        spreads[literal] = max(values[-1] - values[0], 1e-12) if values else 1.0
    return spreads


def _distance(conjunctions: Sequence[Conjunction], row: Row, spreads: dict[Literal, float]) -> float:
    """How far a mission is from the edge of a condition, in shares of what each feature spreads over."""
    outside, inside = [], [0.0]
    for conjunction in conjunctions:
        gaps = [(one.holds(row), abs(one.feature.value(row) - one.edge) / spreads[one]) for one in conjunction]
        gaps = [(is_held, math.inf if math.isnan(gap) else gap) for is_held, gap in gaps]
        if all(is_held for is_held, _ in gaps):
            inside.append(min(gap for _, gap in gaps))
        else:
            outside.append(max(gap for is_held, gap in gaps if not is_held))
    return max(inside) if len(inside) > 1 else min(outside)


def _weighted(strata: Sequence[_Stratum], counts: Sequence[int]) -> Share:
    flown = [(one, count) for one, count in zip(strata, counts, strict=True) if one.flown]
    weight = sum(one.weight for one, _ in flown)
    value = sum(one.weight * count / one.flown for one, count in flown) / weight
    ends = [(one.weight, one.interval(count)) for one, count in flown]
    return Share(value, (sum(w * e[0] for w, e in ends) / weight, sum(w * e[1] for w, e in ends) / weight))


def _total(strata: Sequence[_Stratum]) -> tuple[float, float, float]:
    """The probability of the bucket's failure in strata: estimate, lower and upper end."""
    value = low = high = 0.0
    for one in strata:
        ends = one.interval(one.alike)
        value += one.weight * (one.alike / one.flown if one.flown else 0.0)
        low, high = low + one.weight * ends[0], high + one.weight * ends[1]
    return value, low, high


def _part(part: float, rest: float) -> float:
    return part / (part + rest) if part + rest > 0.0 else 0.0


def _share(count: int, of: int) -> Share:
    return Share(count / of if of else 0.0, exact_interval(count, of, _CONFIDENCE))
