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


class Now:
    """One tick, as a reactor sees it and speaks in it.

    `seen` has what holds, by timeline, of those that it uses; `news` the timelines that have begun to hold something at
    this tick, `refused` the numbers of what owners will not do.
    """

    def __init__(
        self,
        tick: int,
        seen: Mapping[str, Seen],
        news: frozenset[str],
        refused: frozenset[int],
        first_number: int = 0,
    ) -> None:
        self.tick = tick
        self.seen = seen
        self.news = news
        self.refused = refused
        self.first_number = first_number
        self.published: list[Published] = []
        self.asked: list[Asked] = []
        self.recalled: list[int] = []
        self.wakes: list[int] = []

    def publish(self, timeline: str, predicate: str, /, **arguments: Argument) -> None:
        """Have an own timeline hold a value from this tick on."""
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

    def wake(self, tick: int) -> None:
        """Have `tick` called at a later tick even if nothing is new then, whatever it is called for before."""
        self.wakes.append(tick)


class Reactor:
    """A controller written in Python; one object flies one mission.

    `tick` is called at tick 0, whenever a timeline that it uses has begun to hold something (where `wakes_on` names
    some, one of these), when something that it asked for is refused, and at each tick at which it wanted to be woken.
    What it does must follow from what it was told: no clock, no random numbers but those it makes from its settings, or
    missions cannot be flown again.
    """

    wakes_on: tuple[str, ...] | None = None  # of the timelines that it uses; all of them if this is left out

    def __init__(self, settings: Mapping[str, Value]) -> None:
        self.settings = settings

    def tick(self, now: Now) -> None:
        """Look at what holds, and publish, ask or recall."""
