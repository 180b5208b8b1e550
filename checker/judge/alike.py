"""Tokens that are alike, out of a record: of one predicate, with the same rules fired.

A record has them in columns (`runtime.executive.columns`); here these become columns of the judge.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from checker.judge.columns import FLOAT, INT, TEXT, Array, Column, Mask, Texts
from runtime.executive.columns import GuardColumns, RunColumns, TokenColumns, TokenGroup, ValueColumn

_KINDS = {"float": FLOAT, "int": INT, "bool": INT, "name": TEXT}
_BLOCK = 8192  # rows


class RunRows(NamedTuple):
    """One run of a body in each row: values of locals, keys of children, guards."""

    rule: int
    locals: Sequence[Column]
    children: Sequence[Array]
    guards: Sequence["GuardRows"]


class BranchRows(NamedTuple):
    """Rows in which a guard came to the same, and what it ran there; `rows` is None for all."""

    branch: str
    is_decided: bool
    rows: Array | None
    run: RunRows | None


GuardRows = Sequence[BranchRows]  # each row is in one of them


class AlikeTokens(NamedTuple):
    """Tokens of one predicate by their rows, and the runs of their rules."""

    predicate: str
    rows: Array
    runs: Sequence[RunRows]


class SymbolNumbers:
    """The numbers that the judge has for names that others number."""

    def __init__(self, names: Sequence[str], texts: Texts) -> None:
        self._numbers = np.array([texts.number(name) for name in names], np.int64)
        self._are_same = bool((self._numbers == np.arange(len(names))).all())

    def column(self, given: ValueColumn) -> Column:
        """The judge's column of one that was recorded."""
        kind, numbers = _KINDS[given.kind], given.numbers
        is_open = np.isnan(numbers) if given.has_open else None
        if kind == TEXT:
            known = (numbers if is_open is None else np.where(is_open, 0, numbers)).astype(np.int64)
            return Column(kind, known if self._are_same else self._numbers.take(known), None, is_open)
        if given.kind == "bool":
            numbers = (numbers != 0.0).astype(float)
        elif kind == INT:
            numbers = np.trunc(numbers)
        if is_open is None:
            return Column(kind, numbers)
        return Column(kind, np.where(is_open, -np.inf, numbers), np.where(is_open, np.inf, numbers))


def alike_columns(
    groups: Sequence[TokenGroup], tokens: TokenColumns, texts: Texts, wanted: Mask, fewest: int
) -> Iterator[AlikeTokens]:
    """Of each group the tokens before the first one that is not wanted: it goes on when the mission ends.

    Large groups come in blocks, so that what is computed of them takes little memory.
    """
    numbers = SymbolNumbers(tokens.symbols, texts)
    for group in groups:
        unwanted = np.flatnonzero(~wanted.take(group.indices))
        count = int(unwanted[0]) if len(unwanted) else len(group.indices)
        if count >= fewest:
            for first in range(0, count, _BLOCK):
                last = min(first + _BLOCK, count)
                runs = [_run_columns(run, numbers, first, last) for run in group.runs]
                yield AlikeTokens(group.predicate, group.indices[first:last], runs)


def _run_columns(run: RunColumns, numbers: SymbolNumbers, first: int, last: int) -> RunRows:
    """The runs from one on to before another."""
    return RunRows(
        run.rule,
        [numbers.column(each) for each in run.locals.part(first, last)],
        [each[first:last] for each in run.children],
        [_branches(each, numbers, first, last) for each in run.guards],
    )


def _branches(guard: GuardColumns, numbers: SymbolNumbers, first: int, last: int) -> GuardRows:
    """Both branches of a guard in the runs from one on to before another."""
    is_true = guard.is_true[first:last]
    before = int(np.count_nonzero(guard.is_true[:first]))  # runs that took the first branch
    parts = []
    for branch, rows, run, past in (
        ("then", is_true, guard.then, before),
        ("else", ~is_true, guard.otherwise, first - before),
    ):
        taken = np.flatnonzero(rows)
        if len(taken):
            which = None if len(taken) == last - first else taken
            inner = None if run is None else _run_columns(run, numbers, past, past + len(taken))
            parts.append(BranchRows(branch, True, which, inner))
    return parts
