# cython: binding=True
"""Reactors that users write in Python: subclass `Reactor`, and say in `tick` what holds and what is asked for."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

Value = int | float | bool | str
Argument = Value | tuple[float, float] | frozenset[Value]
Ticks = int | tuple[int, int] | None


class Seen(NamedTuple):
    """What holds on a timeline since tick `since`; of an argument that is not known, its two bounds or its values."""

    predicate: str
    arguments: Mapping[str, Argument]
    since: int


@dataclass(frozen=True, slots=True)
class Published:
    """A value that begins to hold."""

    timeline: str
    predicate: str
    arguments: Mapping[str, Argument]


@dataclass(frozen=True, slots=True)
class Asked:
    """A token that the owner of a timeline is asked for; bounds of its times in ticks."""

    number: int
    timeline: str
    predicate: str
    arguments: Mapping[str, Argument]
    start: Ticks = None
    end: Ticks = None
    duration: Ticks = None


class Command(NamedTuple):
    """A token that this reactor was asked for on a timeline of its own, and that has not begun.

    It is to begin in `start`, to take a time in `duration` and to end in `end`: pairs of ticks, ±(2**52 - 1) for none.
    Who looks ahead by 1 or less is told when to begin, and has its own way with the rest.
    """

    number: int
    timeline: str
    predicate: str
    arguments: Mapping[str, Argument]
    start: tuple[int, int]
    duration: tuple[int, int]
    end: tuple[int, int]


class Turn(NamedTuple):
    """How much others do in the deliberation of a tick before what is asked and recalled from these places on."""

    others: int
    asked: int
    recalled: int


class Now:
    """One tick, as a reactor sees it and speaks in it.

    `seen` has what holds, by timeline, of those that it uses; `news` the timelines that have begun to hold something at
    this tick, `refused` the numbers of what owners will not do. `commands` wait to begin, the earliest first; what is
    `taken_back` by number, or too late, is not among them any more, or, if it has begun, may be broken off.
    """

    def __init__(
        self,
        tick: int,
        seen: Mapping[str, Seen],
        news: frozenset[str],
        refused: frozenset[int],
        first_number: int = 0,
        commands: tuple[Command, ...] = (),
        taken_back: frozenset[int] = frozenset(),
    ) -> None:
        self.tick = tick
        self.seen = seen
        self.news = news
        self.refused = refused
        self.first_number = first_number
        self.commands = commands
        self.taken_back = taken_back
        self.published: list[Published] = []
        self.asked: list[Asked] = []
        self.recalled: list[int] = []
        self.wakes: list[int] = []
        self.declined: list[tuple[int, str]] = []
        self.turns: list[Turn] = []

    def publish(self, timeline: str, predicate: str, /, **arguments: Argument) -> None:
        """Have an own timeline hold a value from this tick on; a command for just that has begun with it."""
        self.published.append(Published(timeline, predicate, arguments))

    def ask(
        self,
        timeline: str,
        predicate: str,
        /,
        start: Ticks = None,
        end: Ticks = None,
        duration: Ticks = None,
        **arguments: Argument,
    ) -> int:
        """Post a goal on a timeline that this reactor uses; its number, for `recall`."""
        number = self.first_number + len(self.asked)
        self.asked.append(Asked(number, timeline, predicate, arguments, start, end, duration))
        return number

    def recall(self, number: int) -> None:
        """Take back what was asked for, begun or not."""
        self.recalled.append(number)

    def decline(self, number: int, why: str = "") -> None:
        """Do not do what a command asks for; its sender is told why."""
        self.declined.append((number, why))

    def await_others(self, count: int) -> None:
        """Have what is asked and recalled from here on come behind so much that others do in this tick: a replay."""
        self.turns.append(Turn(count, len(self.asked), len(self.recalled)))

    def wake(self, tick: int) -> None:
        """Have `tick` called at a later tick even if nothing is new then, whatever it is called for before."""
        self.wakes.append(tick)


class Reactor:
    """A controller written in Python; one object flies one mission.

    `tick` is called at tick 0, whenever a timeline that it uses has begun to hold something (where `wakes_on` names
    some, one of these), when something that it asked for is refused, and at each tick at which it wanted to be woken;
    also when a command has come, may begin from now on, or is taken back.
    What it does must follow from what it was told: no clock, no random numbers but those it makes from its settings, or
    missions cannot be flown again.
    """

    wakes_on: tuple[str, ...] | None = None  # of the timelines that it uses; all of them if this is left out

    def __init__(self, settings: Mapping[str, Value]) -> None:
        self.settings = settings

    def tick(self, now: Now) -> None:
        """Look at what holds, and publish, ask or recall."""
