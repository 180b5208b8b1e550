"""Weighted missions in, an interval for the failure rate out that holds for any adaptive choice of where to fly.

A mission that fails counts with its weight, one that passes with 0: given all before it, the mean is the failure rate
p. So no strategy of fair bets against "the rate is p" wins 2 / (1 - confidence) times its stake but with that
probability (Ville; Waudby-Smith and Ramdas 2024). A rate against which a fixed mixture of bets has won so much is ruled
out. The interval covers at every number of missions at once.
"""

import math
from collections.abc import Callable, Sequence

import numpy as np

from checker.statistics import DIGITS, Interval

# The share of the stake that each bet may lose.
_BETS = np.array([0.999, 0.98, 0.9, 0.75, *(0.5**power for power in range(1, 12))])
_FINE = 0.01 * 10.0**-DIGITS  # at which halving ends
_LEAST = 1e-12


def betting_interval(values: Sequence[float], most: float, confidence: float) -> Interval:
    """The interval for the mean of `values`, each in [0, `most`], with that mean given all before it."""
    array = np.asarray(values, dtype=float)
    positive, zeros = array[array > 0.0], int((array <= 0.0).sum())
    needed = log_stake(confidence)
    lower, upper = 0.0, 1.0
    if len(positive):
        # Bets that p is too small: 1 + c (x / p - 1).
        def won_above(log_rate: float) -> float:
            rate = math.exp(log_rate)
            gains = np.log1p(_BETS[:, None] * (positive[None, :] / rate - 1.0)).sum(axis=1)
            return _mixture(gains + zeros * np.log1p(-_BETS))

        lower = math.exp(_cross(won_above, math.log(_LEAST), 0.0, needed))
        lower = 0.0 if lower <= 2.0 * _LEAST else lower

    # Bets that p is too large: 1 + c (p - x) / (most - p).
    def won_below(rate: float) -> float:
        room = max(most - rate, _LEAST)
        stakes = _BETS[:, None]
        losses = np.log(np.maximum(1.0 + stakes * (rate - positive[None, :]) / room, 1e-300)).sum(axis=1)
        return _mixture(losses + zeros * np.log1p(_BETS * rate / room))

    top = min(1.0, most)
    if len(array) and won_below(top) >= needed:
        upper = 1.0 - _cross(lambda gap: won_below(top - gap), 0.0, top, needed) - (1.0 - top)
    return (max(0.0, math.floor(lower * 10**DIGITS) / 10**DIGITS), min(1.0, round(upper, DIGITS)))


def log_stake(confidence: float) -> float:
    """The logarithm of the wealth at which a mean is ruled out."""
    return math.log(2.0 / (1.0 - confidence))


def log_wealth(values: Sequence[float], most: float, mean: float) -> tuple[np.ndarray, np.ndarray]:
    """After each value, the logarithms of what is won by bets that the mean is above `mean`, and that it is below."""
    array = np.asarray(values, dtype=float)
    stakes = _BETS[:, None]
    above = np.log1p(stakes * (array / max(mean, _LEAST) - 1.0)).cumsum(axis=1)
    below = np.log(np.maximum(1.0 + stakes * (mean - array) / max(most - mean, _LEAST), 1e-300)).cumsum(axis=1)
    return _mixtures(above), _mixtures(below)


def _mixtures(logs: np.ndarray) -> np.ndarray:
    """Of bets in rows: the logarithm of the mean of each column."""
    top = logs.max(axis=0)
    return np.asarray(top + np.log(np.exp(logs - top).mean(axis=0)))


def _mixture(logs: np.ndarray) -> float:
    return float(_mixtures(logs[:, None])[0])


def _cross(falling: Callable[[float], float], lower: float, upper: float, level: float) -> float:
    """Where a decreasing function falls below `level`, by halving."""
    while upper - lower > _FINE:
        middle = (lower + upper) / 2.0
        if falling(middle) >= level:
            lower = middle
        else:
            upper = middle
    return lower
