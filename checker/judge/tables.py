"""The tokens of a reactor as tables: times and keys of all of them in arrays, arguments in one column per parameter.

`record_tables.py` fills them from single records, `column_tables.py` from a record that was kept in columns. What else
the judge asks of a record it asks token by token.
"""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from checker.judge.columns import TEXT, Array, Column, Mask, Texts, joined
from compiler.program import END, FIRST_PARAMETER, OBJECT, START
from runtime.executive.record import NOBODY, TokenRecord

_DEEPEST = 64  # merged into what is merged into ...


class GuardRows(NamedTuple):
    """A guard that was decided the same way in each row."""

    branch: str
    is_decided: bool
    run: "RunRows | None"


class RunRows(NamedTuple):
    """Runs of one rule, the same branches taken in each row: locals, keys of children, guards."""

    rule: int
    locals: tuple[Column, ...]
    children: tuple[Array, ...]
    guards: tuple[GuardRows, ...]


class TokenRows(NamedTuple):
    """Tokens that are alike, by their places in the record."""

    predicate: str
    rows: Array
    runs: tuple[RunRows, ...]


class Tables(ABC):
    """All tokens of a reactor; a row is a place in the record."""

    def __init__(self, tokens: Sequence[TokenRecord], keys: Array, texts: Texts) -> None:
        self.tokens = tokens
        self.texts = texts
        self.keys = keys
        self.count = len(keys)
        self.is_ordered = bool((keys[1:] > keys[:-1]).all())
        none = np.zeros(self.count, bool)
        self.predicates: list[str] = []
        self.predicate: Array = np.zeros(self.count, np.int64)  # numbers of `predicates`
        self.is_active: Mask = none
        self.is_merged: Mask = none
        self.is_cut: Mask = none
        self.is_observed: Mask = none
        self.ticks: Array = np.zeros(self.count, np.int64)
        self.times: dict[int, Column] = {}  # object, duration, start and end, as each token has them itself
        self.standing: Array = np.arange(self.count)  # the row of the token that stands for each

    @abstractmethod
    def argument(self, predicate: int, number: int, rows: Array) -> Column:
        """A parameter of tokens that stand for themselves."""

    @abstractmethod
    def equals_standing(self, rows: Array) -> Mask:
        """Where merged tokens have the very predicate and values of those that stand for them."""

    @abstractmethod
    def groups(self, wanted: Mask, fewest: int) -> Iterator[TokenRows]:
        """Active tokens among the rows `wanted` that are alike, where there are `fewest` of them."""

    def rows_of(self, keys: Array) -> Array:
        """The rows of tokens by their keys; NOBODY where there is none."""
        if not self.count:
            return np.full(len(keys), NOBODY)
        found = np.minimum(np.searchsorted(self.keys, keys), self.count - 1)
        return np.where(self.keys[found] == keys, found, NOBODY)

    def find_standing(self, merged_into: Array) -> Array:
        """The row of the token that stands for each, from the keys that tokens are merged into."""
        found = np.arange(self.count)
        for _ in range(_DEEPEST if self.is_ordered else 0):
            into = merged_into[found]
            others = np.where(into == NOBODY, found, self.rows_of(into))
            others = np.where(others == NOBODY, found, others)
            if (others == found).all():
                break
            found = others
        return found


class RowTokens:
    """One token per row of a group: `rows` are their places in the record."""

    __slots__ = ("_columns", "rows", "standing", "tables")

    def __init__(self, tables: Tables, rows: Array) -> None:
        self.tables = tables
        self.rows = rows
        self.standing = tables.standing[rows]
        self._columns: dict[int, Column] = {}

    def column(self, variable: int) -> Column:
        """A variable of these tokens, of those that stand for them where they are merged."""
        known = self._columns.get(variable)
        if known is None:
            known = self._columns[variable] = self._read(variable)
        return known

    def _read(self, variable: int) -> Column:
        tables = self.tables
        if variable in (OBJECT, START, END):
            return tables.times[variable].take(self.standing)
        number = variable - FIRST_PARAMETER
        predicates = tables.predicate[self.standing]
        kinds = np.unique(predicates)
        if len(kinds) == 1:
            return tables.argument(int(kinds[0]), number, self.standing)
        parts: list[tuple[Mask, Column]] = []
        for kind in kinds.tolist():
            rows = predicates == kind
            parts.append((rows, tables.argument(kind, number, self.standing[rows])))
        return joined(parts, len(predicates))


def missing(count: int) -> Column:
    """A column of which no row fits."""
    return Column(TEXT, np.zeros(count, np.int64), None, np.ones(count, bool))
