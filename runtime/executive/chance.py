"""Draw the values of sampled parameters: seed, parameter name and update index in, number out, nothing remembered.

A draw never depends on how often or in which order anybody asked (reference of T-REX, 3.4: constraints are executed an
unpredictable number of times, and again after backtracking). Only whole-number arithmetic and what IEEE 754 fixes to
the last bit are used, here and by the distributions, so every machine draws the same values.
"""

from collections.abc import Mapping
from functools import lru_cache
from math import floor

from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.distributions import DISTRIBUTIONS
from runtime.executive.expression import parse_expression
from runtime.executive.outcome import Draw

_MASK = (1 << 64) - 1
_GOLDEN = 0x9E3779B97F4A7C15  # 2**64 / golden ratio: the increment of SplitMix64 (Steele, Lea, Flood 2014)


def _mix(word: int) -> int:
    """The 64-bit finaliser of SplitMix64: a bijection in which every input bit reaches every output bit."""
    word = ((word ^ (word >> 30)) * 0xBF58476D1CE4E5B9) & _MASK
    word = ((word ^ (word >> 27)) * 0x94D049BB133111EB) & _MASK
    return word ^ (word >> 31)


@lru_cache(maxsize=1024)
def _stream(seed: int, name: str) -> int:
    """Where the stream of `name` starts: FNV-1a of its UTF-8 bytes, stirred together with the seed."""
    digest = 0xCBF29CE484222325
    for byte in name.encode("utf-8"):
        digest = ((digest ^ byte) * 0x100000001B3) & _MASK
    return _mix((_mix((seed + _GOLDEN) & _MASK) + digest) & _MASK)


def draw_bits(seed: int, name: str, index: int) -> int:
    """64 random bits: output `index` of SplitMix64 started at `_stream(seed, name)`, without the ones before."""
    return _mix((_stream(seed, name) + (index + 1) * _GOLDEN) & _MASK)


def draw(seed: int, name: str, index: int) -> float:
    """A number in [0, 1), one of 2**53 equally likely ones."""
    return (draw_bits(seed, name, index) >> 11) / 9007199254740992.0


def update_index(parameter: ParameterConfiguration, tick: int) -> int:
    """How often `parameter` has been redrawn by `tick` (reference of T-REX, 3.4)."""
    return 0 if parameter.mode == "inter" else max(tick, 0) // parameter.update


def sample(parameter: ParameterConfiguration, seed: int, tick: int, given: Mapping[str, float] | None = None) -> Draw:
    """The value of `parameter` that is in force at `tick`, dated by the tick of its draw.

    `raw` is what the distribution gave, `value` the same rounded (whole parameters) and then clipped. `given` are the
    values of others in force then, which a dependent parameter needs; without a value it raises ExpressionError.
    """
    index = update_index(parameter, tick)
    if parameter.expression:
        raw = parse_expression(parameter.expression).value(given or {})
    else:
        share = parameter.share if index == 0 else None
        if share is None:
            share = draw(seed, parameter.stream or parameter.name, index)
        raw = DISTRIBUTIONS[parameter.distribution].quantile(parameter, share)
    value = float(floor(raw + 0.5)) if parameter.is_whole else raw
    if parameter.clip is not None:
        value = min(max(value, parameter.clip[0]), parameter.clip[1])
    return Draw(parameter.name, 0 if parameter.mode == "inter" else index * parameter.update, raw, value)
