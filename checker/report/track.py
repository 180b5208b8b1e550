"""The way of a vehicle through a mission: an outcome with its events in, positions, probabilities and marks out."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from checker.figures import Figures
from runtime.executive.columns import PublishedColumns
from runtime.executive.events import EventLog, events_on, single_events
from runtime.executive.outcome import Event, EventKind, Outcome

_FARTHEST = 1e9  # metres; what a mistaken model sends farther, or nowhere, no picture shows
_ENDLESS = 2.0**52  # what is wider is bounded on one side at most


@dataclass(frozen=True, eq=False, slots=True)
class Band:
    """A predicate that held on a timeline, from its first tick to the one after its last."""

    start: int
    end: int
    predicate: str


@dataclass(frozen=True, eq=False, slots=True)
class Track:
    """A path: a row (east, north, depth) for each of `ticks`, and how probable the feature was held to be there.

    `samples` are ticks; `targets` are ticks with what was asked for or taken back then.
    """

    ticks: np.ndarray
    positions: np.ndarray
    probabilities: np.ndarray
    samples: tuple[int, ...]
    phases: tuple[Band, ...]
    targets: tuple[tuple[int, str], ...]
    last_tick: int


def track_of(outcome: Outcome, figures: Figures) -> Track | None:
    """The path of a mission whose events were kept; None where it never says where the vehicle is."""
    wanted = {figures.feature, figures.samples, figures.phases, figures.during} - {""}
    seen: dict[str, list[Event]] = {name: [] for name in wanted}
    targets: list[tuple[int, str]] = []
    for event in events_on(outcome.events, {*wanted, figures.targets} - {""}):
        if event.kind is EventKind.OBSERVATION:
            if event.timeline in seen:
                seen[event.timeline].append(event)
        elif event.timeline == figures.targets:
            if event.kind in (EventKind.REQUEST, EventKind.RECALL):
                word = "asked" if event.kind is EventKind.REQUEST else "recalled"
                targets.append((event.tick, f"{event.predicate} {word}"))
    first, last = _drawn(seen.get(figures.during, []), outcome.last_tick)
    table = _way(outcome.events, figures.path, figures.position)
    table = table[(first <= table[:, 0]) & (table[:, 0] <= last) & (np.abs(table[:, 1:]) <= _FARTHEST).all(axis=1)]
    if len(table) < 2:
        return None
    probabilities = np.zeros(len(table))
    for event in seen.get(figures.feature, []):
        probability = _number(event, figures.probability)
        probabilities[table[:, 0] >= event.tick] = 0.0 if np.isnan(probability) else min(max(probability, 0.0), 1.0)
    fired = [event.tick for event in seen.get(figures.samples, []) if event.predicate == figures.firing]
    spans = _spans(seen.get(figures.phases, []), last)
    return Track(
        table[:, 0].astype(int), table[:, 1:], probabilities, tuple(tick for tick in fired if first <= tick <= last),
        tuple(one for one in spans if one.end > first), tuple(one for one in targets if one[0] <= last), last,
    )  # fmt: skip


def _way(events: Sequence[Event], timeline: str, names: Sequence[str]) -> np.ndarray:
    """Tick and numeric arguments of the observations on a timeline, in order; NaN where there is no number."""
    tables = [
        np.array([(one.tick, *(_number(one, name) for name in names))])
        for one in single_events(events)
        if one.kind is EventKind.OBSERVATION and one.timeline == timeline
    ]
    if isinstance(events, EventLog):
        for _, each in events.published():
            if each.timeline == timeline:
                tables.append(_columns(each, names))
    table = np.vstack([np.empty((0, 1 + len(names))), *tables])
    return table[np.argsort(table[:, 0], kind="stable")]


def _columns(told: PublishedColumns, names: Sequence[str]) -> np.ndarray:
    """Tick and numeric arguments of observations that are kept as columns."""
    known = dict(zip(told.parameters, told.arguments.columns(), strict=True))
    table = np.full((len(told.ticks), 1 + len(names)), np.nan)
    table[:, 0] = told.ticks
    for column, name in enumerate(names, 1):
        if name in known and known[name].kind in ("int", "float"):
            table[:, column] = known[name].numbers
    return table


def _drawn(events: Sequence[Event], last_tick: int) -> tuple[int, int]:
    """The first and the last tick that are drawn."""
    spans = _spans(events, last_tick)
    busy = [one for one in spans if one.predicate != spans[0].predicate]
    return (busy[0].start, busy[-1].end) if busy else (0, last_tick)


def _spans(events: Sequence[Event], last_tick: int) -> list[Band]:
    """What held, from one observation to the next; tokens of one predicate after each other are one span each."""
    ends = [*(min(event.tick, last_tick) for event in events[1:]), last_tick][: len(events)]
    return [Band(event.tick, end, event.predicate) for event, end in zip(events, ends, strict=True) if end > event.tick]


def _number(event: Event, name: str) -> float:
    """The value of a numeric argument, NaN where there is none, or where nothing bounds it."""
    for argument, value in event.arguments:
        if argument == name and value.interval is not None and value.interval[1] - value.interval[0] < _ENDLESS:
            return (float(value.interval[0]) + float(value.interval[1])) / 2.0
    return float("nan")
