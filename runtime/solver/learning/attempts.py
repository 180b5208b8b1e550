"""What a search tried and why it failed, as data without ids of the engine."""

from dataclasses import dataclass
from enum import Enum

from nddl_lang.text.source import Span
from runtime.plan.readout.open_levels import LevelUser, OpenLevel
from runtime.plan.readout.statements import ResourceTerm, Term
from runtime.plan.tags import NONE


class CauseOrigin(Enum):
    """How a cause comes about that has no source place; an implied one follows from the others."""

    DECLARED = "declared"
    DECIDED = "decided"
    IMPLIED = "so"


@dataclass(frozen=True, slots=True)
class FoundCause:
    """One cause of a failure: where the model says it (None: nowhere), for which token's rule (empty: the script)."""

    span: Span | None
    owner: str
    term: Term | ResourceTerm
    origin: CauseOrigin = CauseOrigin.DECIDED
    number: int = NONE  # of the span; others than NONE below 0 tell the reasons of who posts without a source


class ResolverKind(Enum):
    """What a resolver does with the names it comes with."""

    PROPAGATE = "nothing is decided yet"
    MERGE = "the token to merge with"
    ACTIVATE = "no name"
    SUPPORT = "the predicate of the action"
    REJECT = "no name: reject"
    SPECIFY = "the value"
    INSERT_ONLY = "the timeline"
    INSERT_BEFORE = "the timeline, the next token"
    INSERT_AFTER = "the timeline, the token before"
    PRECEDE = "two timepoints, the earlier one first"


@dataclass(frozen=True, slots=True)
class Resolver:
    """A resolver that was tried."""

    kind: ResolverKind
    names: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Flaw:
    """What was to be mended: the kind of flaw (NONE: the model itself), the token, variable or resource.

    An open condition has a predicate, too; of a resource, `at` is the instant, `level` how far it may get past a limit
    then, by which `users`.
    """

    kind: int
    name: str = ""
    predicate: str = ""
    at: int = 0
    level: OpenLevel | None = None
    users: tuple[LevelUser, ...] = ()


@dataclass(frozen=True, slots=True)
class Attempt:
    """A resolver that failed: by a conflict of `causes`, or because no resolver mends what it leads to.

    `told` belongs to the conflict too: declarations that its violated resource tells in words.
    """

    resolver: Resolver
    causes: tuple[FoundCause, ...]
    dead_end: "FailedFlaw | None" = None
    told: tuple[FoundCause, ...] = ()


@dataclass(frozen=True, slots=True)
class FailedFlaw:
    """A flaw that no resolver mends."""

    flaw: Flaw
    attempts: tuple[Attempt, ...]
