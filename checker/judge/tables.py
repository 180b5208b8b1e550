"""The record of a reactor as tables: times and keys of all tokens in arrays, arguments in one column per parameter.

This is the one place that reads many `TokenRecord`s at once; what else the judge asks of a record it asks token by
token.
"""

from collections.abc import Sequence

import numpy as np

from checker.judge.columns import TEXT, Array, Column, Mask, Texts, column_of, joined
from compiler.program import DURATION, END, FIRST_PARAMETER, OBJECT, START
from runtime.executive.record import NOBODY, BodyRun, ReactorRecord, TokenRecord, Value

_DEEPEST = 64  # merged into what is merged into ...
Shape = tuple["RunShape", ...]  # of all runs of a token
RunShape = tuple[int, int, int, tuple["_GuardShape", ...]]  # rule, how many locals and children, guards
_GuardShape = tuple[str, bool, RunShape | None]  # branch, whether it is decided, what it ran


class PredicateTable:
    """The tokens of one predicate that stand for themselves: a column per parameter, made when asked for."""

    def __init__(self, tokens: Sequence[TokenRecord], texts: Texts) -> None:
        self.texts = texts
        self.width = min((len(one.arguments) for one in tokens), default=0)
        self._arguments: list[tuple[Value, ...]] = list(zip(*[one.arguments for one in tokens], strict=False))
        self._columns: dict[int, Column] = {}

    def column(self, number: int) -> Column:
        """The values of a parameter."""
        known = self._columns.get(number)
        if known is None:
            known = self._columns[number] = column_of(self._arguments[number], self.texts)
        return known


class Tables:
    """All tokens of a reactor; a row is a place in the record."""

    def __init__(self, record: ReactorRecord) -> None:
        self.texts = Texts()
        self.tokens = record.tokens
        fields = tuple(zip(*record.tokens, strict=True)) or ((),) * len(TokenRecord._fields)
        keys, predicates, objects, states, durations, starts, ends, _, merged, origins, fates, ticks, runs = fields
        self.count = len(keys)
        self.keys = np.array(keys, np.int64)
        self.is_ordered = bool((self.keys[1:] > self.keys[:-1]).all())
        self.predicates = list(dict.fromkeys(predicates))
        numbers = {name: k for k, name in enumerate(self.predicates)}
        self.predicate = np.array([numbers[each] for each in predicates], np.int64)
        self.is_active = np.array([each == "active" for each in states], bool)
        self.is_merged = np.array([each == "merged" for each in states], bool)
        self.is_cut = np.array([each == "cut" for each in fates], bool)
        self.origins: tuple[str, ...] = origins
        self.ticks = np.array(ticks, np.int64)
        self.merged_into = np.array(merged, np.int64)
        self.runs: tuple[tuple[BodyRun, ...], ...] = runs
        self.times = {
            OBJECT: column_of(objects, self.texts),
            DURATION: column_of(durations, self.texts),
            START: column_of(starts, self.texts),
            END: column_of(ends, self.texts),
        }
        self.standing = self._standing() if self.is_ordered else np.arange(self.count)
        own = np.where(self.standing == np.arange(self.count), self.predicate, NOBODY)
        order = np.argsort(own, kind="stable")
        ordered = own[order]
        self._kinds = own
        self.places = np.empty(self.count, np.int64)  # of each row in the table of its predicate
        self.places[order] = np.arange(self.count) - np.searchsorted(ordered, ordered)
        self._tables: dict[int, PredicateTable] = {}

    def rows_of(self, keys: Array) -> Array:
        """The rows of tokens by their keys; NOBODY where there is none."""
        if not self.count:
            return np.full(len(keys), NOBODY)
        found = np.minimum(np.searchsorted(self.keys, keys), self.count - 1)
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

    def table(self, predicate: int) -> PredicateTable:
        """The tokens of one predicate."""
        known = self._tables.get(predicate)
        if known is None:
            rows = np.flatnonzero(self._kinds == predicate)
            known = PredicateTable([self.tokens[k] for k in rows.tolist()], self.texts)
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
        kinds = np.unique(predicates)
        if len(kinds) == 1:
            return self._part(int(kinds[0]), number, places)
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


def shape_of(runs: tuple[BodyRun, ...]) -> Shape:
    """What runs of a token have in common with those of others: rules, branches, and how much each has made."""
    return tuple([_run_shape(run) for run in runs])


def _run_shape(run: BodyRun) -> RunShape:
    guards = run.guards
    if not guards:
        return (run.rule, len(run.locals), len(run.children), ())
    inner = tuple([(g.branch, g.is_decided, None if g.run is None else _run_shape(g.run)) for g in guards])
    return (run.rule, len(run.locals), len(run.children), inner)
