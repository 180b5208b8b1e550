"""Judge timelines at once: where tokens plainly follow each other, and plainly are what their owner published."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import nan

import numpy as np

from checker.judge.alike import SymbolNumbers
from checker.judge.bench import Bench
from checker.judge.columns import TEXT, Array, Column, distinct
from checker.judge.tables import Tables
from compiler.program import END, OBJECT, START, PredicateCode
from runtime.executive.columns import PublishedColumns, StoredValues
from runtime.executive.event_parts import EventColumns
from runtime.executive.outcome import Event
from runtime.executive.record import TokenRecord, Value

_NUMBERS = ("int", "float", "bool")  # kinds; others have names


@dataclass(eq=False, slots=True)
class Publications:
    """What was published on one timeline: events one by one, and those that are kept as columns."""

    single: list[Event] = field(default_factory=list)
    columns: list[tuple[EventColumns, PublishedColumns]] = field(default_factory=list)

    def events(self, last_tick: int) -> list[Event]:
        """All up to a tick, in order; of several in one tick the last."""
        found: dict[int, Event] = {}
        for source, each in self.columns:
            for tick, index in zip(each.ticks.tolist(), each.indices.tolist(), strict=True):
                if tick <= last_tick:
                    found[tick] = source.event(index)
        found |= {one.tick: one for one in self.single if one.tick <= last_tick}
        return [found[tick] for tick in sorted(found)]


History = dict[str, Publications]  # by timeline


def count_held(
    tokens: Sequence[TokenRecord],
    published: Publications,
    last_tick: int,
    codes: Mapping[str, PredicateCode],
    observed: set[int] | None,
) -> int:
    """How many publications agree with the active tokens of a timeline; -1 if not all plainly do, one per token.

    `observed` are the ticks at which a reactor took note of something, None on its own timelines.
    """
    begun = {one.start: one for one in tokens if one.fate != "cut"}
    if len(begun) < len(tokens) or (observed is not None and not begun.keys() <= observed):
        return -1
    told: set[Value] = set()
    count = 0
    for event in published.single:
        if event.tick <= last_tick:
            held = begun.get(event.tick)
            if held is None or not _agrees(held, event, codes):
                return -1
            told.add(event.tick)
            count += 1
    for _, each in published.columns:
        ticks, arguments = each.ticks.tolist(), each.arguments
        if ticks and max(ticks) > last_tick:
            rows = np.flatnonzero(each.ticks <= last_tick)
            ticks, arguments = each.ticks.take(rows).tolist(), arguments._replace(first=arguments.first.take(rows))
        fitting: set[str] = set()  # predicates that have the parameters that were published
        for tick, given in zip(ticks, _listed(arguments, each.symbols), strict=True):
            held = begun.get(tick)
            if held is None or held.arguments != given:
                return -1
            if held.predicate not in fitting:
                names = tuple([one.name for one in codes[held.predicate].parameters])
                if held.predicate.rpartition(".")[2] != each.predicate or each.parameters != names:
                    return -1
                fitting.add(held.predicate)
            told.add(tick)
        count += len(ticks)
    return count if count == len(told) == len(begun) else -1


def _listed(arguments: StoredValues, symbols: Sequence[str]) -> list[tuple[Value, ...]]:
    """Arguments row by row; what was left open is not a number, and equals nothing."""
    store, first, width = arguments.store, arguments.first, len(arguments.kinds)
    if len(first) and not 0 <= first.min() <= first.max() <= len(store) - width:
        return [(nan,)] * len(first)
    table = store.take(first[:, np.newaxis] + np.arange(width)).tolist()
    names = [k for k, kind in enumerate(arguments.kinds) if kind not in _NUMBERS]
    for row in table:
        for k in names:
            if row[k] == row[k]:
                row[k] = symbols[int(row[k])]
    return list(map(tuple, table))


class BulkTimelines:
    """The tokens that have begun on each timeline of a reactor, in order: `rows` are indices in the record."""

    def __init__(self, bench: Bench, tables: Tables, timelines: frozenset[str]) -> None:
        self.bench = bench
        self.tables = tables
        self.rows: dict[str, Array] = {}
        start, end, thing = (tables.times[each] for each in (START, END, OBJECT))
        self.starts = start.lower
        self.least = end.lower
        self.most = end.lower if end.upper is None else end.upper
        self.bad = np.zeros(tables.count, bool)
        for column in (start, end):
            if column.bad is not None:
                self.bad |= column.bad
        begun = tables.is_active & (self.starts <= bench.last_tick)
        if start.open is not None:
            begun &= ~start.open
        begun &= (self.starts >= 0) | (self.most > 0)  # what the script tells of the time before the mission
        if thing.kind != TEXT or not tables.count:
            return
        if thing.bad is not None:
            begun &= ~thing.bad
        self.things = thing.lower
        rows = np.flatnonzero(begun | (tables.is_active & self.bad))
        things = self.things[rows]
        for number in np.flatnonzero(np.bincount(things)).tolist():
            name = tables.texts.names[number]
            if bench.members.get(name, ("",))[0] in timelines:
                self.rows[name] = self._in_order(rows[things == number])

    def _in_order(self, rows: Array) -> Array:
        """Tokens of one timeline in the order of their starts, which mostly is that of the record."""
        starts, most = self.starts[rows], self.most[rows]
        is_later = (starts[1:] > starts[:-1]) | ((starts[1:] == starts[:-1]) & (most[1:] >= most[:-1]))
        if self.tables.is_ordered and is_later.all():
            return rows
        return np.asarray(rows[np.lexsort((self.tables.keys[rows], most, starts))])

    def _is_plain(self, rows: Array) -> bool:
        return self.tables.is_ordered and not (self.tables.is_cut[rows] | self.bad[rows]).any()

    def is_in_order(self, timeline: str, is_shared: bool) -> bool:
        """Whether tokens plainly follow each other, on a shared timeline without a gap; if so it is counted."""
        rows = self.rows[timeline]
        if not self._is_plain(rows):
            return False
        ends, nexts = self.least[rows[:-1]], self.starts[rows[1:]]
        holds = (ends == self.most[rows[:-1]]) & ((ends == nexts) if is_shared else (ends <= nexts))
        if not holds.all() or (is_shared and self.most[rows[-1]] <= self.bench.last_tick):
            return False
        self.bench.judged += len(rows)
        return True

    def is_told(self, timeline: str, published: Publications, codes: Mapping[str, PredicateCode], is_own: bool) -> bool:
        """Whether each token plainly began with what was published, and nothing else was; if so it is counted."""
        rows = self.rows.get(timeline, np.empty(0, np.int64))
        if not self._is_plain(rows) or not (is_own or self._are_observed(rows)):
            return False
        if published.columns and not published.single:
            count = self._told_in_columns(rows, [each for _, each in published.columns], codes)
        else:
            count = self._told_one_by_one(rows, published.events(self.bench.last_tick), codes)
        self.bench.judged += max(count, 0)
        return count >= 0

    def _are_observed(self, rows: Array) -> bool:
        """Whether at the beginning of each token something was observed, which may have been merged into it."""
        tables = self.tables
        if tables.is_observed[rows].all():
            return True
        is_seen = tables.is_observed & (tables.is_active | tables.is_merged) & (self.things == self.things[rows[0]])
        start = tables.times[START]
        if start.bad is not None:
            is_seen &= ~start.bad
        if start.open is not None:
            is_seen &= ~start.open
        return set(self.starts[rows].tolist()) <= set(self.starts[is_seen].tolist())

    def _told_one_by_one(self, rows: Array, published: Sequence[Event], codes: Mapping[str, PredicateCode]) -> int:
        """How many publications agree with the tokens; -1 if not all plainly do."""
        tokens = self.tables.tokens
        told = {one.tick: one for one in published}
        begun = dict(zip(self.starts[rows].tolist(), rows.tolist(), strict=True))
        if told.keys() != begun.keys():
            return -1
        return len(told) if all(_agrees(tokens[row], told[tick], codes) for tick, row in begun.items()) else -1

    def _told_in_columns(
        self, rows: Array, columns: Sequence[PublishedColumns], codes: Mapping[str, PredicateCode]
    ) -> int:
        """The same where publications are kept as columns."""
        tables, last, count = self.tables, self.bench.last_tick, 0
        kinds = tables.predicate[rows]
        shorts = {tables.predicates[kind].rpartition(".")[2]: kind for kind in distinct(kinds)[0]}
        for each in columns:
            told = np.flatnonzero(each.ticks <= last)
            kind = shorts.get(each.predicate)
            if kind is None and len(told):
                return -1
            if kind is None:
                continue
            own = rows[kinds == kind]
            if not np.array_equal(self.starts[own], each.ticks[told]):
                return -1
            if each.parameters != tuple([one.name for one in codes[tables.predicates[kind]].parameters]):
                return -1
            if not self._are_told(kind, own, each, told):
                return -1
            count += len(told)
        return count if count == len(rows) else -1

    def _are_told(self, kind: int, rows: Array, published: PublishedColumns, told: Array) -> bool:
        """Whether tokens plainly have the arguments that were published."""
        tables, given = self.tables, published.arguments
        arguments = tables.arguments
        if _is_same_store(tables.tokens.store, given.store):
            if np.array_equal(tables.tokens.times.values.take(rows), given.first.take(told)):
                return True  # they are the same numbers
        numbers, own = SymbolNumbers(published.symbols, tables.texts), arguments(kind, rows)
        columns = enumerate(given._replace(first=given.first.take(told)).columns())
        return all(_are_same(own.column(index), numbers.column(column)) for index, column in columns)


def _is_same_store(one: Array, other: Array) -> bool:
    """Whether two arrays are of the same memory."""
    return bool(one.__array_interface__["data"] == other.__array_interface__["data"])


def _are_same(mine: Column, theirs: Column) -> bool:
    """Whether two columns plainly have the same values; one that is open agrees with what was left open."""
    if mine.kind != theirs.kind or mine.bad is not None or theirs.bad is not None:
        return False
    if not (mine.lower == theirs.lower).all():
        return False
    upper, other = (each.lower if each.upper is None else each.upper for each in (mine, theirs))
    return (mine.upper is None and theirs.upper is None) or bool((upper == other).all())


def _agrees(held: TokenRecord, one: Event, codes: Mapping[str, PredicateCode]) -> bool:
    """Whether a token plainly holds what was published: all parameters in order, with the same single values."""
    if held.predicate.rpartition(".")[2] != one.predicate:
        return False
    if not one.arguments:
        return True
    parameters = codes[held.predicate].parameters
    if len(parameters) != len(one.arguments):
        return False
    for (name, domain), parameter, value in zip(one.arguments, parameters, held.arguments, strict=False):
        holds = domain.interval == (value, value) if domain.values is None else domain.values == (value,)
        if name != parameter.name or not holds:
            return False
    return True
