"""What a sampler is: the axes of a mission's parameters and what was flown in, the points to fly next out.

A point is a share in [0, 1) per axis, which the distribution of the parameter turns into a value: so the density of
plain random missions is 1 everywhere, and that of a weighted sampler is its importance. Only parameters that are drawn
once per mission are axes; what is redrawn in a mission is always drawn at random.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Protocol

import numpy as np

from runtime.executive.chance import draw_bits
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from runtime.executive.distributions import DISTRIBUTIONS

_MATCHED_TAIL = 0.04163225833177522  # of a normal beyond the range that it is matched to
_ALMOST_ONE = 1.0 - 2.0**-53


class MissionRole(StrEnum):
    """What a mission says about the failure rate."""

    RANDOM = "random"  # drawn as the mission file says, whatever was flown before
    DESIGNED = "designed"  # chosen: it says that something can fail, not how often
    WEIGHTED = "weighted"  # drawn from a known density: it counts with its weight


@dataclass(frozen=True, slots=True)
class SamplePoint:
    """The shares of a mission by stream, its role, and its weight: 1 / density under the sampler."""

    shares: tuple[tuple[str, float], ...] = ()
    role: MissionRole = MissionRole.RANDOM
    weight: float = 1.0


RANDOM_POINT = SamplePoint()


@dataclass(frozen=True, slots=True)
class ShareAxis:
    """A stream of shares; `low` and `high` are those at the ends of the parameter's range."""

    name: str
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Trial:
    """What a sampler may know of a mission that was flown.

    `failed` is None for an ERROR; `distress` grows as it comes nearer to failing; `behaviour` are the features that
    were exercised: rules, branches, repairs, kinds of events.
    """

    point: SamplePoint
    failed: bool | None
    distress: float = 0.0
    behaviour: frozenset[int] = frozenset()


class Sampler(Protocol):
    """Chooses points. What it chooses may depend on all it was told, and on nothing else."""

    @property
    def most_weight(self) -> float:
        """No weight is greater."""

    def choose(self, trials: Sequence[Trial], count: int) -> list[SamplePoint]:
        """The points of at most `count` missions, at least one, after `trials`, in the order of missions."""


@dataclass(frozen=True, slots=True)
class Setting:
    """What a sampler is made for: axes, batch seed, how many missions are planned."""

    axes: tuple[ShareAxis, ...]
    seed: int
    planned: int

    def generator(self, purpose: str, turn: int = 0) -> np.random.Generator:
        """A stream of chance of its own for each purpose and turn."""
        return np.random.Generator(np.random.PCG64(draw_bits(self.seed, f"sampler {purpose}", turn)))

    def point(self, shares: Iterable[float], role: MissionRole, weight: float = 1.0) -> SamplePoint:
        """A point from its shares in the order of the axes."""
        held = [min(max(float(share), 0.0), _ALMOST_ONE) for share in shares]
        return SamplePoint(tuple(zip((axis.name for axis in self.axes), held, strict=True)), role, weight)


def axes_of(agent: AgentConfiguration) -> tuple[ShareAxis, ...]:
    """The axes of a mission: streams that chance has a part in, drawn once per mission."""
    found: dict[str, ShareAxis] = {}
    for one in agent.parameters:
        name = one.stream or one.name
        if one.mode == "inter" and not DISTRIBUTIONS[one.distribution].is_determined and name not in found:
            tail = _MATCHED_TAIL if one.distribution == "normal" else 0.0
            found[name] = ShareAxis(name, tail, min(1.0 - tail, _ALMOST_ONE))
    return tuple(found.values())


def with_point(agent: AgentConfiguration, point: SamplePoint) -> AgentConfiguration:
    """The agent whose parameters have the shares of a point; a parameter of fixed value keeps it."""
    if not point.shares:
        return agent
    shares = dict(point.shares)
    return replace(agent, parameters=tuple(_shared(one, shares) for one in agent.parameters))


def _shared(parameter: ParameterConfiguration, shares: Mapping[str, float]) -> ParameterConfiguration:
    share = shares.get(parameter.stream or parameter.name)
    if share is None or parameter.mode != "inter" or DISTRIBUTIONS[parameter.distribution].is_determined:
        return parameter
    return replace(parameter, share=share)


class Unweighted:
    """What samplers without weights have in common."""

    most_weight = 1.0

    def __init__(self, setting: Setting) -> None:
        self._setting = setting


class RandomSampler(Unweighted):
    """Plain random missions: each is drawn from its own seed."""

    def choose(self, trials: Sequence[Trial], count: int) -> list[SamplePoint]:
        """Missions without a choice."""
        return [RANDOM_POINT] * count
