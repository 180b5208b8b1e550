"""Tables from a record that was kept in columns, as simulators do: arrays in, arrays out."""

from collections.abc import Iterator
from math import inf

import numpy as np

from checker.judge.columns import FLOAT, INT, TEXT, Array, Column, Mask, Texts
from checker.judge.tables import GuardRows, RunRows, Tables, TokenRows, missing
from compiler.program import DURATION, END, OBJECT, START
from runtime.executive.columns import ORIGINS, RunColumns, TokenColumns, ValueColumn

_ACTIVE, _MERGED = range(2)  # states, by number


class ColumnTables(Tables):
    """All tokens of a reactor that kept columns; nothing was ever cut off there."""

    def __init__(self, columns: TokenColumns) -> None:
        times = columns.times
        super().__init__(columns, np.asarray(times.keys), Texts())
        self._groups = columns.groups
        self.predicates = list(columns.names)
        self.predicate = np.asarray(times.predicates)
        self.is_active = times.states == _ACTIVE
        self.is_merged = times.states == _MERGED
        self.is_observed = times.origins == ORIGINS.index("observation")
        self.ticks = np.asarray(times.ticks)
        self._texts_of_names = np.array([self.texts.number(each) for each in columns.names], np.int64)
        self._texts_of_symbols = np.array([self.texts.number(each) for each in columns.symbols], np.int64)
        has_begun = self.is_active | self.is_merged
        starts, ends = np.asarray(times.starts), np.asarray(times.ends).astype(float)
        latest = np.where(has_begun, starts, inf)
        most = np.where(has_begun, times.latest, inf)
        self.times = {
            OBJECT: Column(TEXT, self._texts_of_names[times.objects]),
            DURATION: Column(INT, np.where(has_begun, ends - starts, 1.0), np.where(has_begun, most - starts, inf)),
            START: Column(INT, starts.astype(float), latest),
            END: Column(INT, ends, most),
        }
        self.standing = self.find_standing(np.asarray(times.merged_into))
        self._arguments: dict[tuple[int, int], Column] = {}
        self._places = np.full(self.count, -1)  # among the tokens of the predicate; -1 reads the row that never fits
        self._rows: dict[int, Array] = {}
        for predicate in np.unique(self.predicate).tolist():
            alike = [group.places for group in self._groups if group.predicate == self.predicates[predicate]]
            rows = self._rows[predicate] = np.concatenate([np.empty(0, np.int64), *alike])
            self._places[rows] = np.arange(len(rows))

    def argument(self, predicate: int, number: int, rows: Array) -> Column:
        """A parameter of tokens that stand for themselves."""
        known = self._arguments.get((predicate, number))
        if known is None:
            groups = [group for group in self._groups if group.predicate == self.predicates[predicate]]
            if not groups or not 0 <= number < len(groups[0].arguments):
                return missing(len(rows))
            known = self._joined([group.arguments[number] for group in groups])
            self._arguments[predicate, number] = known
        return known.take(self._places[rows])

    def _joined(self, parts: list[ValueColumn]) -> Column:
        """One column of some, with a row behind the last that never fits."""
        columns = [self._column(part) for part in parts]
        lower = np.concatenate([*(each.lower for each in columns), np.zeros(1, columns[0].lower.dtype)])
        bad = np.zeros(len(lower), bool)
        bad[-1] = True
        at = 0
        for each in columns:
            if each.bad is not None:
                bad[at : at + len(each.lower)] = each.bad
            at += len(each.lower)
        return Column(columns[0].kind, lower, None, bad)

    def _column(self, given: ValueColumn, chosen: Array | None = None) -> Column:
        """A column of the record, or some of its rows; what was never fixed does not fit."""
        numbers = given.numbers if chosen is None else given.numbers[chosen]
        bad = np.isnan(numbers) if numbers.dtype.kind == "f" else None
        if bad is not None and not bad.any():
            bad = None
        if given.kind == "float":
            return Column(FLOAT, numbers.astype(float), None, bad)
        whole = numbers if bad is None else np.where(bad, 0, numbers)
        whole = whole.astype(np.int64)
        if given.kind == "name":
            return Column(TEXT, self._texts_of_symbols[whole] if len(self._texts_of_symbols) else whole, None, bad)
        return Column(INT, whole, None, bad)

    def equals_standing(self, rows: Array) -> Mask:
        """Where merged tokens have the very predicate and times; their arguments are those of the one that stands."""
        others = self.standing[rows]
        same = np.asarray(self.predicate[rows] == self.predicate[others])
        for each in (START, END):
            mine, theirs = self.times[each].take(rows), self.times[each].take(others)
            same &= mine.lower == theirs.lower
            if mine.upper is not None or theirs.upper is not None:
                both = [one.lower if one.upper is None else one.upper for one in (mine, theirs)]
                same &= both[0] == both[1]
        return same

    def groups(self, wanted: Mask, fewest: int) -> Iterator[TokenRows]:
        """Active tokens among the rows `wanted` that are alike, where there are `fewest` of them."""
        for group in self._groups:
            chosen = np.flatnonzero(wanted[group.places])
            if len(chosen) >= fewest:
                some = None if len(chosen) == len(group.places) else chosen
                rows = group.places if some is None else group.places[some]
                yield TokenRows(group.predicate, rows, tuple(self._run_rows(run, some) for run in group.runs))

    def _run_rows(self, run: RunColumns, chosen: Array | None) -> RunRows:
        """Runs of the record, or some of their rows."""
        named = tuple(self._column(each, chosen) for each in run.locals)
        children = tuple(each if chosen is None else each[chosen] for each in run.children)
        guards = tuple(
            GuardRows(each.branch, True, None if each.run is None else self._run_rows(each.run, chosen))
            for each in run.guards
        )
        return RunRows(run.rule, named, children, guards)
