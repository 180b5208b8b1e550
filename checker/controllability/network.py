"""A simple temporal network with uncertainty (STNU): requirement edges, and contingent links of the vehicle."""

from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class RequirementEdge:
    """`later - earlier <= weight`; `why` is whatever the caller tells it by."""

    earlier: int
    later: int
    weight: int
    why: object = None


@dataclass(frozen=True, slots=True)
class ContingentLink:
    """Once `start` has happened, `end` follows after `lower` to `upper` ticks; nobody chooses. 0 < lower <= upper."""

    start: int
    end: int
    lower: int
    upper: int
    why: object = None


@dataclass(frozen=True, eq=False, slots=True)
class UncertainNetwork:
    """Time points 0 to `points` - 1. Each is the end of one link at most."""

    points: int
    edges: list[RequirementEdge] = field(default_factory=list)
    links: list[ContingentLink] = field(default_factory=list)

    def between(self, earlier: int, later: int, lower: int | None, upper: int | None, why: object = None) -> None:
        """Demand `lower <= later - earlier <= upper`; None is no bound."""
        if upper is not None:
            self.edges.append(RequirementEdge(earlier, later, upper, why))
        if lower is not None:
            self.edges.append(RequirementEdge(later, earlier, -lower, why))
