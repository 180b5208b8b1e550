"""What reactors tell each other: observations, requests and recalls, as plain data."""

from dataclasses import dataclass
from typing import Any, NamedTuple

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


class Observation(NamedTuple):
    """The owner's word that from `tick` on `timeline` holds `predicate`; it holds until replaced (T-REX 1.6).

    `event` is its index in the trace; `owner`, `token` and `token_key` name the owner's token.
    """

    tick: int
    timeline: str
    predicate: str
    arguments: Arguments
    event: int
    owner: str = ""
    token: int = -1
    token_key: int = -1


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
