"""What a determined reactor has told, as the columns that a trace expands: of its log, or kept apart for others."""

from typing import NamedTuple

import numpy as np

from runtime.determined.arguments import arguments_at, arguments_from, shapes_of
from runtime.determined.loading import ParameterShape, RegisterProgram
from runtime.determined.log import Log
from runtime.determined.tags import CAUSE, KIND, LINE, ROW, VALUES
from runtime.executive.columns import Array, PublishedColumns, StoredValues, table_of
from runtime.executive.messages import Arguments
from runtime.executive.outcome import Event, EventKind, Phase
from runtime.plan.readout.names import TokenName


def _observation(
    reactor: str,
    head: tuple[int, str, str],
    arguments: Arguments,
    causes: tuple[int, ...],
    token: TokenName,
) -> Event:
    """The event of an observation; `head` has its tick, timeline and predicate."""
    tick, timeline, predicate = head
    kind = EventKind.OBSERVATION
    return Event(tick, Phase.OBSERVE, kind, reactor, timeline, predicate, arguments, causes, token)


class Told:
    """The columns of a log; sent to another process, they leave it."""

    def __init__(self, name: str, program: RegisterProgram, log: Log) -> None:
        self.name = name
        self.program = program
        self.log = log

    def head(self, index: int) -> tuple[int, str, str]:
        """Tick, timeline and predicate of an observation, by its index among those that were told."""
        tick, line, predicate, *_ = self.log.row(self.log.told[index])
        return tick, self.program.model.lines[line].name, self.program.model.short_names[predicate]

    def causes(self, index: int) -> tuple[int, ...]:
        """What caused an observation: what the timeline held before, or a request."""
        cause = self.log.rows[ROW * self.log.told[index] + CAUSE]
        return (cause,) if cause >= 0 else ()

    def event(self, index: int) -> Event:
        """An event of the trace."""
        row = self.log.told[index]
        _, _, predicate, _, first, *_ = self.log.row(row)
        code = self.program.model.program.predicates[predicate]
        arguments = arguments_at(shapes_of(self.program, code), self.program.all_names(), self.log, first)
        return _observation(self.name, self.head(index), arguments, self.causes(index), TokenName(code.name, row))

    def published(self) -> tuple[PublishedColumns, ...]:
        """All observations that were told, by timeline and predicate."""
        program, values, symbols = self.program, np.asarray(self.log.values), self.program.all_names()
        found = []
        for line, predicate, indices, at in self._kinds():
            rows = np.asarray(self.log.rows)
            parameters = program.model.program.predicates[predicate].parameters
            arguments = StoredValues(values, rows.take(at + VALUES), tuple([each.type.kind for each in parameters]))
            name, short = program.model.lines[line].name, program.model.short_names[predicate]
            given = tuple([each.name for each in parameters])
            found.append(PublishedColumns(name, short, rows.take(at), given, arguments, indices, symbols))
        return tuple(found)

    def first_of(self, predicate: str) -> tuple[int, str] | None:
        """Tick and timeline of the first observation of a predicate, by name at one tick; None if there is none."""
        names = self.program.model.short_names
        if predicate not in names:
            return None
        is_meant = np.array([name == predicate for name in names])
        told = np.flatnonzero(is_meant.take(np.asarray(self.log.rows).take(self._starts() + KIND)))
        first = told[: len(self.program.model.lines)]  # among them all of the first tick
        return min((self.head(index)[:2] for index in first.tolist()), default=None)

    def _starts(self) -> Array:
        """Where the rows of the log begin that were told."""
        return ROW * np.asarray(self.log.told)[: self.log.told_count]

    def _kinds(self) -> list[tuple[int, int, Array, Array]]:
        """What was told by timeline and predicate: indices, and where the rows of the log begin."""
        starts = self._starts()
        rows, many = np.asarray(self.log.rows), len(self.program.model.short_names)
        kinds = rows.take(starts + LINE) * many + rows.take(starts + KIND)
        found = []
        for kind in np.flatnonzero(np.bincount(kinds)).tolist():
            indices = np.flatnonzero(kinds == kind)
            found.append((*divmod(kind, many), indices, starts.take(indices)))
        return found

    def __reduce__(self) -> tuple[type, tuple[object, ...]]:
        return self.stored().__reduce__()

    def stored(self) -> "StoredObservations":
        """The same without the log."""
        program, rows, values = self.program, np.asarray(self.log.rows), np.asarray(self.log.values)
        kinds = []
        for line, predicate, indices, at in self._kinds():
            code = program.model.program.predicates[predicate]
            shapes = tuple([shape[:3] for shape in shapes_of(program, code)])
            table = table_of(values, rows.take(at + VALUES), range(len(shapes)))
            kinds.append(
                StoredKind(
                    program.model.lines[line].name,
                    program.model.short_names[predicate],
                    code.name,
                    shapes,
                    indices,
                    rows.take(at),
                    at // ROW,
                    rows.take(at + CAUSE),
                    np.ascontiguousarray(table.T),
                )
            )
        return StoredObservations(self.name, tuple(kinds), tuple(program.all_names()))


class StoredKind(NamedTuple):
    """Observations of one predicate on one timeline; `values` has a row for each of them."""

    timeline: str
    predicate: str
    full_name: str
    shapes: tuple[tuple[str, str, str], ...]  # name, kind and type of each parameter
    indices: Array
    ticks: Array
    rows: Array
    causes: Array
    values: Array


class StoredObservations:
    """The same columns without the log."""

    def __init__(self, name: str, kinds: tuple[StoredKind, ...], symbols: tuple[str, ...]) -> None:
        self.name = name
        self.kinds = kinds
        self.symbols = symbols
        count = sum(len(each.indices) for each in kinds)
        self._kind_of = np.zeros(count, np.int64)
        self._row = np.zeros(count, np.int64)
        for number, each in enumerate(kinds):
            self._kind_of[each.indices] = number
            self._row[each.indices] = np.arange(len(each.indices))
        self._shapes: list[list[ParameterShape]] = [[(*shape, None) for shape in each.shapes] for each in kinds]

    def head(self, index: int) -> tuple[int, str, str]:
        """Tick, timeline and predicate of an observation."""
        kind = self.kinds[self._kind_of[index]]
        return int(kind.ticks[self._row[index]]), kind.timeline, kind.predicate

    def causes(self, index: int) -> tuple[int, ...]:
        """What caused an observation."""
        cause = int(self.kinds[self._kind_of[index]].causes[self._row[index]])
        return (cause,) if cause >= 0 else ()

    def event(self, index: int) -> Event:
        """An event of the trace."""
        number, row = int(self._kind_of[index]), int(self._row[index])
        kind = self.kinds[number]
        arguments = arguments_from(self._shapes[number], self.symbols, kind.values[row].tolist())
        token = TokenName(kind.full_name, int(kind.rows[row]))
        return _observation(self.name, self.head(index), arguments, self.causes(index), token)

    def published(self) -> tuple[PublishedColumns, ...]:
        """All observations, by timeline and predicate."""
        found = []
        for each in self.kinds:
            width = len(each.shapes)
            first = np.arange(len(each.indices)) * width
            arguments = StoredValues(each.values.ravel(), first, tuple([kind for _, kind, _ in each.shapes]))
            given = tuple([name for name, _, _ in each.shapes])
            found.append(
                PublishedColumns(
                    each.timeline, each.predicate, each.ticks, given, arguments, each.indices, self.symbols
                )
            )
        return tuple(found)

    def first_of(self, predicate: str) -> tuple[int, str] | None:
        """Tick and timeline of the first observation of a predicate, by name at one tick; None if there is none."""
        of_kinds = ((int(each.ticks[0]), each.timeline) for each in self.kinds if each.predicate == predicate)
        return min(of_kinds, default=None)

    def stored(self) -> "StoredObservations":
        """These."""
        return self

    def __reduce__(self) -> tuple[type, tuple[object, ...]]:
        return StoredObservations, (self.name, self.kinds, self.symbols)
