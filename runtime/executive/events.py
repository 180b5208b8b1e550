"""Events of a mission in order: single ones, and runs of a simulator's observations that are expanded when read."""

from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol, overload

from runtime.executive.columns import PublishedColumns
from runtime.executive.outcome import Event


class EventColumns(Protocol):
    """Observations that are kept as columns."""

    def event(self, place: int) -> Event:
        """The observation at a place of the columns."""

    def published(self) -> tuple[PublishedColumns, ...]:
        """All observations, by timeline and predicate."""


@dataclass(eq=False, slots=True)
class _Run:
    """`count` observations in columns, from a place on."""

    columns: EventColumns
    place: int
    count: int


class EventLog(Sequence[Event]):
    """A sequence of events, equal to the tuple of them; it is pickled as that."""

    def __init__(self) -> None:
        self._parts: list[Event | _Run] = []
        self._starts: list[int] = []  # the index of the first event of each part
        self._length = 0

    def append(self, event: Event) -> int:
        """Add an event; its index."""
        self._parts.append(event)
        self._starts.append(self._length)
        self._length += 1
        return self._length - 1

    def extend(self, columns: EventColumns, place: int, count: int) -> None:
        """Add the observations at `place` and after."""
        last = self._parts[-1] if self._parts else None
        if isinstance(last, _Run) and last.columns is columns and last.place + last.count == place:
            last.count += count
        else:
            self._parts.append(_Run(columns, place, count))
            self._starts.append(self._length)
        self._length += count

    def single(self) -> list[Event]:
        """All events but those in runs."""
        return [part for part in self._parts if isinstance(part, Event)]

    def published(self) -> list[tuple[EventColumns, PublishedColumns]]:
        """The observations in runs, as columns, each with what expands them."""
        sources: dict[int, EventColumns] = {}
        for part in self._parts:
            if isinstance(part, _Run):
                sources[id(part.columns)] = part.columns
        return [(source, each) for source in sources.values() for each in source.published()]

    def changed(self, change: Callable[[Event], Event]) -> "EventLog":
        """The same events, single ones changed."""
        found = EventLog()
        found._parts = [change(part) if isinstance(part, Event) else part for part in self._parts]
        found._starts, found._length = self._starts, self._length
        return found

    def __len__(self) -> int:
        return self._length

    @overload
    def __getitem__(self, index: int) -> Event: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Event, ...]: ...
    def __getitem__(self, index: int | slice) -> Event | tuple[Event, ...]:
        if isinstance(index, slice):
            return tuple(self[k] for k in range(*index.indices(self._length)))
        place = index + self._length if index < 0 else index
        if not 0 <= place < self._length:
            raise IndexError(index)
        number = bisect_right(self._starts, place) - 1
        part = self._parts[number]
        return part if isinstance(part, Event) else part.columns.event(part.place + place - self._starts[number])

    def __iter__(self) -> Iterator[Event]:
        for part in self._parts:
            if isinstance(part, Event):
                yield part
            else:
                yield from map(part.columns.event, range(part.place, part.place + part.count))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, (EventLog, tuple)) and len(self) == len(other) and tuple(self) == tuple(other)

    def __hash__(self) -> int:
        return hash(tuple(self))

    def __repr__(self) -> str:
        return repr(tuple(self))

    def __reduce__(self) -> tuple[type, tuple[tuple[Event, ...]]]:
        return tuple, (tuple(self),)


def single_events(events: Sequence[Event]) -> Sequence[Event]:
    """The events of a trace but runs of a simulator's observations: all there is of any other kind."""
    return events.single() if isinstance(events, EventLog) else events


def changed_events(events: Sequence[Event], change: Callable[[Event], Event]) -> Sequence[Event]:
    """The same trace, its single events changed."""
    return events.changed(change) if isinstance(events, EventLog) else tuple(map(change, events))
