"""Events of a mission in order: single ones, and runs of a simulator's observations that are expanded when read."""

from bisect import bisect_right
from collections.abc import Callable, Container, Iterator, Sequence
from typing import overload

from runtime.executive.columns import PublishedColumns
from runtime.executive.event_parts import EventColumns, EventParts, EventRun
from runtime.executive.outcome import Event, EventKind

Head = tuple[int, int, str, str]  # of an observation: index, tick, timeline and predicate


class EventLog(EventParts, Sequence[Event]):
    """A sequence of events, equal to the tuple of them."""

    @property
    def parts(self) -> Sequence[Event | EventRun]:
        """Single events and runs, in order."""
        return self.all_parts

    def single(self) -> list[Event]:
        """All events but those in runs."""
        return [part for part in self.all_parts if isinstance(part, Event)]

    def published(self) -> list[tuple[EventColumns, PublishedColumns]]:
        """The observations in runs, as columns, each with what expands them."""
        return [(source, each) for source in self._sources() for each in source.published()]

    def first_in_runs(self, predicate: str) -> list[tuple[int, str]]:
        """Tick and timeline of the first observation of a predicate in the runs of each simulator that tells it."""
        return [found for source in self._sources() if (found := source.first_of(predicate)) is not None]

    def _sources(self) -> list[EventColumns]:
        sources = {id(part.columns): part.columns for part in self.all_parts if isinstance(part, EventRun)}
        return list(sources.values())

    def changed(self, change: Callable[[Event], Event]) -> "EventLog":
        """The same events, single ones changed."""
        return EventLog([change(part) if isinstance(part, Event) else part for part in self.all_parts])

    def heads(self) -> Iterator[Head]:
        """Each observation in short, in order."""
        number = 0
        for part in self.all_parts:
            if isinstance(part, EventRun):
                for index in range(part.first, part.first + part.count):
                    yield number, *part.columns.head(index)
                    number += 1
                continue
            if part.kind is EventKind.OBSERVATION:
                yield number, part.tick, part.timeline, part.predicate
            number += 1

    def causes(self) -> Iterator[tuple[int, ...]]:
        """The causes of each event, in order."""
        for part in self.all_parts:
            if isinstance(part, EventRun):
                yield from map(part.columns.causes, range(part.first, part.first + part.count))
            else:
                yield part.causes

    def causes_at(self, index: int) -> tuple[int, ...]:
        """The causes of the event at an index, not below 0."""
        number = bisect_right(self.starts, index) - 1
        part = self.all_parts[number]
        if isinstance(part, Event):
            return part.causes
        return part.columns.causes(part.first + index - self.starts[number])

    def on(self, timelines: Container[str]) -> Iterator[Event]:
        """The events on some timelines, in order."""
        for part in self.all_parts:
            if isinstance(part, Event):
                if part.timeline in timelines:
                    yield part
                continue
            for index in range(part.first, part.first + part.count):
                if part.columns.head(index)[1] in timelines:
                    yield part.columns.event(index)

    @overload
    def __getitem__(self, index: int) -> Event: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Event, ...]: ...
    def __getitem__(self, index: int | slice) -> Event | tuple[Event, ...]:
        if isinstance(index, slice):
            return tuple(self[k] for k in range(*index.indices(self.length)))
        at = index + self.length if index < 0 else index
        if not 0 <= at < self.length:
            raise IndexError(index)
        number = bisect_right(self.starts, at) - 1
        part = self.all_parts[number]
        return part if isinstance(part, Event) else part.columns.event(part.first + at - self.starts[number])

    def __iter__(self) -> Iterator[Event]:
        for part in self.all_parts:
            if isinstance(part, Event):
                yield part
            else:
                yield from map(part.columns.event, range(part.first, part.first + part.count))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, (EventLog, tuple)) and len(self) == len(other) and tuple(self) == tuple(other)

    def __hash__(self) -> int:
        return hash(tuple(self))

    def __repr__(self) -> str:
        return repr(tuple(self))

    def __reduce__(self) -> tuple[type, tuple[list[Event | EventRun]]]:
        return EventLog, (self.all_parts,)


def single_events(events: Sequence[Event]) -> Sequence[Event]:
    """The events of a trace but runs of a simulator's observations: all there is of any other kind."""
    return events.single() if isinstance(events, EventLog) else events


def changed_events(events: Sequence[Event], change: Callable[[Event], Event]) -> Sequence[Event]:
    """The same trace, its single events changed."""
    return events.changed(change) if isinstance(events, EventLog) else tuple(map(change, events))


def numbered(events: Sequence[Event]) -> Iterator[tuple[int, Event]]:
    """The same with their indices."""
    if not isinstance(events, EventLog):
        yield from enumerate(events)
        return
    index = 0
    for part in events.parts:
        if isinstance(part, Event):
            yield index, part
        index += part.count if isinstance(part, EventRun) else 1


def causes_of(events: Sequence[Event]) -> Iterator[tuple[int, ...]]:
    """The causes of each event of a trace, in order."""
    return events.causes() if isinstance(events, EventLog) else (one.causes for one in events)


def heads_of(events: Sequence[Event]) -> Iterator[Head]:
    """Each observation of a trace in short, in order."""
    if isinstance(events, EventLog):
        yield from events.heads()
        return
    for index, one in enumerate(events):
        if one.kind is EventKind.OBSERVATION:
            yield index, one.tick, one.timeline, one.predicate


def events_on(events: Sequence[Event], timelines: Container[str]) -> Iterator[Event]:
    """The events of a trace that are on some timelines, in order."""
    return (
        events.on(timelines) if isinstance(events, EventLog) else (one for one in events if one.timeline in timelines)
    )
