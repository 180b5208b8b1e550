"""Traces as JSON: single events as they are, runs of observations as packed columns; and read again."""

import base64
import zlib
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from runtime.determined.told import StoredKind, StoredObservations
from runtime.executive.event_parts import EventRun
from runtime.executive.events import EventLog
from runtime.executive.outcome import Event

_NUMBERS = ("indices", "ticks", "rows", "causes")


def write_trace(events: EventLog) -> dict[str, Any]:
    """A trace with runs as JSON can say it; single events stay as they are."""
    sources: dict[int, int] = {}
    stored: list[StoredObservations] = []
    parts: list[Any] = []
    for part in events.parts:
        if isinstance(part, EventRun):
            if id(part.columns) not in sources:
                sources[id(part.columns)] = len(stored)
                columns = part.columns.stored()
                assert isinstance(columns, StoredObservations)
                stored.append(columns)
            parts.append([sources[id(part.columns)], part.first, part.count])
        else:
            parts.append(part)
    return {"columns": [_write_columns(each) for each in stored], "parts": parts}


def read_trace(text: dict[str, Any], read: Callable[[Any], Event]) -> EventLog:
    """The trace that `write_trace` wrote."""
    columns = [_read_columns(each) for each in text["columns"]]
    parts = [EventRun(columns[one[0]], one[1], one[2]) if isinstance(one, list) else read(one) for one in text["parts"]]
    return EventLog(parts)


def _write_columns(columns: StoredObservations) -> dict[str, Any]:
    """One text each for all whole numbers and all reals: what a text costs counts in small traces."""
    kinds = columns.kinds
    numbers = [np.diff(getattr(each, name), prepend=0) for each in kinds for name in _NUMBERS]
    return {
        "name": columns.name,
        "symbols": columns.symbols,
        "kinds": [[each.timeline, each.predicate, each.full_name, each.shapes, len(each.indices)] for each in kinds],
        "numbers": _packed(numbers, "<i8"),
        "values": _packed([each.values.ravel() for each in kinds], "<f8"),
    }


def _read_columns(text: dict[str, Any]) -> StoredObservations:
    kinds = []
    numbers, values = _unpacked(text["numbers"], "<i8"), _unpacked(text["values"], "<f8")
    for timeline, predicate, full_name, written, count in text["kinds"]:
        shapes = tuple([tuple(shape) for shape in written])
        indices, ticks, rows, causes = (np.cumsum(numbers[k * count : (k + 1) * count]) for k in range(len(_NUMBERS)))
        numbers = numbers[len(_NUMBERS) * count :]
        own, values = np.split(values, [count * len(shapes)])
        table = own.reshape(count, len(shapes))
        kinds.append(StoredKind(timeline, predicate, full_name, shapes, indices, ticks, rows, causes, table))
    return StoredObservations(text["name"], tuple(kinds), tuple(text["symbols"]))


def _packed(parts: Sequence[np.ndarray], kind: str) -> str:
    """The bytes of some arrays, compressed, as text."""
    joined = np.concatenate([np.empty(0, kind), *parts], dtype=kind)
    return base64.b64encode(zlib.compress(joined.tobytes(), 1)).decode("ascii")


def _unpacked(text: str, kind: str) -> np.ndarray:
    return np.frombuffer(zlib.decompress(base64.b64decode(text)), kind)
