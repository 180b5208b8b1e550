"""Columns of a record: executed tokens that are alike, as one array per number; expanded to tokens when read."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from runtime.executive.record import TokenRecord

Array = NDArray[Any]
ORIGINS = ("own", "rule", "request", "observation", "fact")  # by number


class ValueColumn(NamedTuple):
    """One value per row, as registers hold it: float64, names by number, NaN where it was never fixed."""

    kind: str  # int, float, bool or name
    numbers: Array
    has_open: bool


class ShownValues(NamedTuple):
    """Values of rows in one store, each some way behind the first of its row; read in parts."""

    store: Array
    first: Array
    offsets: tuple[int, ...]
    kinds: tuple[str, ...]

    def part(self, begin: int, end: int) -> list[ValueColumn]:
        """The values of the rows from one on to before another."""
        table = table_of(self.store, self.first[begin:end], self.offsets)
        may_be_open = has_nan(table)
        return [value_column(each, kind, may_be_open) for each, kind in zip(table, self.kinds, strict=True)]


class StoredValues(NamedTuple):
    """Values of rows in one store: row by row side by side, the first of each row at `first`."""

    store: Array
    first: Array
    kinds: tuple[str, ...]

    def columns(self) -> tuple[ValueColumn, ...]:
        """The values of all rows."""
        table = table_of(self.store, self.first, range(len(self.kinds)))
        may_be_open = has_nan(table)
        return tuple([value_column(each, kind, may_be_open) for each, kind in zip(table, self.kinds, strict=True)])


def table_of(store: Array, first: Array, offsets: Sequence[int]) -> Array:
    """A row for each of the numbers that stand in a store some way behind each of `first`."""
    table = np.empty((len(offsets), len(first)))
    if len(first):
        for row, offset in zip(table, offsets, strict=True):
            store[offset:].take(first, out=row, mode="clip")  # numpy copies once more where it is to raise
    return table


class GuardColumns(NamedTuple):
    """A guard that was decided in each row; `then` and `otherwise` have the rows in which it was, and was not, true."""

    is_true: Array
    then: "RunColumns | None"
    otherwise: "RunColumns | None"


class RunOutline(NamedTuple):
    """Where runs of a body show what they did: places of values behind the first that a run shows; of keys likewise."""

    rule: int
    locals: tuple[tuple[int, str], ...]  # with their kinds
    children: tuple[int, ...]
    guards: tuple["GuardOutline", ...]


class GuardOutline(NamedTuple):
    """The place of a guard's condition, and its branches, None where one is empty."""

    place: int
    then: RunOutline | None
    otherwise: RunOutline | None


class RunColumns(NamedTuple):
    """Runs of one body: `shown` is where each begins to show its values, `first` where the keys of its children are."""

    outline: RunOutline
    store: Array
    shown: Array
    keys: Array
    first: Array

    @property
    def rule(self) -> int:
        """The index of the rule in its program."""
        return self.outline.rule

    @property
    def locals(self) -> ShownValues:
        """The values of the named locals."""
        places, kinds = zip(*self.outline.locals, strict=True) if self.outline.locals else ((), ())
        return ShownValues(self.store, self.shown, places, kinds)

    @property
    def children(self) -> tuple[Array, ...]:
        """The keys of the children."""
        return tuple([self.keys.take(self.first + place) for place in self.outline.children])

    @property
    def guards(self) -> tuple[GuardColumns, ...]:
        """What each guard came to."""
        return tuple([self._guard(each) for each in self.outline.guards])

    def _guard(self, guard: GuardOutline) -> GuardColumns:
        is_true = self.came_true(guard)
        return GuardColumns(is_true, self.branch(guard.then, is_true), self.branch(guard.otherwise, ~is_true))

    def came_true(self, guard: GuardOutline) -> Array:
        """In which of the runs a guard was true."""
        found: Array = self.store.take(self.shown + guard.place) != 0.0
        return found

    def branch(self, outline: RunOutline | None, is_taken: Array) -> "RunColumns | None":
        """What a branch did in those of the runs that took it."""
        if outline is None or not is_taken.any():
            return None
        taken = np.flatnonzero(is_taken)
        return RunColumns(outline, self.store, self.shown.take(taken), self.keys, self.first.take(taken))


class TokenGroup(NamedTuple):
    """Active tokens of one predicate on one timeline, by their indices in the record."""

    predicate: str
    object: str
    indices: Array
    runs: tuple[RunColumns, ...]


class PublishedColumns(NamedTuple):
    """Observations of one predicate on one timeline: ticks, and the arguments by the names of the parameters.

    `indices` are those in the columns of the trace; names of values are numbers into `symbols`.
    """

    timeline: str
    predicate: str
    ticks: Array
    parameters: tuple[str, ...]
    arguments: StoredValues
    indices: Array
    symbols: Sequence[str]


class TokenTimes(NamedTuple):
    """What every token of a record has, by index.

    `states` are 0 active, 1 merged, 2 inactive; `latest` is the latest end, infinite if nothing bounds it; `values`
    tells where the store has the arguments of a token that has begun (of the other half, if it is merged), NOBODY of
    the others.
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
    values: Array


class TokenColumns(Sequence[TokenRecord]):
    """The tokens of a reactor that kept columns, in the order of keys; equal to the tuple of them."""

    def __init__(
        self,
        times: TokenTimes,
        names: Sequence[str],
        kinds: Sequence[tuple[str, ...]],
        store: Array,
        symbols: Sequence[str],
        groups: Callable[[], tuple[TokenGroup, ...]],
        token: Callable[[int], TokenRecord],
    ) -> None:
        self.times = times
        self.names = names  # of predicates and timelines
        self.kinds = kinds  # of the parameters of each predicate
        self.store = store  # the arguments of all tokens; NaN where one was never fixed
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
        """The indices of tokens of all predicates of a short name."""
        numbers = [k for k, name in enumerate(self.names) if name.rpartition(".")[2] == short]
        return [int(index) for index in np.flatnonzero(np.isin(self.times.predicates, numbers))]

    def on(self, timeline: str) -> list[int]:
        """The indices of tokens on a timeline."""
        numbers = [k for k, name in enumerate(self.names) if name == timeline]
        return [int(index) for index in np.flatnonzero(np.isin(self.times.objects, numbers))]

    def __len__(self) -> int:
        return len(self.times.keys)

    @overload
    def __getitem__(self, index: int) -> TokenRecord: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[TokenRecord, ...]: ...
    def __getitem__(self, index: int | slice) -> TokenRecord | tuple[TokenRecord, ...]:
        if isinstance(index, slice):
            return tuple(map(self._token, range(*index.indices(len(self)))))
        at = index + len(self) if index < 0 else index
        if not 0 <= at < len(self):
            raise IndexError(index)
        return self._token(at)

    def __iter__(self) -> Iterator[TokenRecord]:
        return map(self._token, range(len(self)))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, (TokenColumns, tuple)) and len(self) == len(other) and tuple(self) == tuple(other)

    def __hash__(self) -> int:
        return hash(tuple(self))


def has_nan(numbers: Array) -> bool:
    """Whether something among the numbers was never fixed."""
    return bool(np.isnan(np.add.reduce(numbers, axis=None))) and bool(np.isnan(numbers).any())


def value_column(numbers: Array, kind: str, may_be_open: bool) -> ValueColumn:
    """The column of numbers as registers hold them."""
    name = kind if kind in ("int", "bool", "float") else "name"
    return ValueColumn(name, numbers, may_be_open and has_nan(numbers))
