"""What is kept of one mission of a batch, how it is packed for another process, written as JSON, and read again."""

import copyreg
import io
import json
import pickle
from collections.abc import Callable, Sequence
from dataclasses import MISSING, dataclass, fields, is_dataclass, replace
from enum import Enum
from functools import cache, partial
from operator import attrgetter, methodcaller
from types import NoneType, UnionType
from typing import Any, TypeVar, Union, cast, get_args, get_origin, get_type_hints

from checker.batch.kept_trace import read_trace, write_trace
from checker.losses import NO_LOSSES, Losses
from checker.oracle import Judgement, Verdict
from checker.sampling.sampler import RANDOM_POINT, SamplePoint
from runtime.executive.events import EventLog
from runtime.executive.outcome import Draw, OpenGoal, Outcome

_T = TypeVar("_T")


@dataclass(frozen=True, slots=True)
class MissionResult:
    """Mission `number` (from 1) of a batch. `outcome` is None where the tool failed; `detail` then says how.

    Events are kept for missions that failed, so that they can be explained at once; a mission that passed keeps what
    the statistics need, and is flown again from its seed when somebody asks for more (`has_trace` false).
    """

    number: int
    seed: int
    judgement: Judgement
    outcome: Outcome | None
    has_trace: bool
    detail: str = ""
    losses: Losses = NO_LOSSES
    point: SamplePoint = RANDOM_POINT

    @property
    def least_margin(self) -> float:
        """The smallest margin of a property by which it was kept; 0 without any."""
        fates = self.outcome.properties if self.outcome is not None else ()
        return min((one.margin for one in fates if abs(one.margin) < float("inf")), default=0.0)

    @property
    def verdict(self) -> Verdict:
        """The fate of the mission."""
        return self.judgement.verdict

    @property
    def open_goals(self) -> tuple[OpenGoal, ...]:
        """The goals that a mission failed for, if nothing ended it early."""
        return self.outcome.open_goals if self.outcome is not None and self.outcome.abort is None else ()


def condense(outcome: Outcome) -> Outcome:
    """An outcome without its events, and of each parameter the least, the greatest and the last draw."""
    kept: list[Draw] = []
    for parameter in dict.fromkeys(draw.parameter for draw in outcome.draws):
        draws = [draw for draw in outcome.draws if draw.parameter == parameter]
        chosen = (min(draws, key=lambda one: one.value), max(draws, key=lambda one: one.value), draws[-1])
        kept += sorted(set(chosen), key=lambda one: one.tick)
    return replace(outcome, events=(), draws=tuple(kept))


def packed(value: object) -> bytes:
    """A value for `Connection.send_bytes`; at the other end `Connection.recv` has it."""
    buffer = io.BytesIO()
    _Packer(buffer, pickle.HIGHEST_PROTOCOL).dump(value)
    return buffer.getvalue()


class _Reducers(dict[type, Callable[[Any], Any]]):
    """By type what pickle makes a value of: of a record its class and values, which `dataclasses` takes long to say."""

    def __missing__(self, kind: Any) -> Callable[[Any], Any]:
        if _is_made_of_fields(kind):
            read = _fields(kind)[2]
            self[kind] = lambda value: (kind, read(value))
        elif issubclass(kind, type):
            self[kind] = attrgetter("__qualname__")
        else:
            self[kind] = copyreg.dispatch_table.get(kind) or methodcaller("__reduce_ex__", pickle.HIGHEST_PROTOCOL)
        return self[kind]


class _Packer(pickle.Pickler):
    dispatch_table = _Reducers()


def write_record(value: object) -> str:
    """A frozen dataclass of others, enums and plain values as a line of JSON, the same for equal values.

    Dataclasses are the fields that differ from their defaults, enums their values.
    """
    known: dict[int, Any] = {}  # by identity: conflicts name the same tokens and variables over and over

    def plain(value: Any) -> Any:
        kind: Any = type(value)
        if _is_record(kind):
            found = known.get(id(value))
            if found is None:
                known[id(value)] = found = _plain_fields(kind, value)
            return found
        if kind is EventLog:
            return write_trace(value)
        return value.value

    return json.JSONEncoder(ensure_ascii=False, check_circular=False, separators=(",", ":"), default=plain).encode(
        value
    )


def read_record(kind: type[_T], text: str) -> _T:
    """The value of a type that `write_record` wrote."""
    found = _read(kind, json.loads(text))
    assert isinstance(found, kind)
    return found


def _plain_fields(kind: Any, value: Any) -> dict[str, Any]:
    names, defaults, read = _fields(kind)
    return {
        name: item
        for name, default, item in zip(names, defaults, read(value), strict=True)
        if item is not default and (default is MISSING or default is None or default != item)
    }


def _read(kind: Any, value: Any) -> Any:
    """The value of type `kind` that `write_record` turned into `value`."""
    read = _reader(kind)
    return value if read is None else read(value)


@cache
def _reader(kind: Any) -> Callable[[Any], Any] | None:
    """What makes a value of type `kind` of JSON; None where that is the value already."""
    if _is_record(kind):
        return partial(_read_fields, kind, {})
    if _is_enum(kind):
        return cast(Callable[[Any], Any], kind)
    origin: Any = get_origin(kind)
    inner = get_args(kind)
    if origin is Sequence:
        return partial(_read_sequence, inner[0])
    if origin is tuple:
        return partial(_read_all, inner[0]) if inner[-1] is Ellipsis else partial(_read_each, inner)
    return _choice_of(inner) if origin in (Union, UnionType) else None


def _read_fields(kind: Any, readers: dict[str, Callable[[Any], Any] | None], value: dict[str, Any]) -> Any:
    if not readers:  # only now: records may hold others of their own type
        readers |= {name: _reader(hint) for name, hint in _hints(kind).items()}
    return kind(**{name: item if (read := readers[name]) is None else read(item) for name, item in value.items()})


def _read_sequence(kind: Any, value: Any) -> Any:
    return read_trace(value, partial(_read, kind)) if isinstance(value, dict) else _read_all(kind, value)


def _read_all(kind: Any, value: list[Any]) -> tuple[Any, ...]:
    read = _reader(kind)
    return tuple(value) if read is None else tuple(map(read, value))


def _read_each(kinds: tuple[Any, ...], value: list[Any]) -> tuple[Any, ...]:
    return tuple(_read(one, item) for one, item in zip(kinds, value, strict=False))


def _choice_of(kinds: tuple[Any, ...]) -> Callable[[Any], Any]:
    """What reads a value of one of some types: with one record and None among them, there is nothing to choose."""
    records = [one for one in kinds if one is not NoneType]
    return partial(_read_or_none, records[0]) if len(records) == 1 else partial(_read_one_of, kinds)


def _read_or_none(kind: Any, value: Any) -> Any:
    return None if value is None else _read(kind, value)


def _read_one_of(kinds: tuple[Any, ...], value: Any) -> Any:
    chosen = None if value is None else next((one for one in kinds if _fits(one, value)), None)
    return value if chosen is None else _read(chosen, value)


def _fits(kind: Any, value: Any) -> bool:
    """Whether JSON says a value of type `kind` as it says `value`; numbers, texts and None need no reading."""
    match value:
        case dict():
            return _is_record(kind) and value.keys() <= _hints(kind).keys() and value.keys() >= _needed(kind)
        case list():
            return get_origin(kind) in (tuple, Sequence)
        case str():
            return _is_enum(kind)
        case _:
            return False


@cache
def _fields(kind: Any) -> tuple[tuple[str, ...], tuple[Any, ...], Callable[[Any], tuple[Any, ...]]]:
    """Names and defaults of the fields, which may be MISSING, and what reads all of them."""
    names = tuple(one.name for one in fields(kind))
    read = attrgetter(*names) if len(names) > 1 else lambda value: tuple(getattr(value, name) for name in names)
    return names, tuple(one.default for one in fields(kind)), read


@cache
def _needed(kind: Any) -> set[str]:
    """The fields without a default."""
    return {one.name for one in fields(kind) if one.default is MISSING}


@cache
def _is_record(kind: Any) -> bool:
    return is_dataclass(kind)


def _is_made_of_fields(kind: Any) -> bool:
    """Whether a call with the values of its fields, in order, makes an equal value."""
    if not is_dataclass(kind) or hasattr(kind, "__post_init__"):
        return False
    return all(one.init and not one.kw_only for one in fields(kind))


def _is_enum(kind: Any) -> bool:
    return isinstance(kind, type) and issubclass(kind, Enum)


@cache
def _hints(kind: Any) -> dict[str, Any]:
    return get_type_hints(kind)
