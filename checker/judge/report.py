"""What a judge says of a mission: disagreements as typed data, and how much could not be judged."""

from dataclasses import dataclass
from typing import Literal

from nddl_lang.text.source import Span
from runtime.executive.record import Value

Kind = Literal[
    "constraint",  # of a rule, a predicate or the script: arguments do not satisfy it
    "relation",  # between two tokens
    "guard",  # the other branch ran, or none
    "child",  # a token that a rule asks for is missing, or another one
    "domain",  # a value outside of what its declaration allows
    "merge",  # a token stands for another, and they differ
    "duration",  # start, duration and end do not agree
    "overlap",  # two tokens of a timeline at once
    "gap",  # nothing held on a timeline
    "level",  # of a resource
    "observation",  # what a reactor holds is not what the owner published
    "draw",  # not the value of seed, name and index
    "goal",  # counted as achieved, and was not
]


@dataclass(frozen=True, slots=True)
class Disagreement:
    """One thing that the executive holds true and the judge does not.

    `name` is the constraint, relation, member, timeline or parameter; `values` names what it was judged on;
    `held` is the executive's side, `found` the judge's. Tokens are named as in reports, `Gps.Active#7`.
    """

    kind: Kind
    reactor: str
    name: str
    tokens: tuple[str, ...]
    values: tuple[tuple[str, Value], ...]
    held: str
    found: str
    span: Span | None = None
    is_breach: bool = False  # the execution broke a rule that the executive had given up


@dataclass(frozen=True, slots=True)
class ResourceProfile:
    """The level of a resource over a mission, from each tick on until the next; `least` and `most` are its limits."""

    reactor: str
    resource: str
    least: float
    most: float
    levels: tuple[tuple[int, float], ...]


@dataclass(frozen=True, slots=True)
class JudgeReport:
    """The judgement of one mission: `judged` checks were decided, `open` ones left by values that were never fixed.

    `skipped` counts, by reason, what the judge does not judge.
    """

    disagreements: tuple[Disagreement, ...]
    judged: int
    open: int
    skipped: tuple[tuple[str, int], ...]
    profiles: tuple[ResourceProfile, ...] = ()

    @property
    def holds(self) -> bool:
        """Whether the judge agrees with the executive."""
        return not self.disagreements

    @property
    def errors(self) -> tuple[Disagreement, ...]:
        """Where the executive is wrong about its own plan."""
        return tuple(one for one in self.disagreements if not one.is_breach)

    @property
    def breaches(self) -> tuple[Disagreement, ...]:
        """What was executed against the model, though the mission came to its end."""
        return tuple(one for one in self.disagreements if one.is_breach)
