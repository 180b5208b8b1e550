"""What an explanation is made of: edges, constraints and restrictions, with where they come from."""

from dataclasses import dataclass
from enum import Enum


class CauseKind(Enum):
    """What holds a bound in the end."""

    EDGE = "edge"
    CONSTRAINT = "constraint"
    RESTRICTION = "restriction"


@dataclass(frozen=True, slots=True)
class Cause:
    """One edge, constraint or restriction: its id, the span it was written at, the token whose rule posted it."""

    kind: CauseKind
    id: int
    span: int
    owner: int


@dataclass(frozen=True, slots=True)
class Link:
    """One step of a chain: `cause` holds this side of `variable` at `value`."""

    cause: Cause
    variable: int
    side: int
    value: float
