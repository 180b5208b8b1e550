"""Simulated batches of every sampler, without flying: how often each printed interval covers the true rate.

    python -m tests.checker.sampling_study 10000

The true rates are known: they are the volumes of the failing regions. Random missions are drawn by numpy alone.
"""

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from checker.rate import Method, judge_missions
from checker.sampling.sampler import SamplePoint, Sampler, Setting, ShareAxis, Trial
from checker.stopping import parse_rule
from nddlc.samplers import SAMPLERS, find_sampler

AXES = tuple(ShareAxis(name, 0.0, 1.0 - 2.0**-53) for name in "ABCD")
RULE = parse_rule("p<0.05@95%")
CONFIDENCE = 0.95


@dataclass(frozen=True)
class World:
    """Where missions fail, as a function of their shares, and the volume of that."""

    fails: Callable[[np.ndarray], bool]
    rate: float


WORLDS = {
    "edge": World(lambda u: bool(u[0] > 0.95), 0.05),
    "both ends": World(lambda u: bool(abs(u[1] - 0.5) > 0.45), 0.1),
    "four corners": World(lambda u: bool(abs(u[0] - 0.5) > 0.3 and abs(u[1] - 0.5) > 0.3), 0.16),
    "rare corner": World(lambda u: bool(u[2] > 1 - sqrt(0.002) and u[3] < sqrt(0.002)), 0.002),
    "rare edge": World(lambda u: bool(u[1] > 0.998), 0.002),
    "disc": World(lambda u: bool((u[0] - 0.4) ** 2 + (u[1] - 0.6) ** 2 < 0.01), pi * 0.01),
    "scattered": World(lambda u: bool((u[0] * 1e4) % 1.0 < 0.06), 0.06),
    "half": World(lambda u: bool(u[0] + u[3] > 1.0), 0.5),
    "never": World(lambda u: False, 0.0),
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
        for point in sampler.choose(trials, missions - len(trials))[: missions - len(trials)]:
            shares = np.array([share for _, share in point.shares]) if point.shares else dice.random(len(AXES))
            failed = world.fails(shares)
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
    """How many of how many intervals covered the rate, the mean of the estimates, and how often nothing was said."""

    method: Method
    covered: int
    count: int
    mean: float
    deviation: float

    def is_nominal(self) -> bool:
        """At least the nominal coverage, but for four standard errors of the simulation."""
        return self.covered >= self.count * CONFIDENCE - 4.0 * sqrt(self.count * CONFIDENCE * (1.0 - CONFIDENCE))


def coverage(name: str, world: World, missions: int, count: int, *, is_sequential: bool = False) -> Coverage | None:
    """The coverage of one sampler's interval in one world; None where it refuses to state one."""
    covered, estimates, method = 0, [], Method.NONE
    for batch, sampler in batches(name, world, missions, count):
        flown = batch.flown
        if is_sequential:
            assert RULE is not None
            most = sampler.most_weight
            ends = (n for n in range(10, missions + 1, 10) if RULE.outcome(flown[:n], most) is not None)
            flown = flown[: next(ends, missions)]
        rate = judge_missions(flown, 0.01, CONFIDENCE, most_weight=sampler.most_weight, is_sequential=is_sequential)
        if rate.interval is None:
            return None
        method = rate.method
        covered += rate.interval[0] <= world.rate + 1e-9 and world.rate - 1e-9 <= rate.interval[1]
        estimates.append(rate.observed)
    return Coverage(method, covered, count, float(np.mean(estimates)), float(np.std(estimates)))


def main(count: int) -> int:
    """Print the coverage of every interval; the number of those that fall short."""
    short = 0
    for name in SAMPLERS:
        for caption, world in WORLDS.items():
            for is_sequential in (False, True):
                found = coverage(name, world, 200, count, is_sequential=is_sequential)
                if found is None:
                    print(f"{name:14} {caption:13} refuses an interval")
                    break
                good = found.is_nominal()
                short += not good
                print(
                    f"{name:14} {caption:13} {found.method.value:20} covers {100 * found.covered / count:6.2f} %"
                    f"  rate {world.rate:.4f}, mean estimate {found.mean:.4f}{'' if good else '  TOO FEW'}",
                    flush=True,
                )
    return short


if __name__ == "__main__":
    sys.exit(min(1, main(int(sys.argv[1]))))
