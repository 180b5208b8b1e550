"""Parameter space of a mission: its free parameters as axes, missions and chosen values as points."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from checker.batch.result import MissionResult
from checker.conditions.condition import Row
from runtime.executive.chance import sample
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from runtime.executive.distributions import DISTRIBUTIONS

Point = tuple[float, ...]  # a value for each axis


@dataclass(frozen=True, slots=True)
class Range:
    """A free parameter, with the range in which values are tried."""

    parameter: ParameterConfiguration
    lower: float
    upper: float

    @property
    def name(self) -> str:
        """The parameter's."""
        return self.parameter.name

    @property
    def is_redrawn(self) -> bool:
        """Whether a mission draws it more than once."""
        return self.parameter.mode == "intra"

    @property
    def width(self) -> float:
        """How long the range is; never 0."""
        return max(self.upper - self.lower, 1e-9)

    @property
    def choices(self) -> tuple[float, ...] | None:
        """The values, in order, where there are only some; None for numbers."""
        parameter = self.parameter
        return tuple(sorted(set(parameter.values))) if parameter.distribution == "discrete" else None

    def between(self, one: float, other: float, resolution: float) -> float | None:
        """A value amid two; None where they are neighbours, or nearer than `resolution` of the range."""
        if self.choices is not None:
            inside = [value for value in self.choices if min(one, other) < value < max(one, other)]
            return inside[len(inside) // 2] if inside else None
        middle = (one + other) / 2.0
        if self.parameter.is_whole:
            middle = float(round(middle))
            return None if middle in (one, other) else middle
        return None if abs(one - other) <= resolution * self.width else middle

    def at(self, share: float) -> float:
        """The value at a share of the range, from 0 to 1."""
        if self.choices is not None:
            return self.choices[min(int(share * len(self.choices)), len(self.choices) - 1)]
        value = self.lower + share * (self.upper - self.lower)
        return float(round(value)) if self.parameter.is_whole else value

    def has_between(self, below: float, above: float, share: float) -> bool:
        """Whether there are values between two: any where there are steps, else more than a `share` of the range."""
        if self.choices is not None:
            return any(below < value < above for value in self.choices)
        return above - below > (1.0 if self.parameter.is_whole else share * self.width)

    def steps(self, most: int) -> tuple[float, ...]:
        """All its values, in order, where there are `most` at most; else none."""
        if self.choices is not None:
            return self.choices if len(self.choices) <= most else ()
        if not self.parameter.is_whole or self.upper - self.lower >= most:
            return ()
        return tuple(float(value) for value in range(math.ceil(self.lower), math.floor(self.upper) + 1))

    def is_stepped(self) -> bool:
        """Whether between two values there need be no third."""
        return self.parameter.is_whole or self.choices is not None


class Space:
    """The free parameters of an agent; without `redrawn` those alone that are drawn once a mission."""

    def __init__(self, agent: AgentConfiguration, results: Sequence[MissionResult], *, redrawn: bool = True) -> None:
        self.agent = agent
        free = [one for one in agent.parameters if not DISTRIBUTIONS[one.distribution].is_determined]
        drawn = {draw.parameter for result in results if result.outcome for draw in result.outcome.draws}
        self.parameters = tuple(
            _axis(one, results) for one in free if one.name in drawn and (redrawn or one.mode == "inter")
        )
        self.names = tuple(axis.name for axis in self.parameters)
        self.has_redrawn = any(axis.is_redrawn for axis in self.parameters)

    def row(self, result: MissionResult) -> Row | None:
        """What a mission drew; of a parameter that it did not need, what it would have drawn."""
        if result.outcome is None:
            return None
        spans: dict[str, tuple[float, float]] = {}
        for axis in self.parameters:
            values = [draw.value for draw in result.outcome.draws if draw.parameter == axis.name]
            values = values or [sample(axis.parameter, result.seed, 0).value]
            spans[axis.name] = (min(values), max(values))
        return spans

    def drawn(self, seed: int) -> Row:
        """What a mission with `seed` draws first."""
        values = [(axis.name, sample(axis.parameter, seed, 0).value) for axis in self.parameters]
        return {name: (value, value) for name, value in values}

    def point(self, row: Row) -> Point:
        """A row as a point; of a redrawn parameter its greatest draw."""
        return tuple(row[name][1] for name in self.names)

    def as_row(self, point: Point) -> Row:
        """A point as a row."""
        return {name: (value, value) for name, value in zip(self.names, point, strict=True)}

    def agent_at(self, point: Point) -> AgentConfiguration:
        """The agent with every free parameter fixed."""
        return fixed(self.agent, dict(zip(self.names, point, strict=True)))


def fixed(agent: AgentConfiguration, values: Mapping[str, float]) -> AgentConfiguration:
    """The agent with some parameters fixed to values."""
    parameters = tuple(
        replace(one, distribution="fixed", mode="inter", values=(values[one.name],), weights=(), clip=None, share=None)
        if one.name in values
        else one
        for one in agent.parameters
    )
    return replace(agent, parameters=parameters)


def _axis(parameter: ParameterConfiguration, results: Sequence[MissionResult]) -> Range:
    """An axis over the range of a parameter and all that was drawn of it."""
    values = [parameter.lower, parameter.upper] if parameter.distribution != "discrete" else list(parameter.values)
    for result in results:
        draws = result.outcome.draws if result.outcome else ()
        values += [draw.value for draw in draws if draw.parameter == parameter.name]
    if parameter.clip is not None:
        values = [min(max(value, parameter.clip[0]), parameter.clip[1]) for value in values]
    values = [value for value in values if math.isfinite(value)] or [0.0]
    return Range(parameter, min(values), max(values))
