"""What a mission leaves behind: its events, the values it drew, and why it ended, as plain data.

Everything here is picklable and free of engine ids, so that workers can send it and a store can keep it.
Two runs of one mission give equal outcomes, in either form of the engine and on any machine.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Place:
    """Where in the model something stands: file as the model was named, line and column from 1, and the text."""

    file: str
    line: int
    column: int
    text: str


@dataclass(frozen=True, slots=True)
class Event:
    """One thing that happened.

    `phase` is start, observe, synchronise, repair, deliberate, dispatch or end; `kind` is observation, request,
    recall, reject, relax, sample, kill, abort or end. `text` is canonical: `Predicate(name=value, ...)` for tokens.
    `causes` are indices of earlier events of the same trace. Within a tick events are in the order they happened,
    which is deterministic.
    """

    tick: int
    phase: str
    kind: str
    reactor: str
    timeline: str
    text: str
    causes: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Draw:
    """A sampled value: `raw` as drawn, `value` after the clip policy, in force from `tick` on."""

    parameter: str
    tick: int
    raw: float
    value: float


@dataclass(frozen=True, slots=True)
class Term:
    """One constraint of a conflict, for a judge that knows nothing of the engine.

    `name` is a row of the constraint table (`eq`, `mulEq`, `leq`, ...), `precedence` (arguments source, target,
    bound: target - source <= bound), or `bounds` (arguments variable, lower, upper: a base domain).
    Arguments are variable names or numbers. A `sampledParameter` term has the variable, the parameter name and
    the value drawn.
    """

    name: str
    arguments: tuple[str | float | int, ...]


@dataclass(frozen=True, slots=True)
class Cause:
    """One element of a conflict: what was posted, by which rule for which token, and where that is written.

    `kind` is relation, constraint, sample, duration, order, merge, assignment, declaration, observation, clock,
    horizon or model. `token` names the token whose rule posted it (`Gps.Active#7`), empty for the script.
    `because` says in words what the element did (`duration <= 31`).
    """

    kind: str
    place: Place | None
    rule: str
    token: str
    because: str
    terms: tuple[Term, ...]


@dataclass(frozen=True, slots=True)
class VariableInfo:
    """A variable that the terms of a conflict name: its kind (int, float, bool, symbol, object) and owner token."""

    name: str
    kind: str


@dataclass(frozen=True, slots=True)
class Conflict:
    """A minimal set of causes that cannot hold together, in the order in which the story is told."""

    causes: tuple[Cause, ...]
    variables: tuple[VariableInfo, ...]


@dataclass(frozen=True, slots=True)
class Abort:
    """Why an agent stopped early. `code` is F1 to F11 of the failure taxonomy (reference of T-REX, 1.11).

    `conflict` is what broke first; `repairs` are the conflicts that stopped each repair stage after it.
    """

    code: str
    tick: int
    reactor: str
    timelines: tuple[str, ...]
    summary: str
    conflict: Conflict | None
    relaxes: int
    event: int  # index of the abort event in the trace
    repairs: tuple[Conflict, ...] = ()


@dataclass(frozen=True, slots=True)
class Outcome:
    """A finished mission. `final_tick` is where it was to end, `last_tick` where it ended."""

    seed: int
    last_tick: int
    final_tick: int
    abort: Abort | None
    draws: tuple[Draw, ...]
    events: tuple[Event, ...]
    unmet_goals: tuple[str, ...]

    @property
    def ended_early(self) -> bool:
        """The founding paper's oracle: premature end means a fault (section 4)."""
        return self.abort is not None or self.last_tick < self.final_tick
