"""Say in words how a parameter is drawn, for reports and explanations."""

import math
import sys

from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.distributions import DISTRIBUTIONS, moments


def number(value: float) -> str:
    """A number as people write it: at most six digits, no needless ones."""
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    if abs(value) < sys.float_info.min:  # what intervals that are rounded outwards make of 0
        return "0"
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else f"{value:.6g}"


def describe(parameter: ParameterConfiguration) -> str:
    """The distribution in one phrase, such as `uniform on [0.1, 4], one value per mission`."""
    distribution = DISTRIBUTIONS[parameter.distribution]
    values = _values(parameter)
    shape = distribution.words.format(
        box=f"[{number(parameter.lower)}, {number(parameter.upper)}]",
        values=", ".join(values),
        value=values[0] if values else "",
        moments=_moments(parameter),
        expression=parameter.expression,
    )
    if parameter.stream:
        shape += f", drawn with the row of `{parameter.stream}`"
    if distribution.is_determined and not parameter.expression:
        return shape
    whole = ", whole numbers" if parameter.is_whole else ""
    clip = "" if parameter.clip is None else f", clipped to [{number(parameter.clip[0])}, {number(parameter.clip[1])}]"
    rhythm = "one value per mission" if parameter.mode == "inter" else f"redrawn every {parameter.update} ticks"
    return f"{shape}{whole}{clip}, {rhythm}"


def _values(parameter: ParameterConfiguration) -> list[str]:
    """What it may be; how often, where that differs."""
    total = sum(parameter.weights)
    shares = [f" ({number(100.0 * weight / total)} %)" for weight in parameter.weights]
    if len(set(parameter.weights)) < 2:
        shares = [""] * len(parameter.values)
    return [f"{number(value)}{share}" for value, share in zip(parameter.values, shares, strict=True)]


def _moments(parameter: ParameterConfiguration) -> str:
    if parameter.mean is None and parameter.deviation is None:
        return f"matched to [{number(parameter.lower)}, {number(parameter.upper)}]"
    mean, deviation = moments(parameter)
    return f"mean {number(mean)}, sigma {number(deviation)}"
