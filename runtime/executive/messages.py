"""What reactors tell each other: observations, requests and recalls, as plain data."""

from dataclasses import dataclass
from typing import NamedTuple

from compiler.program import DomainConstant

make_tuple = tuple.__new__  # a named tuple in a tenth of the time that its class takes: reactors tell thousands
Arguments = tuple[tuple[str, DomainConstant], ...]  # parameter name and what is known of it, in declared order


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
