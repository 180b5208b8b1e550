"""A mission as data: what the second agent flies, and what is written as NDDL and TOML for nddlc."""

from dataclasses import dataclass
from typing import Literal

FAR = 100_000  # beyond every time and number of these missions

Relation = Literal[
    "any", "meets", "met_by", "before", "after", "equals", "contains", "contained_by", "starts", "ends", "starts_during"
]  # fmt: skip


@dataclass(frozen=True, slots=True)
class Bound:
    """A term of the rule's own token lies in a range; terms are `start`, `end`, `duration` and parameters."""

    term: str
    low: int = -FAR
    high: int = FAR


@dataclass(frozen=True, slots=True)
class Drawn:
    """A term of the rule's own token is a sampled parameter, rounded as the mission file says."""

    term: str
    parameter: str


@dataclass(frozen=True, slots=True)
class Tie:
    """A term of a child less a term of its parent (of nothing: zero) lies in a range."""

    term: str
    of_parent: str = ""
    low: int = 0
    high: int = 0


@dataclass(frozen=True, slots=True)
class Child:
    """What a rule asks for."""

    relation: Relation
    timeline: str
    predicate: str
    label: str
    ties: tuple[Tie, ...] = ()


@dataclass(frozen=True, slots=True)
class Between:
    """A relation of two children of one rule."""

    first: str
    relation: Relation
    second: str


@dataclass(frozen=True, slots=True)
class Apart:
    """A term less another, of the token or of its children (`a.start`), lies in a range."""

    term: str
    other: str
    low: int = -FAR
    high: int = FAR


@dataclass(frozen=True, slots=True)
class Guarded:
    """What is asked for where a parameter of the token has a value, or once the token has begun (no parameter)."""

    parameter: str
    value: int
    body: tuple["Item", ...]


@dataclass(frozen=True, slots=True)
class Use:
    """The level of a store changes by an amount at the start or the end of the rule's token, or as long as it lasts."""

    store: str
    amount: int
    when: Literal["start", "end", "all"]


Item = Bound | Drawn | Child | Between | Apart | Guarded | Use


@dataclass(frozen=True, slots=True)
class Rule:
    """What must accompany a token of one predicate."""

    timeline: str
    predicate: str
    body: tuple[Item, ...]


@dataclass(frozen=True, slots=True)
class Kind:
    """A class with its one timeline: predicates with their integer parameters; the first predicate is the default."""

    timeline: str
    predicates: tuple[tuple[str, tuple[str, ...]], ...]

    @property
    def name(self) -> str:
        """The class."""
        return self.timeline.capitalize()

    def parameters(self, predicate: str) -> tuple[str, ...] | None:
        """Those of a predicate; None if there is no such predicate."""
        return () if predicate in ("undefined", "Failed") else dict(self.predicates).get(predicate)


@dataclass(frozen=True, slots=True)
class First:
    """What holds at tick 0, as a fact of the model."""

    timeline: str
    predicate: str
    arguments: tuple[tuple[str, int], ...] = ()


@dataclass(frozen=True, slots=True)
class Store:
    """A resource of one reactor's model: a `Reservoir`, or a `Reusable`, whose first level is its capacity."""

    name: str
    kind: Literal["Reservoir", "Reusable"]
    first: int
    least: int
    most: int


@dataclass(frozen=True, slots=True)
class Part:
    """A reactor."""

    name: str
    latency: int
    lookahead: int
    internal: tuple[str, ...]
    external: tuple[str, ...] = ()
    observed: tuple[str, ...] = ()  # of others, never asked
    rules: tuple[Rule, ...] = ()
    firsts: tuple[First, ...] = ()
    lacks: tuple[tuple[str, str], ...] = ()  # predicates that its class does not have
    ranges: tuple[tuple[str, str, str, int, int], ...] = ()  # of parameters: timeline, predicate, name, bounds
    early: tuple[str, ...] = ()
    late: tuple[str, ...] = ()
    stores: tuple[Store, ...] = ()
    orders: bool = False  # its solver's table has uses of stores ordered
    first: tuple[str, ...] = ()  # predicates of goals that its solver's table has decided in this order


@dataclass(frozen=True, slots=True)
class Wish:
    """A goal of the mission file."""

    timeline: str
    predicate: str
    arguments: tuple[tuple[str, int], ...]
    start: tuple[int, int]
    duration: tuple[int, int] | None = None
    at: int = 0
    mandatory: bool = False
    recall: int | None = None


@dataclass(frozen=True, slots=True)
class Parameter:
    """A sampled parameter of whole numbers; redrawn every `update` ticks, or once a mission (0)."""

    name: str
    values: tuple[int, ...]
    update: int = 0


@dataclass(frozen=True, slots=True)
class Description:
    """A mission."""

    name: str
    final: int
    kinds: tuple[Kind, ...]
    parts: tuple[Part, ...]
    wishes: tuple[Wish, ...] = ()
    parameters: tuple[Parameter, ...] = ()
    kills: bool = False  # a reactor that fails is killed; the agent goes on

    def kind(self, timeline: str) -> Kind:
        """The class of a timeline."""
        return next(kind for kind in self.kinds if kind.timeline == timeline)
