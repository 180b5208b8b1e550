"""Judge timelines at once: where tokens plainly follow each other, and plainly are what their owner published."""

from collections.abc import Mapping, Sequence

import numpy as np

from checker.judge.bench import Bench
from checker.judge.columns import TEXT, Array
from checker.judge.tables import Tables
from compiler.program import END, OBJECT, START, PredicateCode
from runtime.executive.outcome import Event
from runtime.executive.record import TokenRecord

# What owners published, by timeline, from which tick on; of several in one tick the last.
History = dict[str, list[Event]]


class BulkTimelines:
    """The tokens that have begun on each timeline of a reactor, in order: `rows` are places in the record."""

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
        order = np.lexsort((tables.keys[rows], self.most[rows], self.starts[rows], self.things[rows]))
        rows = rows[order]
        numbers, firsts = np.unique(self.things[rows], return_index=True)
        for number, part in zip(numbers.tolist(), np.split(rows, firsts[1:]), strict=False):
            name = tables.texts.names[number]
            if bench.members.get(name, ("",))[0] in timelines:
                self.rows[name] = part

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

    def is_told(
        self, timeline: str, published: Sequence[Event], codes: Mapping[str, PredicateCode], is_own: bool
    ) -> bool:
        """Whether each token plainly began with what was published, and nothing else was; if so it is counted."""
        rows = self.rows.get(timeline, np.empty(0, np.int64))
        if not self._is_plain(rows):
            return False
        tables = self.tables
        told = {one.tick: one for one in published}
        begun = dict(zip(self.starts[rows].tolist(), rows.tolist(), strict=True))
        if told.keys() != begun.keys():
            return False
        if not is_own and not tables.is_observed[list(begun.values())].all():
            return False
        tokens = tables.tokens
        if not all(_agrees(tokens[row], told[tick], codes) for tick, row in begun.items()):
            return False
        self.bench.judged += len(told)
        return True


def _agrees(held: TokenRecord, one: Event, codes: Mapping[str, PredicateCode]) -> bool:
    """Whether a token plainly holds what was published: all parameters in order, with the same single values."""
    if held.predicate.rpartition(".")[2] != one.predicate:
        return False
    if not one.arguments:
        return True
    parameters = codes[held.predicate].parameters
    return len(parameters) == len(one.arguments) and all(
        name == parameter.name
        and (domain.interval == (value, value) if domain.values is None else domain.values == (value,))
        for (name, domain), parameter, value in zip(one.arguments, parameters, held.arguments, strict=False)
    )
