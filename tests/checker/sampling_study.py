"""Simulated batches of every sampler, without flying: how often each printed interval covers the true rate.

    python -m tests.checker.sampling_study 10000            every sampler
    python -m tests.checker.sampling_study 10000 adaptive   some of them

10 000 batches of all take some ten minutes, nearly all of them for the adaptive sampler.

The true rates are known: they are the volumes of the failing regions. A batch ends with its last mission, when a rule
to stop by has its answer, with its third failure, or when time is over, where missions that fail take a tenth of the
time of others; intervals that may be looked at while missions fly are also asked to cover at each mission at once. Of
samplers with plain random missions in fixed places only these count: they are drawn as arrays. An interval of weighted
missions covers a rate where bets against this rate have not won enough: that is asked of the bets.
"""

import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from math import pi, sqrt

import numpy as np

from checker.betting import log_stake, log_wealth
from checker.rate import Method, judge_missions
from checker.sampling.sampler import MissionRole, SamplePoint, Sampler, Setting, ShareAxis, Trial
from checker.statistics import confidence_sequence
from checker.stopping import parse_rule
from nddlc.samplers import SAMPLERS, find_sampler

AXES = tuple(ShareAxis(name, 0.0, 1.0 - 2.0**-53) for name in "ABCD")
RULE = parse_rule("p<0.05@95%")
CONFIDENCE = 0.95
LIMIT = 0.01
FAILURES = 3  # after which a batch ends
_RULED = 20  # batches in which the rule itself is asked as well
FAST = 0.1  # time of a mission that fails, of that of one that passes


class End(StrEnum):
    """What ends a batch."""

    MISSIONS = "all missions"
    RULE = "a rule to stop by"
    FAILURES = "third failure"
    SECONDS = "time is over"
    ANY = "any mission"  # whichever: the interval covers after each of them


@dataclass(frozen=True)
class World:
    """Where missions fail, as a function of their shares (the last axis of an array), and the volume of that."""

    fails: Callable[[np.ndarray], np.ndarray]
    rate: float


WORLDS = {
    "edge": World(lambda u: u[..., 0] > 0.95, 0.05),
    "both ends": World(lambda u: abs(u[..., 1] - 0.5) > 0.45, 0.1),
    "four corners": World(lambda u: (abs(u[..., 0] - 0.5) > 0.3) & (abs(u[..., 1] - 0.5) > 0.3), 0.16),
    "rare corner": World(lambda u: (u[..., 2] > 1 - sqrt(0.002)) & (u[..., 3] < sqrt(0.002)), 0.002),
    "rare edge": World(lambda u: u[..., 1] > 0.998, 0.002),
    "disc": World(lambda u: (u[..., 0] - 0.4) ** 2 + (u[..., 1] - 0.6) ** 2 < 0.01, pi * 0.01),
    "scattered": World(lambda u: (u[..., 0] * 1e4) % 1.0 < 0.06, 0.06),
    "rare pocket": World(lambda u: (abs(u - [0.3, 0.5, 0.6, 0.4]) < 0.002**0.25 / 2.0).all(axis=-1), 0.002),
    "half": World(lambda u: u[..., 0] + u[..., 3] > 1.0, 0.5),
    "never": World(lambda u: u[..., 0] > 2.0, 0.0),
}


@dataclass(frozen=True)
class Batch:
    """A simulated batch: whether each mission failed, with its point and, for the judge alone, its shares."""

    flown: list[tuple[bool, SamplePoint]]
    shares: list[np.ndarray]


def fly(sampler: Sampler, world: World, missions: int, dice: np.random.Generator) -> Batch:
    """Fly a batch by generations, as the campaign does."""
    trials: list[Trial] = []
    batch = Batch([], [])
    while len(trials) < missions:
        points = sampler.choose(trials, missions - len(trials))[: missions - len(trials)]
        rows = np.array([[share for _, share in one.shares] or dice.random(len(AXES)) for one in points])
        for point, shares, failed in zip(points, rows, world.fails(rows).tolist(), strict=True):
            trials.append(Trial(point, failed, behaviour=frozenset({int(8 * shares[0]), 100 + int(8 * shares[2])})))
            batch.flown.append((failed, point))
            batch.shares.append(shares)
    return batch


def batches(name: str, world: World, missions: int, count: int) -> Iterator[tuple[Batch, Sampler]]:
    """Batches of one sampler with different batch seeds."""
    _, make = find_sampler(name)
    for seed in range(count):
        sampler = make(Setting(AXES, seed, missions))
        yield fly(sampler, world, missions, np.random.default_rng([seed, 7])), sampler


@dataclass(frozen=True)
class Coverage:
    """How many of how many intervals covered the rate, and mean and deviation of the estimates."""

    method: Method
    covered: int
    count: int
    mean: float
    deviation: float

    @property
    def share(self) -> float:
        """Of the intervals, those that covered."""
        return self.covered / self.count

    @property
    def error(self) -> float:
        """Standard error of the share, that of the nominal one at least where all covered."""
        return sqrt(max(self.share * (1.0 - self.share), 1.0 / self.count) / self.count)

    def is_nominal(self) -> bool:
        """At least the nominal coverage, but for four standard errors of the simulation."""
        return self.covered >= self.count * CONFIDENCE - 4.0 * sqrt(self.count * CONFIDENCE * (1.0 - CONFIDENCE))


def fixed_roles(name: str, missions: int) -> list[MissionRole] | None:
    """The roles of a batch's missions where these are the same whatever fails; None where weights are chosen."""
    world, found = WORLDS["half"], set()
    for batch, _ in batches(name, world, missions, 3):
        found.add(tuple(point.role for _, point in batch.flown))
        # Plain random missions are drawn from seeds of their own: no sampler has a say.
        assert not any(point.shares for _, point in batch.flown if point.role is MissionRole.RANDOM)
    if len(found) != 1 or any(role is MissionRole.WEIGHTED for roles in found for role in roles):
        return None
    return list(found.pop())


@cache
def decision_table(most: int) -> np.ndarray:
    """Whether the rule to stop by is decided, by missions that count and failures among them."""
    assert RULE is not None
    table = np.zeros((most + 1, most + 1), dtype=bool)
    for missions in range(1, most + 1):
        for failures in range(missions + 1):
            lower, upper = confidence_sequence(failures, missions, RULE.confidence)
            table[missions, failures] = upper <= RULE.rate or lower >= RULE.rate
    return table


@cache
def sequence_covers(most: int, rate: float) -> np.ndarray:
    """Whether the confidence sequence covers a rate, by missions that count and failures among them."""
    table = np.zeros((most + 1, most + 1), dtype=bool)
    for missions in range(1, most + 1):
        for failures in range(missions + 1):
            table[missions, failures] = covers(confidence_sequence(failures, missions, CONFIDENCE), rate)
    return table


def first(hits: np.ndarray) -> np.ndarray:
    """Per row the number of missions at the first hit; all of them without one."""
    return np.asarray(np.where(hits.any(axis=1), hits.argmax(axis=1) + 1, hits.shape[1]))


def coverages(name: str, world: World, missions: int, count: int) -> dict[End, Coverage]:
    """The coverage of one sampler's intervals, by what ends a batch; none where it refuses to state one."""
    roles = fixed_roles(name, missions)
    if roles is None:
        return _weighted_coverages(name, world, missions, count)
    plain = sum(role is MissionRole.RANDOM for role in roles)
    if not plain:
        points = [(False, SamplePoint(role=role)) for role in roles]
        assert judge_missions(points, LIMIT, CONFIDENCE).interval is None
        return {}
    failed = world.fails(np.random.default_rng([plain, 7]).random((count, plain, len(AXES))))
    return {end: _random_coverage(failed, world, end, is_plain=plain == missions) for end in End}


def _random_coverage(failed: np.ndarray, world: World, end: End, *, is_plain: bool) -> Coverage:
    """Of plain random missions, a batch per row."""
    (count, plain), sums = failed.shape, failed.cumsum(axis=1)
    match end:
        case End.MISSIONS:
            ends = np.full(count, plain)
        case End.RULE:
            decided = decision_table(plain)[np.arange(1, plain + 1), sums]
            ends = first(decided)
            for row in range(min(_RULED, count)):
                flown = [(bool(one), SamplePoint()) for one in failed[row, : ends[row]]]
                assert _is_decided(flown, 1.0) == decided[row].any()
        case End.FAILURES:
            ends = first(sums >= FAILURES)
        case End.SECONDS:
            ends = (np.where(failed, FAST, 1.0).cumsum(axis=1) <= plain / 4).sum(axis=1)
        case End.ANY:
            covered = sequence_covers(plain, world.rate)[np.arange(1, plain + 1), sums].all(axis=1)
            seen = sums[:, -1] / plain
            return Coverage(Method.SEQUENCE, int(covered.sum()), count, float(seen.mean()), float(seen.std()))
    hits = np.where(ends > 0, sums[np.arange(count), ends - 1], 0)
    # As in the campaign: the exact interval is for plain random missions that end with the last, or the k-th failure.
    is_sequential = end in (End.RULE, End.SECONDS) or (end is End.FAILURES and not is_plain)

    @cache
    def judged(failures: int, flown: int) -> tuple[bool, float, Method]:
        flights = [(True, SamplePoint())] * failures + [(False, SamplePoint())] * (flown - failures)
        rate = judge_missions(flights, LIMIT, CONFIDENCE, is_sequential=is_sequential)
        assert rate.interval is not None
        return covers(rate.interval, world.rate), rate.observed, rate.method

    found = [judged(int(failures), int(flown)) for failures, flown in zip(hits, ends, strict=True)]
    seen = np.array([observed for _, observed, _ in found])
    return Coverage(found[0][2], sum(hit for hit, _, _ in found), count, float(seen.mean()), float(seen.std()))


def _is_decided(flown: list[tuple[bool, SamplePoint]], most_weight: float) -> bool:
    """Whether the rule itself has its answer."""
    assert RULE is not None
    return RULE.outcome(flown, most_weight) is not None


def covers(interval: tuple[float, float], rate: float) -> bool:
    """Whether a rate lies in an interval, but for the rounding of its ends."""
    return interval[0] <= rate + 1e-9 and rate - 1e-9 <= interval[1]


def _weighted_coverages(name: str, world: World, missions: int, count: int) -> dict[End, Coverage]:
    """Of a sampler that learns: each batch is chosen by the sampler itself."""
    covered, estimates = dict.fromkeys(End, 0), {end: np.zeros(count) for end in End}
    needed = log_stake(CONFIDENCE)
    for number, (batch, sampler) in enumerate(batches(name, world, missions, count)):
        values = [point.weight if failed else 0.0 for failed, point in batch.flown]
        is_in = np.maximum(*log_wealth(values, sampler.most_weight, world.rate)) < needed
        for end in End:
            at = _end_of(batch, sampler, end)
            covers_rate = bool(is_in.all() if end is End.ANY else at == 0 or is_in[at - 1])
            covered[end] += covers_rate
            estimates[end][number] = np.mean(values[:at]) if at else 0.0
            if number < _RULED:
                flown = batch.flown[:at]
                rate = judge_missions(flown, LIMIT, CONFIDENCE, most_weight=sampler.most_weight, is_sequential=True)
                assert rate.interval is not None
                assert end is End.ANY or covers(rate.interval, world.rate) == covers_rate
                assert abs(rate.observed - estimates[end][number]) < 1e-8
    return {
        end: Coverage(Method.WEIGHTED, covered[end], count, float(estimates[end].mean()), float(estimates[end].std()))
        for end in End
    }


def _end_of(batch: Batch, sampler: Sampler, end: End) -> int:
    """How many missions of a batch of weighted missions count."""
    failed = np.array([[failed for failed, _ in batch.flown]])
    match end:
        case End.MISSIONS | End.ANY:
            return len(batch.flown)
        case End.RULE:
            assert RULE is not None
            values = [point.weight if failed else 0.0 for failed, point in batch.flown]
            above, below = log_wealth(values, sampler.most_weight, RULE.rate)
            decided = np.maximum(above, below) >= log_stake(RULE.confidence)
            return int(first(decided[None, :])[0])
        case End.FAILURES:
            return int(first(failed.cumsum(axis=1) >= FAILURES)[0])
        case End.SECONDS:
            return int((np.where(failed, FAST, 1.0).cumsum(axis=1) <= len(batch.flown) / 4).sum())


def main(count: int, names: Sequence[str]) -> int:
    """Print the coverage of every interval, and the lowest of each sampler; the number of those that fall short."""
    short = 0
    lowest: list[str] = []
    for name in names or SAMPLERS:
        every: list[tuple[Coverage, str]] = []
        for caption, world in WORLDS.items():
            found = coverages(name, world, 200, count)
            for end, one in found.items():
                good = one.is_nominal()
                short += not good
                every.append((one, f"{caption}, {end.value}"))
                print(
                    f"{name:14} {caption:13} {end.value:18} {one.method.value:20} covers "
                    f"{100 * one.share:6.2f} %  rate {world.rate:.4f}, mean estimate {one.mean:.4f}"
                    f"{'' if good else '  TOO FEW'}",
                    flush=True,
                )
        if not every:
            lowest.append(f"{name:14} refuses an interval")
            continue
        least, where = min(every, key=lambda one: one[0].share)
        lowest.append(
            f"{name:14} {100 * least.share:6.2f} % (+- {100 * least.error:.2f}) {least.method.value}: {where}"
        )
    print("\nLowest coverage, with its standard error:", *lowest, sep="\n")
    return short


if __name__ == "__main__":
    sys.exit(min(1, main(int(sys.argv[1]), sys.argv[2:])))
