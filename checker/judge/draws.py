"""Draw again what a mission drew: the values of sampled parameters from seed, name and index, by the judge's own code.

The stream of a parameter is SplitMix64 started at a mix of the seed and the FNV-1a hash of the name; the number at an
index is reached without those before. Normal distributions have the mean and the variance of the uniform one.
"""

import ast
import math
from collections.abc import Mapping
from functools import lru_cache
from math import floor
from statistics import NormalDist

from checker.judge.values import UNKNOWN
from compiler.program import Program
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from runtime.executive.record import Value

_WORD = 2**64
_STEP = 0x9E3779B97F4A7C15
_STANDARD = NormalDist()
_CALLABLE = {"abs": abs, "min": min, "max": max, "floor": floor, "ceil": math.ceil, "sqrt": math.sqrt}


def _stir(word: int) -> int:
    word = (word ^ word >> 30) * 0xBF58476D1CE4E5B9 % _WORD
    word = (word ^ word >> 27) * 0x94D049BB133111EB % _WORD
    return word ^ word >> 31


@lru_cache(maxsize=4096)
def _share(seed: int, name: str, index: int) -> float:
    """The number in [0, 1) that the stream of `name` has at `index`."""
    digest = 0xCBF29CE484222325
    for byte in name.encode():
        digest = (digest ^ byte) * 0x100000001B3 % _WORD
    start = _stir((_stir((seed + _STEP) % _WORD) + digest) % _WORD)
    return (_stir((start + (index + 1) * _STEP) % _WORD) >> 11) / 2**53


def drawn(parameter: ParameterConfiguration, seed: int, tick: int) -> Value:
    """The value of a parameter for a token that begins at `tick`; unknown for a distribution that the judge lacks."""
    index = 0 if parameter.mode == "inter" else max(tick, 0) // parameter.update
    part = _share(seed, parameter.stream or parameter.name, index)
    if parameter.share is not None and index == 0:
        part = parameter.share
    lower, width = parameter.lower, parameter.upper - parameter.lower
    mean = lower + width / 2 if parameter.mean is None else parameter.mean
    deviation = width / 12**0.5 if parameter.deviation is None else parameter.deviation
    inner = (floor(part * 2**52) + 0.5) / 2**52
    match parameter.distribution:
        case "uniform" if parameter.is_whole:
            value = min(lower + floor(part * (width + 1)), parameter.upper)
        case "uniform":
            value = lower + part * width
        case "normal":
            value = mean + deviation * _STANDARD.inv_cdf(inner)
        case "truncated_normal":
            below, above = (_STANDARD.cdf((end - mean) / deviation) for end in (lower, parameter.upper))
            inside = min(max(below + inner * (above - below), 2**-53), 1 - 2**-53)
            value = mean + deviation * _STANDARD.inv_cdf(inside)
            value = min(max(value, lower), parameter.upper)
        case "discrete" | "choice":
            value = _picked(parameter, part)
        case "fixed":
            value = parameter.values[0]
        case _:
            return UNKNOWN
    return _settled(parameter, value)


def _settled(parameter: ParameterConfiguration, value: float) -> float:
    """The value after rounding and clipping."""
    if parameter.is_whole:
        value = float(floor(value + 0.5))
    if parameter.clip is not None:
        value = min(max(value, parameter.clip[0]), parameter.clip[1])
    return value


def _picked(parameter: ParameterConfiguration, part: float) -> float:
    weights = parameter.weights or (1.0,) * len(parameter.values)
    reached, goal = 0.0, part * sum(weights)
    for value, weight in zip(parameter.values, weights, strict=True):
        reached += weight
        if goal < reached:
            return value
    return parameter.values[-1]


class Chance:
    """What a mission draws; a parameter that is not configured is uniform over the range that a model gives it."""

    def __init__(
        self, agent: AgentConfiguration, programs: tuple[Program, ...], seed: int, overrides: Mapping[str, float]
    ) -> None:
        self.seed = seed
        self.overrides = overrides
        self.parameters = {parameter.name: parameter for parameter in agent.parameters}
        for program in programs:
            for site in program.sampled:
                if site.name not in self.parameters and site.default is not None and site.default.interval is not None:
                    lower, upper = site.default.interval
                    self.parameters[site.name] = ParameterConfiguration(
                        site.name, float(lower), float(upper), is_whole=site.kind == "int"
                    )

    def draw(self, name: str, tick: int) -> Value:
        """The value of a parameter for a token that begins at `tick`."""
        if name in self.overrides:
            return self.overrides[name]
        parameter = self.parameters.get(name)
        if parameter is None:
            return UNKNOWN
        if not parameter.expression:
            return drawn(parameter, self.seed, tick)
        names = {node.id for node in ast.walk(ast.parse(parameter.expression.strip())) if isinstance(node, ast.Name)}
        given = {other: self.draw(other, tick) for other in names & self.parameters.keys()}
        if not all(isinstance(value, float | int) for value in given.values()):
            return UNKNOWN
        found = eval(parameter.expression.strip(), {"__builtins__": _CALLABLE}, given)  # read by checker.mission before
        return _settled(parameter, float(found))
