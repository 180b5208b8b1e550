"""The distributions that a sampled parameter may have: one row each, with its quantile and its keys in a mission file.

Arithmetic that IEEE 754 fixes to the last bit only: every machine draws the same values.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import floor

from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.normal import normal_quantile

_SQRT_12 = 3.4641016151377544
_BELOW_RANGE = 0.04163225833177522  # Phi(-sqrt(3)): a moment-matched normal lies below its range this often


@dataclass(frozen=True, slots=True)
class _Distribution:
    """One way to draw a parameter.

    `quantile` is the value below which the parameter falls with a probability in [0, 1). `words` describes it, with
    `{box}`, `{values}` and `{value}` filled in. `keys` are those of `values`, `weights` and `value` that it takes from
    a mission file beside the range, `needs` those it cannot do without; a `value` is kept as the first of `values`.
    """

    quantile: Callable[[ParameterConfiguration, float], float]
    words: str
    keys: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    has_range: bool = True  # whether it is drawn from a range; else its values are all there is
    is_constant: bool = False


def _uniform(parameter: ParameterConfiguration, share: float) -> float:
    lower, upper = parameter.lower, parameter.upper
    if parameter.is_whole:
        return min(lower + floor(share * (upper - lower + 1.0)), upper)
    return lower + share * (upper - lower)


def _normal(parameter: ParameterConfiguration, share: float) -> float:
    """Mean and variance are those of the uniform: 4.2 % of the draws lie beyond either end (founding paper, 4)."""
    lower, upper = parameter.lower, parameter.upper
    return (lower + upper) / 2.0 + (upper - lower) / _SQRT_12 * normal_quantile(_inner(share))


def _truncated_normal(parameter: ParameterConfiguration, share: float) -> float:
    """The same, held inside the range."""
    lower, upper = parameter.lower, parameter.upper
    inside = _BELOW_RANGE + _inner(share) * (1.0 - 2.0 * _BELOW_RANGE)
    value = (lower + upper) / 2.0 + (upper - lower) / _SQRT_12 * normal_quantile(inside)
    return min(max(value, lower), upper)


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


DISTRIBUTIONS = {
    "uniform": _Distribution(_uniform, "uniform on {box}"),
    "normal": _Distribution(_normal, "normal, matched to {box}"),
    "truncated_normal": _Distribution(_truncated_normal, "normal, truncated to {box}"),
    "discrete": _Distribution(_discrete, "one of {values}", ("values", "weights"), ("values",), has_range=False),
    "fixed": _Distribution(_fixed, "always {value}", ("value",), ("value",), has_range=False, is_constant=True),
}
