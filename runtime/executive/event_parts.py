"""Parts of a trace: single events, and runs of observations that a simulator keeps as columns."""

from collections.abc import Sequence
from typing import Protocol

from runtime.executive.columns import PublishedColumns
from runtime.executive.outcome import Event


class EventColumns(Protocol):
    """Observations that are kept as columns."""

    def head(self, index: int) -> tuple[int, str, str]:
        """Tick, timeline and predicate of the observation at an index of the columns."""

    def event(self, index: int) -> Event:
        """The observation at an index."""

    def published(self) -> tuple[PublishedColumns, ...]:
        """All observations, by timeline and predicate."""

    def first_of(self, predicate: str) -> tuple[int, str] | None:
        """Tick and timeline of the first observation of a predicate, by name at one tick; None if there is none."""

    def causes(self, index: int) -> tuple[int, ...]:
        """What caused the observation at an index."""

    def stored(self) -> "EventColumns":
        """The same apart from what else the mission leaves behind."""


class EventRun:
    """`count` observations in columns, from an index on."""

    def __init__(self, columns: EventColumns, first: int, count: int) -> None:
        self.columns = columns
        self.first = first
        self.count = count

    def __reduce__(self) -> tuple[type["EventRun"], tuple[EventColumns, int, int]]:
        """How pickle makes another: workers send traces."""
        return EventRun, (self.columns, self.first, self.count)


class EventParts:
    """Single events and runs in order; `starts` has the index of the first event of each, `length` counts events."""

    def __init__(self, parts: Sequence[Event | EventRun] = ()) -> None:
        self.all_parts = list(parts)
        self.starts: list[int] = []
        self.length = 0
        for part in parts:
            self.starts.append(self.length)
            self.length += part.count if isinstance(part, EventRun) else 1

    def __reduce__(self) -> tuple[object, ...]:
        """How pickle makes another."""
        return EventParts, (tuple(self.all_parts),)

    def __len__(self) -> int:
        return self.length

    def append(self, event: Event) -> int:
        """Add an event; its index."""
        self.all_parts.append(event)
        self.starts.append(self.length)
        self.length += 1
        return self.length - 1

    def extend(self, columns: EventColumns, index: int, count: int) -> None:
        """Add the observations at `index` and after."""
        last = self.all_parts[len(self.all_parts) - 1] if self.all_parts else None
        run = last if isinstance(last, EventRun) else None
        if run is not None and run.columns is columns and run.first + run.count == index:
            run.count += count
        else:
            self.all_parts.append(EventRun(columns, index, count))
            self.starts.append(self.length)
        self.length += count
