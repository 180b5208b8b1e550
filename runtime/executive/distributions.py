"""The distributions that a sampled parameter may have: one row each, with its quantile and its keys in a mission file.

Arithmetic that IEEE 754 fixes to the last bit only: every machine draws the same values.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from math import floor

from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.normal import normal_quantile

_SQRT_12 = 3.4641016151377544
_LEAST = 1.1102230246251565e-16  # 2**-53
_BELOW_RANGE = 0.04163225833177522  # Phi(-sqrt(3)): a moment-matched normal lies below its range this often


@dataclass(frozen=True, slots=True)
class _Distribution:
    """One way to draw a parameter.

    `quantile` is the value below which the parameter falls with a probability in [0, 1). `words` describes it, with
    `{box}`, `{moments}`, `{values}`, `{value}` and `{expression}` filled in. `keys` are those of `values`, `weights`,
    `value`, `mean`, `sigma` and `expression` that it takes from a mission file beside the range, `needs` those it
    cannot do without; a `value` is kept as the first of `values`.
    """

    quantile: Callable[[ParameterConfiguration, float], float]
    words: str
    keys: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    has_range: bool = True  # whether it is drawn from a range; else its values are all there is
    is_determined: bool = False  # by the file or by other parameters: chance has no part in it


def _uniform(parameter: ParameterConfiguration, share: float) -> float:
    lower, upper = parameter.lower, parameter.upper
    if parameter.is_whole:
        return min(lower + floor(share * (upper - lower + 1.0)), upper)
    return lower + share * (upper - lower)


def moments(parameter: ParameterConfiguration) -> tuple[float, float]:
    """Mean and standard deviation of a normal one: as given, or those of the uniform (founding paper, 4)."""
    lower, upper = parameter.lower, parameter.upper
    mean = (lower + upper) / 2.0 if parameter.mean is None else parameter.mean
    deviation = (upper - lower) / _SQRT_12 if parameter.deviation is None else parameter.deviation
    return mean, deviation


def _normal(parameter: ParameterConfiguration, share: float) -> float:
    """Matched to a range, 4.2 % of the draws lie beyond either end."""
    mean, deviation = moments(parameter)
    return mean + deviation * normal_quantile(_inner(share))


def _truncated_normal(parameter: ParameterConfiguration, share: float) -> float:
    """The same, held inside the range."""
    lower, upper = parameter.lower, parameter.upper
    mean, deviation = moments(parameter)
    if parameter.mean is None and parameter.deviation is None:
        below, above = _BELOW_RANGE, 1.0 - _BELOW_RANGE
    else:
        below, above = _normal_share((lower - mean) / deviation), _normal_share((upper - mean) / deviation)
    inside = min(max(below + _inner(share) * (above - below), _LEAST), 1.0 - _LEAST)
    value = mean + deviation * normal_quantile(inside)
    return min(max(value, lower), upper)


@lru_cache(maxsize=256)
def _normal_share(value: float) -> float:
    """The share of a standard normal below `value`, to 2**-53: by halving, for the quantile is exact everywhere."""
    lower, upper = 0.0, 1.0
    for _ in range(60):
        middle = (lower + upper) / 2.0
        if not lower < middle < upper:
            break
        if normal_quantile(middle) < value:
            lower = middle
        else:
            upper = middle
    return (lower + upper) / 2.0


def _discrete(parameter: ParameterConfiguration, share: float) -> float:
    """The value whose slice of [0, 1) holds `share`; slices are in the written order."""
    values, weights = parameter.values, parameter.weights
    if not weights:
        return values[floor(share * len(values))]
    total = 0.0
    for weight in weights:
        total += weight
    reached = 0.0
    for value, weight in zip(values, weights, strict=True):
        reached += weight
        if share * total < reached:
            return value
    return values[-1]


def _fixed(parameter: ParameterConfiguration, _share: float) -> float:
    return parameter.values[0]


def _inner(share: float) -> float:
    """`share` moved to the middle of its cell of width 2**-52, so that 0 and 1 never occur."""
    return (floor(share * 4503599627370496.0) + 0.5) / 4503599627370496.0


def _dependent(parameter: ParameterConfiguration, _share: float) -> float:
    raise AssertionError(f"{parameter.name} has no distribution of its own")


DISTRIBUTIONS = {
    "uniform": _Distribution(_uniform, "uniform on {box}"),
    "normal": _Distribution(_normal, "normal, {moments}", ("mean", "sigma")),
    "truncated_normal": _Distribution(_truncated_normal, "normal, {moments}, truncated to {box}", ("mean", "sigma")),
    "discrete": _Distribution(_discrete, "one of {values}", ("values", "weights"), ("values",), has_range=False),
    "choice": _Distribution(_discrete, "one of {values}, all alike", ("values",), ("values",), has_range=False),
    "fixed": _Distribution(_fixed, "always {value}", ("value",), ("value",), has_range=False, is_determined=True),
    "dependent": _Distribution(
        _dependent, "{expression}", ("expression",), ("expression",), has_range=False, is_determined=True
    ),
}
