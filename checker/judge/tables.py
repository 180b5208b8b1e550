"""The record of a reactor as tables: times and keys of all tokens in arrays, arguments in one column per parameter.

Here and in `checker.judge.alike` many tokens of a record are read at once; what else the judge asks of a record it asks
token by token.
"""

from collections.abc import Sequence

import numpy as np

from checker.judge.alike import ArgumentTable
from checker.judge.columns import INT, TEXT, Array, Column, Mask, Texts, column_of, joined
from compiler.program import DURATION, END, FIRST_PARAMETER, OBJECT, START
from runtime.executive.columns import ORIGINS, TokenColumns
from runtime.executive.record import NOBODY, ReactorRecord, TokenRecord

_DEEPEST = 64  # merged into what is merged into ...
_ACTIVE, _MERGED = 0, 1


class Tables:
    """All tokens of a reactor; a row is a place in the record."""

    def __init__(self, record: ReactorRecord) -> None:
        self.texts = Texts()
        self.tokens = record.tokens
        if isinstance(record.tokens, TokenColumns):
            self._take(record.tokens)
        else:
            self._read(record.tokens)
        self.count = len(self.keys)
        self.is_ordered = bool((self.keys[1:] > self.keys[:-1]).all())
        self._is_gapless = self.is_ordered and self.count > 0 and self.keys[0] == 0 and self.keys[-1] == self.count - 1
        self.standing = self._standing() if self.is_ordered else np.arange(self.count)
        own = np.where(self.standing == np.arange(self.count), self.predicate, NOBODY)
        order = np.argsort(own, kind="stable")
        ordered = own[order]
        self._kinds = own
        self.places = np.empty(self.count, np.int64)  # of each row in the table of its predicate
        self.places[order] = np.arange(self.count) - np.searchsorted(ordered, ordered)
        self._tables: dict[int, ArgumentTable] = {}

    def _read(self, tokens: Sequence[TokenRecord]) -> None:
        """Read tokens one by one."""
        fields = tuple(zip(*tokens, strict=True)) or ((),) * len(TokenRecord._fields)
        keys, predicates, objects, states, durations, starts, ends, _, merged, origins, fates, ticks, _ = fields
        self.keys: Array = np.array(keys, np.int64)
        self.predicates: list[str] = list(dict.fromkeys(predicates))
        numbers = {name: k for k, name in enumerate(self.predicates)}
        self.predicate: Array = np.array([numbers[each] for each in predicates], np.int64)
        self.is_active: Mask = np.array([each == "active" for each in states], bool)
        self.is_merged: Mask = np.array([each == "merged" for each in states], bool)
        self.is_cut: Mask = np.array([each == "cut" for each in fates], bool)
        self.is_observed: Mask = np.array([each == "observation" for each in origins], bool)
        self.ticks: Array = np.array(ticks, np.int64)
        self.merged_into: Array = np.array(merged, np.int64)
        self.times: dict[int, Column] = {
            OBJECT: column_of(objects, self.texts),
            DURATION: column_of(durations, self.texts),
            START: column_of(starts, self.texts),
            END: column_of(ends, self.texts),
        }

    def _take(self, tokens: TokenColumns) -> None:
        """Take tokens that were recorded in columns; what is inactive has no times yet."""
        times, names = tokens.times, np.array([self.texts.number(name) for name in tokens.names], np.int64)
        self.keys, self.ticks, self.merged_into = times.keys, times.ticks, times.merged_into
        self.predicates, self.predicate = list(tokens.names), times.predicates
        self.is_active, self.is_merged = times.states == _ACTIVE, times.states == _MERGED
        self.is_cut = np.zeros(len(self.keys), bool)
        self.is_observed = times.origins == ORIGINS.index("observation")
        is_open = times.ends != times.latest
        begun = self.is_active | self.is_merged
        starts = Column(INT, times.starts)
        if not begun.all():
            starts = Column(INT, times.starts.astype(float), np.where(begun, times.starts, np.inf))
        ends, durations = Column(INT, times.ends), Column(INT, times.ends - times.starts)
        if is_open.any():
            least = np.where(begun, times.ends - times.starts, 1).astype(float)
            ends = Column(INT, times.ends.astype(float), times.latest)
            durations = Column(INT, least, np.where(begun, times.latest - times.starts, np.inf))
        self.times = {
            OBJECT: Column(TEXT, names[times.objects]),
            DURATION: durations,
            START: starts,
            END: ends,
        }

    def rows_of(self, keys: Array) -> Array:
        """The rows of tokens by their keys; NOBODY where there is none."""
        if not self.count:
            return np.full(len(keys), NOBODY)
        found = np.minimum(keys if self._is_gapless else np.searchsorted(self.keys, keys), self.count - 1)
        return np.where(self.keys[found] == keys, found, NOBODY)

    def _standing(self) -> Array:
        """The row of the token that stands for each."""
        found = np.arange(self.count)
        for _ in range(_DEEPEST):
            into = self.merged_into[found]
            others = np.where(into == NOBODY, found, self.rows_of(into))
            others = np.where(others == NOBODY, found, others)
            if (others == found).all():
                break
            found = others
        return found

    def table(self, predicate: int) -> ArgumentTable:
        """The tokens of one predicate."""
        known = self._tables.get(predicate)
        if known is None:
            rows = np.flatnonzero(self._kinds == predicate)
            known = ArgumentTable(self.tokens, self.predicates[predicate], rows, self.texts)
            self._tables[predicate] = known
        return known


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
        places = tables.places[self.standing]
        if len(predicates) and (predicates == predicates[0]).all():
            return self._part(int(predicates[0]), number, places)
        kinds = np.unique(predicates)
        parts: list[tuple[Mask, Column]] = []
        for kind in kinds.tolist():
            rows = predicates == kind
            parts.append((rows, self._part(kind, number, places[rows])))
        return joined(parts, len(places))

    def _part(self, predicate: int, number: int, places: Array) -> Column:
        table = self.tables.table(predicate)
        if not 0 <= number < table.width:
            return Column(TEXT, np.zeros(len(places), np.int64), None, np.ones(len(places), bool))
        return table.column(number).take(places)
