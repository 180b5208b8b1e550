"""Count of failures in, an exact interval for the failure rate out, and the decision against a limit.

Only ordinary missions count; those that ended in an ERROR of the tool say nothing about the model.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

_DIGITS = 9  # to which intervals are rounded, so that the last bits of `lgamma` reach no report
Interval = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Rate:
    """How often missions fail, and what that says about the limit.

    The rule: the check fails when the observed rate is above the limit (`exceeds`). Whether the exact interval agrees
    is said beside it: `is_certain` where the limit lies outside the interval, on the side of the decision.
    """

    failures: int
    missions: int
    observed: float
    confidence: float
    exact: Interval
    limit: float
    exceeds: bool
    is_certain: bool


def judge_rate(failures: int, missions: int, limit: float, confidence: float) -> Rate:
    """Estimate a failure rate and compare it with what is accepted."""
    observed = failures / missions if missions else 0.0
    exact = exact_interval(failures, missions, confidence)
    exceeds = observed > limit
    is_certain = exact[0] > limit if exceeds else exact[1] <= limit
    return Rate(failures, missions, round(observed, _DIGITS), confidence, exact, limit, exceeds, is_certain)


def exact_interval(failures: int, missions: int, confidence: float) -> Interval:
    """Clopper and Pearson's interval (1934): never below its nominal confidence.

    That holds for a given number of missions, and for a batch that ends with its k-th failure (docs/mission.md).
    """
    if missions == 0:
        return (0.0, 1.0)
    tail = (1.0 - confidence) / 2.0
    lower, upper = 0.0, 1.0
    if failures > 0:  # P(at least `failures` | lower) = tail
        lower = _solve(lambda share: incomplete_beta(failures, missions - failures + 1, share), tail)
    if failures < missions:  # P(at most `failures` | upper) = tail
        upper = _solve(lambda share: incomplete_beta(failures + 1, missions - failures, share), 1.0 - tail)
    return (round(lower, _DIGITS), round(upper, _DIGITS))


def incomplete_beta(a: float, b: float, x: float) -> float:
    """The regularised incomplete beta function I_x(a, b), to about 1e-13.

    Continued fraction 8.17.22 of the NIST handbook by Lentz's method, in the half where it converges in
    O(sqrt(max(a, b))) steps.
    """
    if x <= 0.0:
        return 0.0
    if x >= 1.0:
        return 1.0
    if x > (a + 1.0) / (a + b + 2.0):
        return 1.0 - incomplete_beta(b, a, 1.0 - x)
    front = math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x)
    return math.exp(front) * _beta_fraction(a, b, x) / a


def _beta_fraction(a: float, b: float, x: float) -> float:
    tiny = 1e-300
    c = 1.0
    d = 1.0 / _away_from_zero(1.0 - (a + b) * x / (a + 1.0), tiny)
    value = d
    for m in range(1, 100_000):
        even = m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m))
        odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0))
        for term in (even, odd):
            d = 1.0 / _away_from_zero(1.0 + term * d, tiny)
            c = _away_from_zero(1.0 + term / c, tiny)
            value *= c * d
        if abs(c * d - 1.0) < 1e-16:
            break
    return value


def _away_from_zero(value: float, tiny: float) -> float:
    return value if abs(value) > tiny else tiny


def _solve(rising: Callable[[float], float], level: float) -> float:
    """Where the increasing function `rising` of [0, 1] reaches `level`, by halving."""
    lower, upper = 0.0, 1.0
    for _ in range(60):
        middle = (lower + upper) / 2.0
        if rising(middle) < level:
            lower = middle
        else:
            upper = middle
    return (lower + upper) / 2.0
