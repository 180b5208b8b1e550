"""The box of a mission: a range, or a list of values, for each sampled parameter; its points and its claim for z3."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

import numpy as np
import z3

from checker.proofs.claims import Claim, Number
from checker.proofs.operands import decimal, rational
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration

Point = dict[str, float]


@dataclass(frozen=True, eq=False, slots=True)
class Box:
    """The parameters that are free, by name, and those that are computed from others."""

    sides: Mapping[str, ParameterConfiguration]
    computed: tuple[str, ...]

    def endless(self) -> list[str]:
        """The parameters that are drawn outside of the box too: of a distribution without ends, not clipped to it."""
        return [
            name
            for name, side in self.sides.items()
            if side.distribution == "normal"
            and not (side.clip and side.lower <= side.clip[0] and side.clip[1] <= side.upper)
        ]

    def middle(self) -> Point:
        """The point in the middle."""
        return {name: self._at(side, 0.5) for name, side in self.sides.items()}

    def corners(self) -> Iterator[Point]:
        """All corners."""
        names = list(self.sides)
        for ends in product((0.0, 1.0), repeat=len(names)):
            yield {name: self._at(self.sides[name], end) for name, end in zip(names, ends, strict=True)}

    def drawn(self, count: int, seed: int) -> Iterator[Point]:
        """Points drawn evenly."""
        chance = np.random.default_rng(seed)
        for _ in range(count):
            yield {name: self._at(side, float(chance.random())) for name, side in self.sides.items()}

    def _at(self, side: ParameterConfiguration, share: float) -> float:
        if side.distribution in ("discrete", "fixed"):
            values = sorted(set(side.values))
            return values[min(int(share * len(values)), len(values) - 1)]
        lower, upper = _range(side)
        value = lower + share * (upper - lower)
        return float(round(value)) if side.is_whole else min(max(value, lower), upper)

    def claim(self, name: str, value: Number) -> Claim:
        """That a value of a parameter lies in the box."""
        side = self.sides[name]
        if side.distribution in ("discrete", "fixed"):
            values = side.values if side.distribution == "discrete" else side.values[:1]
            return z3.Or(*[value == rational(each) for each in sorted(set(values))])
        lower, upper = _range(side)
        within = z3.And(value >= rational(lower), value <= rational(upper))
        return z3.And(within, z3.IsInt(value)) if side.is_whole else within

    def range(self, name: str) -> tuple[Fraction, Fraction]:
        """The least and the greatest value of a parameter."""
        return decimal(self._at(self.sides[name], 0.0)), decimal(self._at(self.sides[name], 1.0))

    def ends(self, name: str, value: Number) -> Claim:
        """That a value is at one of the two ends."""
        return z3.Or(*[value == rational(self._at(self.sides[name], share)) for share in (0.0, 1.0)])

    def nearest(self, name: str, value: Fraction) -> float:
        """A value of z3 as a double that lies in the box."""
        side = self.sides[name]
        if side.distribution in ("discrete", "fixed"):
            return float(value)
        lower, upper = _range(side)
        return min(max(float(value), lower), upper)


def box_of(agent: AgentConfiguration) -> Box:
    """The box of a mission file."""
    free = {each.name: each for each in agent.parameters if not each.expression}
    return Box(free, tuple(each.name for each in agent.parameters if each.expression))


def _range(side: ParameterConfiguration) -> tuple[float, float]:
    lower, upper = side.lower, side.upper
    if side.clip is not None:
        lower, upper = max(lower, side.clip[0]), min(upper, side.clip[1])
    return lower, upper
