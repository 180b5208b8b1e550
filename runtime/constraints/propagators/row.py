"""The row of a constraint in the registry, and the words that its columns use."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import EVENT_DOMAIN, PRIORITY_CHEAP
from runtime.constraints.propagators.arguments import Arguments

# What a propagator read when it narrowed one side of an argument (`explanation/reasons.py` walks back by it).
READS_ALL = 0  # all bounds and holes of the other arguments
READS_SAME_SIDE = 1  # the same side of the others; for a hole all
READS_SUM_LAST = 2  # a sum whose total stands last: the side of total and terms that it adds
READS_SUM_FIRST = 3
READS_DISTANCE = 4  # the end of the edge that the distance stretches
# Whether READS_ALL includes the bounds of the narrowed argument itself.
OWN_ALWAYS = 0
OWN_NEVER = 1
OWN_AT_ONE = 2  # where a whole number steps over 0

# When compiled code calls the registry's function.
CALLED_NEVER = 0
CALLED_RELATIONAL = 1  # in a relational engine, instead of the compiled propagator
CALLED_BESIDE = 2  # in a relational engine, before the compiled propagator
CALLED_ALWAYS = 3


class Algebra(Protocol):
    """What claims need beside the operators of numbers: numbers and truths may be z3's, or plain ones."""

    def every(self, claims: Sequence[Any]) -> Any:
        """All claims hold."""

    def some(self, claims: Sequence[Any]) -> Any:
        """One of the claims holds."""

    def choose(self, claim: Any, x: Any, y: Any) -> Any:
        """Give x where the claim holds, else y."""

    def floor(self, x: Any) -> Any:
        """Round down."""

    def real(self, x: Any) -> Any:
        """Take a whole number for a real one."""

    def is_whole(self, x: Any) -> bool:
        """Tell whether a number is whole by its type."""


Claim = Callable[[Algebra, Sequence[Any]], Any]
Propagate = Callable[[Store, int], bool]
Relation = Callable[[Arguments], bool]


@dataclass(frozen=True, slots=True)
class Propagator:
    """One constraint of the engine."""

    op: int
    names: str = ""  # in NDDL, then other names of the same in NDDL, EUROPA or T-REX
    arguments: str = ""  # in the order of `post`; a star: any number of them
    claim: Claim | None = None  # what it demands, exactly; None where no algebra of numbers says it
    infix: str = ""  # how a modeler writes it, by the indices of the arguments, where they are as many
    shown: str = ""  # the name in messages, where it differs from the first of the names
    # Propagation.
    propagate: Propagate | None = None  # None: by the compiled file of its family
    wakes: tuple[int, int] = (EVENT_DOMAIN, EVENT_DOMAIN)  # the events of the first argument, and of the others
    wakes_beside_edges: int = 0  # the events that wake it where temporal edges carry it out
    priority: int = PRIORITY_CHEAP
    edges_up_to: int = 0  # edges carry it out among so many ints, at most
    idempotent_up_to: int = 0  # with so many whole arguments, at most, one run reaches its fixpoint
    posted_as: int = -1  # another constraint, whose result stands first
    # Explanation.
    reads: int = READS_ALL
    reads_own: int = OWN_ALWAYS
    # EUROPA's functions act on known arguments; minimisation goes by what they mean for intervals.
    waits: bool = False
    relation: Relation | None = None  # narrows intervals at once, in a relational engine
    is_beside: bool = False  # the relation adds to the compiled propagator, instead of replacing it
    twin: int = -1  # the constraint that says the same and narrows intervals at once
    is_of_domains: bool = False  # it speaks of domains, so that trying values tells nothing

    @property
    def name(self) -> str:
        """The name in messages."""
        return self.shown or self.names.partition(" ")[0]
