"""Traces as JSON: single events as they are, runs of observations as packed columns; and read again."""

import base64
import zlib
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from runtime.determined.told import StoredKind, StoredObservations
from runtime.executive.events import EventLog, EventRun
from runtime.executive.outcome import Event

_NUMBERS = ("places", "ticks", "rows", "causes")


def write_trace(events: EventLog, plain: Callable[[Event], Any]) -> dict[str, Any]:
    """A trace with runs as JSON can say it; `plain` writes a single event."""
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
            parts.append([sources[id(part.columns)], part.place, part.count])
        else:
            parts.append(plain(part))
    return {"columns": [_write_columns(each) for each in stored], "parts": parts}


def read_trace(text: dict[str, Any], read: Callable[[Any], Event]) -> EventLog:
    """The trace that `write_trace` wrote."""
    columns = [_read_columns(each) for each in text["columns"]]
    parts = [EventRun(columns[one[0]], one[1], one[2]) if isinstance(one, list) else read(one) for one in text["parts"]]
    return EventLog(parts)


def _write_columns(columns: StoredObservations) -> dict[str, Any]:
    kinds = [
        {
            "timeline": each.timeline,
            "predicate": each.predicate,
            "full_name": each.full_name,
            "shapes": each.shapes,
            "values": _packed(each.values, "<f8"),
            **{name: _packed(np.diff(getattr(each, name), prepend=0), "<i8") for name in _NUMBERS},
        }
        for each in columns.kinds
    ]
    return {"name": columns.name, "symbols": columns.symbols, "kinds": kinds}


def _read_columns(text: dict[str, Any]) -> StoredObservations:
    kinds = []
    for each in text["kinds"]:
        shapes = tuple([tuple(shape) for shape in each["shapes"]])
        places, ticks, rows, causes = (np.cumsum(_unpacked(each[name], "<i8")) for name in _NUMBERS)
        values = _unpacked(each["values"], "<f8").reshape(len(places), len(shapes))
        kinds.append(
            StoredKind(
                each["timeline"], each["predicate"], each["full_name"], shapes, places, ticks, rows, causes, values
            )
        )  # fmt: skip
    return StoredObservations(text["name"], tuple(kinds), tuple(text["symbols"]))


def _packed(numbers: Sequence[Any] | np.ndarray, kind: str) -> str:
    """The bytes of an array, compressed, as text."""
    return base64.b64encode(zlib.compress(np.ascontiguousarray(numbers, kind).tobytes(), 1)).decode("ascii")


def _unpacked(text: str, kind: str) -> np.ndarray:
    return np.frombuffer(zlib.decompress(base64.b64decode(text)), kind)
