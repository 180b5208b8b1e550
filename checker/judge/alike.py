"""Tokens that are alike, out of a record: of one predicate, with the same rules fired and the same branches taken.

A record has its tokens one by one, or in columns (`runtime.executive.columns`); here both become columns of the judge.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from checker.judge.columns import FLOAT, INT, TEXT, Array, Column, Mask, Texts, column_of
from runtime.executive.columns import RunColumns, TokenColumns, ValueColumn
from runtime.executive.record import BodyRun, TokenRecord, Value

_Shape = tuple["_RunShape", ...]  # of all runs of a token
_RunShape = tuple[int, int, int, tuple["_GuardShape", ...]]  # rule, how many locals and children, guards
_GuardShape = tuple[str, bool, _RunShape | None]  # branch, whether it is decided, what it ran
_KINDS = {"float": FLOAT, "int": INT, "bool": INT, "name": TEXT}


class RunRows(NamedTuple):
    """One run of a body in each row, all of one shape: values of locals, keys of children, guards."""

    rule: int
    locals: Sequence[Column]
    children: Sequence[Array]
    guards: Sequence["GuardRows"]


class GuardRows(NamedTuple):
    """A guard that took the same branch in each row, and what it ran."""

    branch: str
    is_decided: bool
    run: RunRows | None


class AlikeTokens(NamedTuple):
    """Tokens of one predicate by their rows, and the runs of their rules."""

    predicate: str
    rows: Array
    runs: Sequence[RunRows]


# ---- one by one ----


def alike_tokens(tokens: Sequence[TokenRecord], texts: Texts, wanted: Mask, fewest: int) -> Iterator[AlikeTokens]:
    """Of the `wanted` tokens those of which at least `fewest` are alike."""
    if isinstance(tokens, TokenColumns):
        yield from _in_columns(tokens, texts, wanted, fewest)
        return
    found: dict[tuple[str, _Shape], list[int]] = {}
    for row in np.flatnonzero(wanted).tolist():
        one = tokens[row]
        found.setdefault((one.predicate, tuple([_run_shape(run) for run in one.runs])), []).append(row)
    for (predicate, shape), rows in found.items():
        if len(rows) >= fewest:
            runs = [_run_rows([tokens[row].runs[place] for row in rows], texts) for place in range(len(shape))]
            yield AlikeTokens(predicate, np.array(rows), runs)


def _run_shape(run: BodyRun) -> _RunShape:
    guards = run.guards
    if not guards:
        return (run.rule, len(run.locals), len(run.children), ())
    inner = tuple([(g.branch, g.is_decided, None if g.run is None else _run_shape(g.run)) for g in guards])
    return (run.rule, len(run.locals), len(run.children), inner)


def _run_rows(runs: Sequence[BodyRun], texts: Texts) -> RunRows:
    """Runs of one shape."""
    guards = []
    for reached in zip(*[run.guards for run in runs], strict=True):
        inner = [each.run for each in reached if each.run is not None]
        guards.append(GuardRows(reached[0].branch, reached[0].is_decided, _run_rows(inner, texts) if inner else None))
    return RunRows(
        runs[0].rule,
        [column_of(values, texts) for values in zip(*[run.locals for run in runs], strict=True)],
        [np.array(keys, np.int64) for keys in zip(*[run.children for run in runs], strict=True)],
        guards,
    )


# ---- in columns ----


class SymbolNumbers:
    """The numbers that the judge has for names that others number."""

    def __init__(self, names: Sequence[str], texts: Texts) -> None:
        self._numbers = np.array([texts.number(name) for name in names], np.int64)

    def column(self, given: ValueColumn) -> Column:
        """The judge's column of one that was recorded."""
        kind, numbers = _KINDS[given.kind], given.numbers
        if numbers.dtype != np.float64:
            return Column(kind, self._numbers[numbers] if kind == TEXT else numbers)
        is_open = np.isnan(numbers)
        if not is_open.any():
            return Column(kind, numbers)
        if kind == TEXT:
            return Column(kind, np.where(is_open, 0, numbers).astype(np.int64), None, is_open)
        return Column(kind, np.where(is_open, -np.inf, numbers), np.where(is_open, np.inf, numbers))


def _in_columns(tokens: TokenColumns, texts: Texts, wanted: Mask, fewest: int) -> Iterator[AlikeTokens]:
    numbers = SymbolNumbers(tokens.symbols, texts)
    for group in tokens.groups:
        kept = np.flatnonzero(wanted[group.places])
        if len(kept) >= fewest:
            which = None if len(kept) == len(group.places) else kept
            runs = [_run_columns(run, numbers, which) for run in group.runs]
            yield AlikeTokens(group.predicate, group.places[kept], runs)


def _run_columns(run: RunColumns, numbers: SymbolNumbers, kept: Array | None) -> RunRows:
    columns = [numbers.column(each) for each in run.locals]
    return RunRows(
        run.rule,
        columns if kept is None else [each.take(kept) for each in columns],
        run.children if kept is None else [each[kept] for each in run.children],
        [
            GuardRows(each.branch, True, None if each.run is None else _run_columns(each.run, numbers, kept))
            for each in run.guards
        ],
    )


class ArgumentTable:
    """The arguments of the tokens of one predicate that stand for themselves, in a column per parameter."""

    def __init__(self, tokens: Sequence[TokenRecord], predicate: str, rows: Array, texts: Texts) -> None:
        self._texts = texts
        self._columns: dict[int, Column] = {}
        self._arguments: list[tuple[Value, ...]] = []
        self._tokens: TokenColumns | None = tokens if isinstance(tokens, TokenColumns) else None
        self._rows = rows
        if self._tokens is not None:
            self._groups = [group for group in self._tokens.groups if group.predicate == predicate]
            self.width = len(self._groups[0].arguments) if self._groups else 0
        else:
            held = [tokens[row] for row in rows.tolist()]
            self.width = min((len(one.arguments) for one in held), default=0)
            self._arguments = list(zip(*[one.arguments for one in held], strict=False))

    def column(self, number: int) -> Column:
        """The values of a parameter."""
        known = self._columns.get(number)
        if known is None:
            known = self._columns[number] = self._gathered(number)
        return known

    def _gathered(self, number: int) -> Column:
        """The values of a parameter, out of the groups in which they are; what is in none is bad."""
        if self._tokens is None:
            return column_of(self._arguments[number], self._texts)
        numbers = SymbolNumbers(self._tokens.symbols, self._texts)
        parts = [(group.places, numbers.column(group.arguments[number])) for group in self._groups]
        has_ranges = any(part.upper is not None for _, part in parts)
        is_real = has_ranges or parts[0][1].kind == FLOAT
        lower: Array = np.zeros(len(self._rows), np.float64 if is_real else np.int64)
        upper = lower.copy() if has_ranges else None
        bad = np.ones(len(self._rows), bool)
        for places, part in parts:
            at = np.searchsorted(self._rows, places)
            lower[at] = part.lower
            if upper is not None:
                upper[at] = part.lower if part.upper is None else part.upper
            bad[at] = False if part.bad is None else part.bad
        return Column(parts[0][1].kind, lower, upper, bad if bad.any() else None)
