"""Exact statistics of counts: Clopper and Pearson's interval, McNemar's test, a confidence sequence.

Only ordinary missions count; those that ended in an ERROR of the tool say nothing about the model.
"""

import math
from collections.abc import Callable

DIGITS = 9  # to which intervals are rounded, so that the last bits of `lgamma` reach no report
Interval = tuple[float, float]
LEAST_CHANCE = 10.0**-DIGITS
_PRIORS = ((0.5, 0.5), (0.5, 50.0))  # of the confidence sequence: for any rate, and for small ones


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
    return (round(lower, DIGITS), round(upper, DIGITS))


def confidence_sequence(failures: int, missions: int, confidence: float) -> Interval:
    """An interval that covers after every number of missions at once, so that it may be looked at while they fly.

    The rates at which a mixture of beta densities has less than 1 / (1 - confidence) times the likelihood of what was
    seen (Robbins 1970; Ville's inequality). Independent missions; when to stop may depend on all of them.
    """
    passes = missions - failures
    logs = [_log_beta(a + failures, b + passes) - _log_beta(a, b) for a, b in _PRIORS]
    top = max(logs)
    evidence = top + math.log(sum(math.exp(one - top) for one in logs) / len(logs))
    level = evidence + math.log(1.0 - confidence)  # of the log-likelihood: rates below it are ruled out

    def likelihood(rate: float) -> float:
        rate = min(rate, 1.0 - 2.0**-53)
        part = failures * math.log(rate) if failures else 0.0
        return part + (passes * math.log1p(-rate) if passes else 0.0)

    middle = failures / missions if missions else 0.5
    lower, upper = 0.0, 1.0
    if failures:
        lower = middle * _solve(lambda share: likelihood(max(share, 1e-300) * middle), level)
    if passes:
        upper = 1.0 - (1.0 - middle) * _solve(
            lambda share: likelihood(1.0 - max(share, 1e-300) * (1.0 - middle)), level
        )
    return (round(max(lower, 0.0), DIGITS), round(min(upper, 1.0), DIGITS))


def _log_beta(a: float, b: float) -> float:
    return math.lgamma(a) + math.lgamma(b) - math.lgamma(a + b)


def mcnemar(one_way: int, other_way: int) -> float:
    """McNemar's exact test: how likely so uneven a count of flips is if either way is as likely (two-sided).

    Never 0: what is less likely than 1e-9 is given as that.
    """
    flips, fewer = one_way + other_way, min(one_way, other_way)
    if not flips:
        return 1.0
    tail = 1.0 - incomplete_beta(fewer + 1, flips - fewer, 0.5)  # P(at most `fewer` of `flips` | 1/2)
    return max(round(min(1.0, 2.0 * tail), DIGITS), LEAST_CHANCE)


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
