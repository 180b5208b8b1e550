"""One run of a body for many tokens at once: the rows that plainly hold so far, and what was counted of each."""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from checker.judge.alike import GuardRows, RunRows
from checker.judge.bench import Bench
from checker.judge.bulk_meanings import difference_of
from checker.judge.columns import INT, TEXT, Array, Column, Mask, column_of, constant
from checker.judge.operands import VariableNames, domain_value, member_of
from checker.judge.tables import RowTokens, Tables
from checker.judge.values import UNKNOWN
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
        self.judged_more: Array = np.zeros(count, np.int64)
        self.open: Array = np.zeros(count, np.int64)
        self.skipped: dict[str, int] = {}  # in each row

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

    def settle(self, bench: Bench) -> None:
        """Add what was counted of the rows that hold."""
        settled = int(np.count_nonzero(self.holds))
        bench.judged += self.judged * settled + int(self.judged_more[self.holds].sum())
        bench.open += int(self.open[self.holds].sum())
        for reason, times in self.skipped.items():
            if settled:
                bench.skip(reason, times * settled)


class RowFrame:
    """One run of a body for each row: values in slots, tokens, and what the record says of the runs."""

    __slots__ = ("bench", "children", "guards", "locals", "slots", "tables", "tally", "tok", "tokens")

    def __init__(
        self, bench: Bench, tok: RowTokens, slots: list[Column | None], tokens: list[RowTokens | None]
    ) -> None:
        self.bench = bench
        self.tables: Tables = tok.tables
        self.tok = tok
        self.slots = slots
        self.tokens = tokens
        self.tally = RowTally(len(tok.rows))
        self.locals: Iterator[Column] = iter(())
        self.children: Iterator[Array] = iter(())
        self.guards: Iterator[GuardRows] = iter(())

    def follow(self, run: RunRows) -> None:
        """Read what comes next from `run`."""
        self.locals = iter(run.locals)
        self.children = iter(run.children)
        self.guards = iter(run.guards)

    def branch(self, run: RunRows) -> "RowFrame":
        """The frame of a branch, with slots and tokens of its own."""
        inner = RowFrame(self.bench, self.tok, list(self.slots), list(self.tokens))
        inner.tally = self.tally
        inner.follow(run)
        return inner

    def use(self, column: Column) -> Column:
        """A column that is read: rows that do not fit are left to others."""
        if column.bad is not None:
            self.tally.need(~column.bad)
        return column


RowRead = Callable[[RowFrame], Column]
RowStep = Callable[[RowFrame], None]


def row_reader(operand: Operand, names: VariableNames) -> RowRead:
    """The function that reads `operand` in all rows."""
    match operand:
        case Constant(domain=domain):
            value = domain_value(domain)
            return lambda frame: _constant(frame, value)
        case GlobalVariable(index=index):
            if index == names.clock:
                return _clock
            return lambda frame: _constant(frame, frame.bench.globals[index])
        case LocalVariable(slot=slot):
            return lambda frame: _slot(frame, slot)
        case TokenVariable(token=token, variable=variable):
            if variable == STATE:
                return _refuse
            return lambda frame: _variable(frame, token, variable)
        case Field(base=base, members=members):
            if base is None:
                return lambda frame: _constant(frame, UNKNOWN)
            return _field_reader(row_reader(base, names), members, names)
        case UnionOf():
            return _refuse


def _refuse(frame: RowFrame) -> Column:
    raise UnplainError


def _constant(frame: RowFrame, value: Value) -> Column:
    return constant(value, frame.tables.texts, frame.tally.count)


def _clock(frame: RowFrame) -> Column:
    """AGENT_CLOCK: from the tick at which a token was recorded on."""
    ticks = frame.tables.ticks[frame.tok.rows].astype(float)
    last = float(frame.bench.final_tick)
    return Column(INT, np.minimum(ticks, last), np.full(len(ticks), last))


def _slot(frame: RowFrame, slot: int) -> Column:
    column = frame.slots[slot]
    return _constant(frame, UNKNOWN) if column is None else column


def _variable(frame: RowFrame, token: int, variable: int) -> Column:
    tokens = frame.tokens[token]
    if tokens is None:
        return _constant(frame, UNKNOWN)
    if variable != DURATION:
        return tokens.column(variable)
    end, start = tokens.column(END), tokens.column(START)
    found = difference_of(end, start)
    if found is None:
        raise UnplainError
    bad = np.zeros(len(found.lower), bool)
    for mask in (end.bad, start.bad, found.bad, end.open, start.open):
        if mask is not None:
            bad |= mask
    return Column(INT, found.lower.astype(np.int64), None, bad if bad.any() else None)


def _field_reader(base: RowRead, members: tuple[str, ...], names: VariableNames) -> RowRead:
    def read(frame: RowFrame) -> Column:
        column = frame.use(base(frame))
        if column.upper is not None:
            raise UnplainError
        texts = frame.tables.texts
        things, places = np.unique(column.lower, return_inverse=True)
        found: list[Value] = []
        for value in column_values(things, column, texts.names):
            for name in members:
                value = member_of(frame.bench, names, value, name)
            found.append(value)
        return column_of(found, texts).take(places)

    return read


def column_values(numbers: Array, column: Column, names: Sequence[str]) -> list[Value]:
    """What the numbers of a column stand for."""
    if column.kind == TEXT:
        return [names[each] for each in numbers.tolist()]
    return list(numbers.tolist())


def closed(columns: Sequence[Column]) -> Mask | None:
    """The rows in which all values were fixed; None if in all."""
    found: Mask | None = None
    for each in columns:
        if (is_open := each.open) is not None:
            found = ~is_open if found is None else found & ~is_open
    return found
