"""Say in words how a parameter is drawn, for reports and explanations."""

import math

from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.distributions import DISTRIBUTIONS


def number(value: float) -> str:
    """A number as people write it: at most six digits, no needless ones."""
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else f"{value:.6g}"


def describe(parameter: ParameterConfiguration) -> str:
    """The distribution in one phrase, such as `uniform on [0.1, 4], one value per mission`."""
    distribution = DISTRIBUTIONS[parameter.distribution]
    values = [number(value) for value in parameter.values]
    shape = distribution.words.format(
        box=f"[{number(parameter.lower)}, {number(parameter.upper)}]",
        values=", ".join(values),
        value=values[0] if values else "",
    )
    if distribution.is_constant:
        return shape
    whole = ", whole numbers" if parameter.is_whole else ""
    rhythm = "one value per mission" if parameter.mode == "inter" else f"redrawn every {parameter.update} ticks"
    return f"{shape}{whole}, {rhythm}"
