"""Columns of a record: executed tokens that are alike, as one array per number; expanded to tokens when read."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from runtime.executive.record import TokenRecord

Array = NDArray[Any]
ORIGINS = ("own", "rule", "request", "observation", "fact")  # by number


class ValueColumn(NamedTuple):
    """One value per row: reals as float64, NaN where one was never fixed; else int64, names by number."""

    kind: str  # int, float, bool or name
    numbers: Array


class GuardColumns(NamedTuple):
    """A guard that was decided the same way in each row."""

    branch: str
    run: "RunColumns | None"


class RunColumns(NamedTuple):
    """Runs of one rule, the same branches taken in each row; the keys of its children."""

    rule: int
    locals: tuple[ValueColumn, ...]
    children: tuple[Array, ...]
    guards: tuple[GuardColumns, ...]


class TokenGroup(NamedTuple):
    """Active tokens of one predicate on one timeline, by their places in the record; of open numbers NaN tells."""

    predicate: str
    object: str
    places: Array
    arguments: tuple[ValueColumn, ...]
    runs: tuple[RunColumns, ...]


class PublishedColumns(NamedTuple):
    """Observations of one predicate on one timeline: ticks, and a column for each parameter by its name.

    `places` are those in the columns of the trace; names of values are numbers into `symbols`.
    """

    timeline: str
    predicate: str
    ticks: Array
    arguments: tuple[tuple[str, ValueColumn], ...]
    places: Array
    symbols: Sequence[str]


class TokenTimes(NamedTuple):
    """What every token of a record has, by place.

    `states` are 0 active, 1 merged, 2 inactive; `latest` is the latest end, infinite if nothing bounds it.
    """

    keys: Array
    predicates: Array  # numbers of names
    objects: Array
    states: Array
    starts: Array  # the earliest, of what has not begun
    ends: Array
    latest: Array
    merged_into: Array  # keys
    origins: Array
    is_over: Array
    ticks: Array


class TokenColumns(Sequence[TokenRecord]):
    """The tokens of a reactor that kept columns, in the order of keys; equal to the tuple of them."""

    def __init__(
        self,
        times: TokenTimes,
        names: Sequence[str],
        symbols: Sequence[str],
        groups: Callable[[], tuple[TokenGroup, ...]],
        token: Callable[[int], TokenRecord],
    ) -> None:
        self.times = times
        self.names = names  # of predicates and timelines
        self.symbols = symbols  # names that values stand for
        self._token = token
        self._make_groups = groups
        self._groups: tuple[TokenGroup, ...] | None = None

    @property
    def groups(self) -> tuple[TokenGroup, ...]:
        """All active tokens that have begun, those that are alike together."""
        if self._groups is None:
            self._groups = self._make_groups()
        return self._groups

    def named(self, short: str) -> list[int]:
        """The places of tokens of all predicates of a short name."""
        numbers = [k for k, name in enumerate(self.names) if name.rpartition(".")[2] == short]
        return [int(place) for place in np.flatnonzero(np.isin(self.times.predicates, numbers))]

    def on(self, timeline: str) -> list[int]:
        """The places of tokens on a timeline."""
        numbers = [k for k, name in enumerate(self.names) if name == timeline]
        return [int(place) for place in np.flatnonzero(np.isin(self.times.objects, numbers))]

    def __len__(self) -> int:
        return len(self.times.keys)

    @overload
    def __getitem__(self, index: int) -> TokenRecord: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[TokenRecord, ...]: ...
    def __getitem__(self, index: int | slice) -> TokenRecord | tuple[TokenRecord, ...]:
        if isinstance(index, slice):
            return tuple(map(self._token, range(*index.indices(len(self)))))
        place = index + len(self) if index < 0 else index
        if not 0 <= place < len(self):
            raise IndexError(index)
        return self._token(place)

    def __iter__(self) -> Iterator[TokenRecord]:
        return map(self._token, range(len(self)))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, (TokenColumns, tuple)) and len(self) == len(other) and tuple(self) == tuple(other)

    def __hash__(self) -> int:
        return hash(tuple(self))


def value_column(numbers: Array, kind: str) -> ValueColumn:
    """The column of numbers as registers hold them."""
    if kind == "float":
        return ValueColumn(kind, numbers + 0.0)  # no negative zero
    if np.isnan(numbers).any():
        return ValueColumn(kind if kind in ("int", "bool") else "name", numbers)
    return ValueColumn(kind if kind in ("int", "bool") else "name", numbers.astype(np.int64))
