"""What reactors tell each other: observations, requests and recalls, as plain data."""

from dataclasses import dataclass
from typing import Any, Protocol

from compiler.program import DomainConstant

make_tuple = tuple.__new__  # a named tuple in a tenth of the time that its class takes: reactors tell thousands
Arguments = tuple[tuple[str, DomainConstant], ...]  # parameter name and what is known of it, in declared order


def draft_of(frozen: type) -> Any:
    """A class with the slots of a frozen one: what is made of it becomes frozen by its `__class__`.

    Each field that a frozen class sets in its `__init__` costs a call, and a mission makes thousands of such values.
    """
    return type(f"{frozen.__name__}Draft", (), {"__slots__": frozen.__slots__})  # type: ignore[attr-defined]


_Domain = draft_of(DomainConstant)


def make_domain(
    kind: str,
    type_name: str,
    interval: tuple[float | int, float | int] | None,
    values: tuple[float | int | bool | str, ...] | None,
) -> DomainConstant:
    """A domain in a quarter of the time that its class takes."""
    domain = _Domain()
    domain.kind = kind
    domain.type_name = type_name
    domain.interval = interval
    domain.values = values
    domain.__class__ = DomainConstant
    return domain  # type: ignore[no-any-return]


class ArgumentSource(Protocol):
    """Who keeps arguments as numbers, for most observations are never asked for them."""

    def arguments_of(self, token: int) -> Arguments:
        """The arguments of a token."""

    def values_of(self, token: int) -> list[Any]:
        """The value of each argument; two infinite bounds where it was never fixed."""

    def shapes_of(self, token: int) -> list[tuple[Any, ...]]:
        """Name and kind of each argument, and more; the same list for all tokens of a predicate."""


class Observation:
    """The owner's word that from `tick` on `timeline` holds `predicate`; it holds until replaced (T-REX 1.6).

    `event` is its index in the trace; `owner`, `token` and `token_key` name the owner's token. Nobody changes it.
    What its `source` keeps is read when it is asked for.
    """

    def __init__(
        self,
        tick: int,
        timeline: str,
        predicate: str,
        arguments: Arguments,
        event: int,
        owner: str = "",
        token: int = -1,
        token_key: int = -1,
    ) -> None:
        self.tick = tick
        self.timeline = timeline
        self.predicate = predicate
        self.given: Arguments | None = arguments
        self.source: ArgumentSource | None = None
        self.event = event
        self.owner = owner
        self.token = token
        self.token_key = token_key

    @property
    def arguments(self) -> Arguments:
        """The parameters by their names, and what is known of each."""
        if self.given is None:
            assert self.source is not None
            self.given = self.source.arguments_of(self.token)
        return self.given


def make_observation(
    tick: int,
    timeline: str,
    predicate: str,
    source: ArgumentSource,
    event: int,
    owner: str,
    token: int,
    token_key: int,
) -> Observation:
    """An observation in a fraction of the time that its class takes; its `source` keeps the arguments."""
    told = Observation.__new__(Observation)
    told.tick = tick
    told.timeline = timeline
    told.predicate = predicate
    told.given = None
    told.source = source
    told.event = event
    told.owner = owner
    told.token = token
    told.token_key = token_key
    return told


@dataclass(frozen=True, slots=True)
class Request:
    """A token on another reactor's timeline that a user or a reactor asks the owner for (T-REX 1.8).

    Bounds are ticks; infinite ones are ±(2**52 - 1). `sender` is empty for a goal of the mission file, of
    which the first has the number -1, the second -2, and so on.
    """

    number: int
    timeline: str
    predicate: str
    arguments: Arguments
    start: tuple[int, int]
    end: tuple[int, int]
    duration: tuple[int, int]
    sender: str
    event: int
    is_mandatory: bool = False
