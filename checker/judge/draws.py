"""Draw again what a mission drew: the values of sampled parameters from seed, name and index, by the judge's own code.

The stream of a parameter is SplitMix64 started at a mix of the seed and the FNV-1a hash of the name; the number at an
index is reached without those before. Normal distributions have the mean and the variance of the uniform one.
"""

import ast
import math
from collections.abc import Mapping
from functools import lru_cache
from statistics import NormalDist
from types import CodeType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from checker.judge.values import UNKNOWN
from compiler.program import Program
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from runtime.executive.record import Value

Array = NDArray[Any]
_Words = NDArray[np.uint64]
_U = np.uint64
_WORD = 2**64
_STEP = 0x9E3779B97F4A7C15
_STANDARD = NormalDist()
_CALLABLE = {"abs": abs, "min": min, "max": max, "floor": math.floor, "ceil": math.ceil, "sqrt": math.sqrt}


def _stir(words: _Words) -> _Words:
    words = (words ^ words >> _U(30)) * _U(0xBF58476D1CE4E5B9)
    words = (words ^ words >> _U(27)) * _U(0x94D049BB133111EB)
    return words ^ words >> _U(31)


@lru_cache(maxsize=256)
def _start(seed: int, name: str) -> int:
    """Where the stream of `name` begins."""
    digest = 0xCBF29CE484222325
    for byte in name.encode():
        digest = (digest ^ byte) * 0x100000001B3 % _WORD
    first = int(_stir(np.array([(seed + _STEP) % _WORD], _U))[0])
    return int(_stir(np.array([(first + digest) % _WORD], _U))[0])


def _shares(seed: int, name: str, indices: Array) -> Array:
    """The numbers in [0, 1) that the stream of `name` has at `indices`."""
    if len(indices) == 1:  # of a single token, for which arrays are slow
        word = (_start(seed, name) + (int(indices[0]) + 1) * _STEP) % _WORD
        word = (word ^ word >> 30) * 0xBF58476D1CE4E5B9 % _WORD
        word = (word ^ word >> 27) * 0x94D049BB133111EB % _WORD
        return np.array([((word ^ word >> 31) >> 11) / 2**53])
    steps = (indices.astype(_U) + _U(1)) * _U(_STEP)
    return (_stir(_U(_start(seed, name)) + steps) >> _U(11)).astype(float) / 2**53


def drawn(parameter: ParameterConfiguration, seed: int, ticks: Array) -> Array | None:
    """The values of a parameter for tokens that begin at `ticks`; None for a distribution that the judge lacks."""
    if parameter.mode == "inter" or not len(ticks):
        found = _values(parameter, seed, np.zeros(1, np.int64))
        return None if found is None else np.repeat(found, len(ticks))
    indices = np.maximum(ticks, 0) // parameter.update
    first, last = int(indices.min()), int(indices.max())
    if last - first >= len(indices):
        return _values(parameter, seed, indices)
    found = _values(parameter, seed, np.arange(first, last + 1))
    return None if found is None else found[indices - first]


def _values(parameter: ParameterConfiguration, seed: int, indices: Array) -> Array | None:
    """The values of a parameter at some indices of its stream."""
    parts = _shares(seed, parameter.stream or parameter.name, indices)
    if parameter.share is not None:
        parts = np.where(indices == 0, parameter.share, parts)
    lower, upper, width = parameter.lower, parameter.upper, parameter.upper - parameter.lower
    mean = lower + width / 2 if parameter.mean is None else parameter.mean
    deviation = width / 12**0.5 if parameter.deviation is None else parameter.deviation
    inner = (np.floor(parts * 2**52) + 0.5) / 2**52
    match parameter.distribution:
        case "uniform" if parameter.is_whole:
            values = np.minimum(lower + np.floor(parts * (width + 1)), upper)
        case "uniform":
            values = lower + parts * width
        case "normal":
            values = mean + deviation * _quantiles(inner)
        case "truncated_normal":
            below, above = (_STANDARD.cdf((end - mean) / deviation) for end in (lower, upper))
            inside = np.clip(below + inner * (above - below), 2**-53, 1 - 2**-53)
            values = np.minimum(np.maximum(mean + deviation * _quantiles(inside), lower), upper)
        case "discrete" | "choice":
            values = _picked(parameter, parts)
        case "fixed":
            values = np.full(len(parts), parameter.values[0], float)
        case _:
            return None
    return _in_range(parameter, values)


def _in_range(parameter: ParameterConfiguration, values: Array) -> Array:
    """The values after rounding and clipping."""
    if parameter.is_whole:
        values = np.floor(values + 0.5)
    if parameter.clip is not None:
        values = np.minimum(np.maximum(values, parameter.clip[0]), parameter.clip[1])
    return values


def _quantiles(parts: Array) -> Array:
    """The quantiles of the standard normal distribution."""
    return np.array([_STANDARD.inv_cdf(each) for each in parts.tolist()])


def _picked(parameter: ParameterConfiguration, parts: Array) -> Array:
    weights = parameter.weights or (1.0,) * len(parameter.values)
    reached = np.add.accumulate(weights)
    at = np.searchsorted(reached, parts * sum(weights), side="right")
    return np.array(parameter.values, float)[np.minimum(at, len(weights) - 1)]


@lru_cache(maxsize=256)
def _expression(text: str) -> tuple[CodeType, tuple[str, ...]]:
    """An expression ready to be evaluated, and the names in it; `checker.mission` has read it before."""
    tree = ast.parse(text.strip(), mode="eval")
    names = sorted({node.id for node in ast.walk(tree) if isinstance(node, ast.Name)})
    return compile(tree, "<expression>", "eval"), tuple(names)


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
        values = self.draws(name, np.array([tick]))
        return UNKNOWN if values is None else float(values[0])

    def draws(self, name: str, ticks: Array) -> Array | None:
        """The values of a parameter for tokens that begin at `ticks`; None if they are not known."""
        if name in self.overrides:
            return np.full(len(ticks), self.overrides[name], float)
        parameter = self.parameters.get(name)
        if parameter is None:
            return None
        if not parameter.expression:
            return drawn(parameter, self.seed, ticks)
        code, names = _expression(parameter.expression)
        given = {other: self.draws(other, ticks) for other in names if other in self.parameters}
        rows = [values.tolist() for values in given.values() if values is not None]
        if len(rows) < len(given):
            return None
        scope = {"__builtins__": _CALLABLE}
        found = [float(eval(code, scope, dict(zip(given, row, strict=True)))) for row in zip(*rows, strict=True)]
        return _in_range(parameter, np.array(found, float))
