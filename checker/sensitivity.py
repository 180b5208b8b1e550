"""Which parameter drives failure: how far the draws of failing missions lie from chance, with an interval.

The shares of plain random missions are uniform. The distance is Kolmogorov's between those of failing missions and the
uniform distribution: 0 where the parameter has no part in it, near 1 where only a narrow range fails. Its interval is
that of Dvoretzky, Kiefer, Wolfowitz and Massart: it holds for every number of failures, whatever the distribution. The
intervals of all parameters hold together (Bonferroni), so that among many parameters none stands out by chance.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from checker.batch.result import MissionResult
from checker.oracle import Verdict
from checker.sampling.sampler import MissionRole, axes_of
from checker.statistics import DIGITS, Interval
from runtime.executive.chance import draw
from runtime.executive.configuration import AgentConfiguration

_FEWEST = 4  # failures: with fewer the interval says nothing


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """The distance of one parameter (or joint table)."""

    parameter: str
    distance: float
    interval: Interval


def sensitivities(
    agent: AgentConfiguration, results: Sequence[MissionResult], confidence: float
) -> tuple[Sensitivity, ...]:
    """Of each parameter that is drawn once per mission, the greatest distance first; from plain random missions.

    `confidence` is that all intervals cover. Where no mission passes, failing depends on no parameter.
    """
    random = [one for one in results if one.point.role is MissionRole.RANDOM]
    seeds = [one.seed for one in random if one.verdict is Verdict.FAIL]
    if len(seeds) < _FEWEST or all(one.verdict is not Verdict.PASS for one in random):
        return ()
    axes = axes_of(agent)
    each = 1.0 - (1.0 - confidence) / max(1, len(axes))
    found = [sensitivity(axis.name, [draw(seed, axis.name, 0) for seed in seeds], each) for axis in axes]
    return tuple(sorted(found, key=lambda one: -one.distance))


def sensitivity(name: str, shares: Sequence[float], confidence: float) -> Sensitivity:
    """The distance of failing missions' shares from the uniform distribution."""
    ordered, count = sorted(shares), len(shares)
    distance = max(max((at + 1) / count - share, share - at / count) for at, share in enumerate(ordered))
    slack = math.sqrt(math.log(2.0 / (1.0 - confidence)) / (2.0 * count))
    interval = (round(max(0.0, distance - slack), DIGITS), round(min(1.0, distance + slack), DIGITS))
    return Sensitivity(name, round(distance, DIGITS), interval)
