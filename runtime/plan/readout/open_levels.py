"""Open levels: resources whose limits a plan does not keep at all of the times that it leaves open."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import isinf
from typing import Any

from runtime.plan.database import PlanDatabase
from runtime.plan.readout.state import bound_data
from runtime.plan.resources.envelope import Envelope
from runtime.plan.store.domain_texts import wide
from runtime.plan.tags import INITIAL, LIMITS, MAXIMUM, MINIMUM


@dataclass(frozen=True, slots=True)
class LevelUser:
    """A token that may take so much at most from a resource, or give it: the event for which its `rule` asks."""

    resource: str
    token: str
    rule: str
    event: str
    amount: float
    is_taken: bool


@dataclass(frozen=True, slots=True)
class OpenLevel:
    """The first tick `at` which the level of `resource` may get past its `limit`, and how far: to `level`.

    The tick is -inf where nothing bounds the time of the use, the level infinite where nothing bounds its amount.
    `first` is the level before any use; `is_lent`: all that is taken is given back, as of a `Reusable`.
    """

    resource: str
    at: float
    is_low: bool
    limit: float
    level: float
    first: float = 0.0
    is_lent: bool = False

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
    for o in range(len(database.objects.names)):
        if (found := open_level(database, o)) is not None:
            yield found


def open_level(database: PlanDatabase, o: int) -> OpenLevel | None:
    """How far a resource may get past a limit as the plan stands, None where it does not."""
    resources = database.plan.resources
    envelope = Envelope(database.engine, resources)
    if o >= len(resources.is_resource) or not resources.is_resource[o] or not envelope.find(o):
        return None
    is_low = bool(envelope.is_low)
    row = o * LIMITS
    limit = resources.lower(row + MINIMUM, 0.0) if is_low else resources.upper(row + MAXIMUM, 0.0)
    level = limit - envelope.amount if is_low else limit + envelope.amount
    first = resources.lower(row + INITIAL, 0.0) if is_low else resources.upper(row + INITIAL, 0.0)
    is_lent = all(resources.end[u] >= 0 for u in _uses_of(database, o))
    return OpenLevel(database.objects.names[o], wide(envelope.at), is_low, limit, level, first, is_lent)


def level_users(
    database: PlanDatabase, o: int, at: int, is_low: bool, name: Callable[[int], str]
) -> Iterator[LevelUser]:
    """Who may have taken from a resource at a tick, or given to it where it is too full; `name` names a token."""
    resources, rows, predicates = database.plan.resources, database.plan.rows, database.program.predicates
    for u in _uses_of(database, o):
        token, is_taken = resources.token[u], resources.sign[u] < 0
        is_over = resources.end[u] >= 0 and resources.end_high[u] <= at
        if token < 0 or is_taken is not is_low or resources.start_low[u] > at or is_over or resources.most[u] <= 0.0:
            continue
        parent = rows.parent[token]
        asker = parent if parent >= 0 else token
        rule, event = (predicates[rows.predicate[one]].name for one in (asker, token))
        yield LevelUser(database.objects.names[o], name(asker), rule, event, resources.most[u], is_taken)


def _uses_of(database: PlanDatabase, o: int) -> list[int]:
    """The uses that are of a resource."""
    resources = database.plan.resources
    return [u for u in range(resources.count) if resources.sign[u] and resources.on[u] == o]
