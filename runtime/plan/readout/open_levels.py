"""Open levels: resources whose limits a plan does not keep at all of the times that it leaves open."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import isinf
from typing import Any

from runtime.plan.database import PlanDatabase
from runtime.plan.readout.state import bound_data
from runtime.plan.resources.envelope import Envelope
from runtime.plan.store.domain_texts import wide
from runtime.plan.tags import LIMITS, MAXIMUM, MINIMUM


@dataclass(frozen=True, slots=True)
class OpenLevel:
    """The first tick `at` which the level of `resource` may get past its `limit`, and how far: to `level`.

    The tick is -inf where nothing bounds the time of the use, the level infinite where nothing bounds its amount.
    """

    resource: str
    at: float
    is_low: bool
    limit: float
    level: float

    def as_data(self) -> dict[str, Any]:
        """The same for programs."""
        side = "minimum" if self.is_low else "maximum"
        return {
            "resource": self.resource,
            "tick": bound_data(self.at),
            side: self.limit,
            "level": bound_data(self.level),
        }

    def text(self) -> str:
        """One clause for people."""
        way = "fall" if self.is_low else "rise"
        when = "at any tick" if isinf(self.at) else f"at tick {self.at}"
        return f"the level of {self.resource} may {way} to {self.level:g} {when} (limit {self.limit:g})"


def open_levels(database: PlanDatabase) -> Iterator[OpenLevel]:
    """The resources that may get past a limit as the plan stands, those of one name once (Muscettola 2002)."""
    resources = database.plan.resources
    envelope = Envelope(database.engine, resources)
    for o, name in enumerate(database.objects.names):
        if o < len(resources.is_resource) and resources.is_resource[o] and envelope.find(o):
            is_low = bool(envelope.is_low)
            row = o * LIMITS
            limit = resources.lower(row + MINIMUM, 0.0) if is_low else resources.upper(row + MAXIMUM, 0.0)
            level = limit - envelope.amount if is_low else limit + envelope.amount
            yield OpenLevel(name, wide(envelope.at), is_low, limit, level)
