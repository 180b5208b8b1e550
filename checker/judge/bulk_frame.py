"""One run of a body for many tokens at once: the rows that plainly hold so far, and what was counted of each."""

from collections.abc import Callable, Iterator

import numpy as np

from checker.judge.alike import BranchRows, GuardRows, RunRows
from checker.judge.bench import Bench
from checker.judge.bulk_meanings import difference_of
from checker.judge.columns import INT, TEXT, Array, Column, Mask, Texts, column_of, constant, distinct, unknown
from checker.judge.operands import VariableNames, domain_value, member_of
from checker.judge.tables import RowTokens, Tables
from compiler.program import (
    DURATION,
    END,
    START,
    STATE,
    Constant,
    Field,
    GlobalVariable,
    LocalVariable,
    Operand,
    TokenVariable,
    UnionOf,
)
from runtime.executive.record import Value


class UnplainError(Exception):
    """A group of runs that only the judge of single tokens can judge."""


class RowTally:
    """What is known of each row of a group: whether all plainly holds, how much was judged and left open."""

    def __init__(self, count: int) -> None:
        self.count = count
        self.holds: Mask = np.ones(count, bool)
        self.judged = 0  # in each row
        self.more: list[Mask] = []  # judged in some rows
        self.open: list[Mask] = []
        self.skipped: dict[str, int] = {}  # in each row
        self.parts: list[tuple[Array, RowTally]] = []  # of some rows

    def need(self, holds: Mask) -> None:
        """Go on with the rows in which something holds."""
        self.holds &= holds

    def judge(self, holds: Mask) -> None:
        """Count one judgement of each row."""
        self.holds &= holds
        self.judged += 1

    def skip(self, reason: str) -> None:
        """Count something that is not judged."""
        self.skipped[reason] = self.skipped.get(reason, 0) + 1

    def add(self, rows: Array, part: "RowTally") -> None:
        """Add what was counted of some rows."""
        self.parts.append((rows, part))
        if not part.holds.all():
            self.holds[rows] &= part.holds

    def hand_over(self, bench: Bench, holds: Mask) -> None:
        """Add what was counted of the rows that hold."""
        count = int(np.count_nonzero(holds))
        bench.judged += self.judged * count + sum(int(np.count_nonzero(each & holds)) for each in self.more)
        bench.open += sum(int(np.count_nonzero(each & holds)) for each in self.open)
        for reason, times in self.skipped.items():
            if count:
                bench.skip(reason, times * count)
        for rows, part in self.parts:
            part.hand_over(bench, holds.take(rows))


class RowFrame:
    """One run of a body for each row: values in slots, tokens, and what the record says of the runs."""

    __slots__ = ("bench", "children", "guards", "locals", "rows", "slots", "tables", "tally", "tok", "tokens", "whole")

    def __init__(
        self, bench: Bench, tok: RowTokens, slots: list[Column | None], tokens: list[RowTokens | None]
    ) -> None:
        self.bench = bench
        self.tables: Tables = tok.tables
        self.tok = tok
        self.slots = slots
        self.tokens = tokens
        self.tally = RowTally(len(tok))
        self.whole: RowFrame | None = None  # the frame of which this one has some `rows`
        self.rows: Array | None = None
        self.locals: Iterator[Column] = iter(())
        self.children: Iterator[Array] = iter(())
        self.guards: Iterator[GuardRows] = iter(())

    def follow(self, run: RunRows) -> None:
        """Read what comes next from `run`."""
        self.locals = iter(run.locals)
        self.children = iter(run.children)
        self.guards = iter(run.guards)

    def branch(self, part: BranchRows) -> "RowFrame":
        """The frame of a branch in the rows that took it, with slots and tokens of its own."""
        if part.rows is None:
            inner = RowFrame(self.bench, self.tok, list(self.slots), list(self.tokens))
            inner.tally, inner.whole, inner.rows = self.tally, self.whole, self.rows
        else:
            parts = [None if each is None else each.part(part.rows) for each in self.tokens]
            assert parts[0] is not None
            inner = RowFrame(self.bench, parts[0], [None] * len(self.slots), parts)
            inner.whole, inner.rows = self, part.rows
        if part.run is not None:
            inner.follow(part.run)
        return inner

    def fit(self, column: Column) -> Column:
        """A column that is read: rows that do not fit are left to the judge of single tokens."""
        if column.bad is not None:
            self.tally.need(~column.bad)
        return column

    def use(self, column: Column) -> Column:
        """The same; rows that were never fixed are left, too."""
        self.fit(column)
        if column.upper is not None:
            self.tally.need(column.lower == column.upper)
        return column

    def slot(self, slot: int) -> Column | None:
        """The values in a slot; None if nothing is known of them."""
        column = self.slots[slot]
        if column is None and self.whole is not None and self.rows is not None:
            column = self.whole.slot(slot)
            column = self.slots[slot] = None if column is None else column.take(self.rows)
        return column


RowRead = Callable[[RowFrame], Column]
RowStep = Callable[[RowFrame], None]


def row_reader(operand: Operand, names: VariableNames) -> RowRead:
    """The function that reads `operand` in all rows."""
    match operand:
        case Constant(domain=domain):
            value = domain_value(domain)
            column = constant(value, Texts())
            if column.kind != TEXT:  # names are numbered anew for each record
                return lambda frame: column
            return lambda frame: constant(value, frame.tables.texts)
        case GlobalVariable(index=index):
            if index == names.clock:
                return _clock
            return lambda frame: constant(frame.bench.globals[index], frame.tables.texts)
        case LocalVariable(slot=slot):
            return lambda frame: _slot(frame, slot)
        case TokenVariable(token=token, variable=variable):
            if variable == STATE:
                return _refuse
            return lambda frame: _variable(frame, token, variable)
        case Field(base=base, members=members):
            if base is None:
                return lambda frame: unknown()
            return _field_reader(row_reader(base, names), members, names)
        case UnionOf():
            return _refuse


def _refuse(frame: RowFrame) -> Column:
    raise UnplainError


def _clock(frame: RowFrame) -> Column:
    """AGENT_CLOCK: from the tick at which a token was recorded on."""
    ticks = frame.tables.ticks[frame.tok.rows].astype(float)
    last = float(frame.bench.final_tick)
    return Column(INT, np.minimum(ticks, last), np.full(len(ticks), last))


def _slot(frame: RowFrame, slot: int) -> Column:
    column = frame.slot(slot)
    return unknown() if column is None else column


def _variable(frame: RowFrame, token: int, variable: int) -> Column:
    tokens = frame.tokens[token]
    if tokens is None:
        return unknown()
    if variable != DURATION:
        return tokens.column(variable)
    found = difference_of(frame.use(tokens.column(END)), frame.use(tokens.column(START)))
    if found is None:
        raise UnplainError
    return found


def _field_reader(base: RowRead, members: tuple[str, ...], names: VariableNames) -> RowRead:
    def read(frame: RowFrame) -> Column:
        column = frame.use(base(frame))
        if column.upper is not None or column.kind != TEXT:
            raise UnplainError
        texts = frame.tables.texts
        things, indices = distinct(column.lower)
        found: list[Value] = []
        for number in things:
            value: Value = texts.names[number]
            for name in members:
                value = member_of(frame.bench, names, value, name)
            found.append(value)
        return column_of(found, texts).take(indices)

    return read
