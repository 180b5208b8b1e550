"""Condition: a disjunction of conjunctions of literals over the draws of a mission, with its measured quality."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

from checker.statistics import Interval

# A condition of less precision or recall is marked as partial: one of 0.95 is not, and figures are those of a sample.
_PARTIAL_BELOW = 0.97
_TELLING = 59  # missions of which one in twenty that were otherwise would have shown itself, 19 times of 20
Span = tuple[float, float]  # the least and the greatest draw of a parameter; twice the same of one drawn once
Row = Mapping[str, Span]  # what one mission drew, by parameter


class Extreme(StrEnum):
    """Which draw of a redrawn parameter a literal is about."""

    ONLY = "only"  # it is drawn once a mission
    GREATEST = "greatest"
    LEAST = "least"


@dataclass(frozen=True, slots=True)
class Feature:
    """A polynomial of draws: the sum of `coefficient` times the product of parameters to powers.

    Powers may be negative. Of a parameter that is redrawn, the feature is the greatest or the least draw.
    """

    monomials: tuple[tuple[float, tuple[tuple[str, int], ...]], ...]
    extreme: Extreme = Extreme.ONLY

    @property
    def parameters(self) -> tuple[str, ...]:
        """The parameters that it speaks of."""
        return tuple(dict.fromkeys(name for _, powers in self.monomials for name, _ in powers))

    def value(self, row: Row) -> float:
        """Its value for one mission; nan where a quotient has no value."""
        end = 0 if self.extreme is Extreme.LEAST else 1
        total = 0.0
        for coefficient, powers in self.monomials:
            product = coefficient
            for name, power in powers:
                factor = row[name][end]
                if factor == 0.0 and power < 0:
                    return float("nan")
                product *= factor**power
            total += product
        return total


@dataclass(frozen=True, slots=True)
class Literal:
    """A feature on one side of an edge; `holds_at_edge` tells whether the edge itself belongs to that side."""

    feature: Feature
    is_above: bool
    edge: float
    holds_at_edge: bool = False

    def holds(self, row: Row) -> bool:
        """Whether it is true of a mission."""
        value = self.feature.value(row)
        if value == self.edge:
            return self.holds_at_edge
        return value > self.edge if self.is_above else value < self.edge

    @property
    def negation(self) -> "Literal":
        """The other side."""
        return Literal(self.feature, not self.is_above, self.edge, not self.holds_at_edge)


Conjunction = tuple[Literal, ...]


@dataclass(frozen=True, slots=True)
class Share:
    """An estimated share with its exact or conservative interval."""

    value: float
    interval: Interval


@dataclass(frozen=True, slots=True)
class Unseen:
    """No mission is known with a feature between `below`, which is on one side of an edge, and `above` on the other."""

    feature: Feature
    below: float
    above: float


@dataclass(frozen=True, slots=True)
class Condition:
    """Missions fail when one of the conjunctions holds.

    `precision` is the share of missions that fail among those for which it holds, `recall` the share of the bucket's
    missions for which it holds; both measured on `fresh` missions that were not used to find it (`near` of them close
    to an edge), or, where none could be flown, on missions of the run that were held back (`near` None).
    """

    conjunctions: tuple[Conjunction, ...]
    precision: Share
    recall: Share
    fresh: int
    near: int | None
    flights: int
    unseen: tuple[Unseen, ...] = ()  # where its edges lie, where that is known no better
    in_terms: tuple[Literal, ...] = ()  # edges at which z3 finds the terms of the example's conflict to begin

    @property
    def is_partial(self) -> bool:
        """Whether it may leave out, or take in, more than a twentieth."""
        return min(self.precision.value, self.recall.value) < _PARTIAL_BELOW

    @property
    def is_thin(self) -> bool:
        """Whether it was tried on too few missions to say that no more than one in twenty is otherwise."""
        return self.fresh < _TELLING

    @property
    def parameters(self) -> tuple[str, ...]:
        """The parameters that it speaks of."""
        literals = [literal for conjunction in self.conjunctions for literal in conjunction]
        return tuple(dict.fromkeys(name for literal in literals for name in literal.feature.parameters))

    @property
    def single(self) -> tuple[Literal, ...]:
        """The literals about one parameter alone."""
        literals = [literal for conjunction in self.conjunctions for literal in conjunction]
        return tuple(one for one in dict.fromkeys(literals) if one.feature == axis_feature(one.feature.parameters[0]))


def axis_feature(name: str, extreme: Extreme = Extreme.ONLY) -> Feature:
    """The draw of one parameter."""
    return Feature(((1.0, ((name, 1),)),), extreme)


def holds(conjunctions: Sequence[Conjunction], row: Row) -> bool:
    """Whether a mission satisfies the condition."""
    return any(all(literal.holds(row) for literal in conjunction) for conjunction in conjunctions)
