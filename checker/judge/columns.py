"""Columns: a value of many tokens at once, as arrays of their lower and upper ends; texts as numbers.

Whole numbers are exact, be they int64 or float64; reals are float64, truth values are 0 and 1. A row whose value does
not fit (a value of another kind, one of several values, a number beyond 2**53) is `bad`, and left to the judge of
single tokens.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from checker.judge.values import UNKNOWN
from runtime.executive.record import Value, ValueRange

Mask = NDArray[np.bool_]
Array = NDArray[Any]
INT, FLOAT, TEXT = "i", "f", "s"
_EXACT = 2**53
_KINDS: dict[type, str] = {int: INT, bool: INT, float: FLOAT, str: TEXT}
_TYPES: dict[str, Any] = {INT: np.int64, FLOAT: np.float64, TEXT: np.int64}


class Texts:
    """Names and texts as numbers, in the order in which they are met."""

    def __init__(self) -> None:
        self.numbers: dict[str, int] = {}
        self.names: list[str] = []

    def number(self, text: str) -> int:
        """The number of a text."""
        known = self.numbers.get(text)
        if known is None:
            known = self.numbers[text] = len(self.names)
            self.names.append(text)
        return known


class Column:
    """One value per row; `upper` is None where each is a single one, `bad` is None where each row fits.

    A column of length 1 has the same value in all rows, however many there are.
    """

    __slots__ = ("bad", "kind", "lower", "upper")

    def __init__(self, kind: str, lower: Array, upper: Array | None = None, bad: Mask | None = None) -> None:
        self.kind = kind
        self.lower = lower
        self.upper = upper
        self.bad = bad

    @property
    def open(self) -> Mask | None:
        """The rows whose values were never fixed."""
        return None if self.upper is None else self.lower != self.upper

    def take(self, rows: Array) -> "Column":
        """The column of some rows."""
        if len(self.lower) == 1:
            return self
        bad = None if self.bad is None else self.bad.take(rows)
        return self._made(self.lower.take(rows), None if self.upper is None else self.upper.take(rows), bad)

    def _made(self, lower: Array, upper: Array | None, bad: Mask | None) -> "Column":
        """A part of the column, plain where it can be."""
        if bad is not None and not bad.any():
            bad = None
        if upper is not None and (lower == upper).all():
            return Column(self.kind, lower, None, bad)
        return Column(self.kind, lower, upper, bad)

    def part(self, first: int, last: int) -> "Column":
        """The column of the rows from one on to before another."""
        if len(self.lower) == 1 or last - first == len(self.lower):
            return self
        lower = self.lower[first:last]
        upper, bad = (None if each is None else each[first:last] for each in (self.upper, self.bad))
        return self._made(lower, upper, bad)

    def value(self, row: int, texts: Texts) -> Value:
        """The value of one row."""
        lower = self.lower[row]
        if self.kind == TEXT:
            return texts.names[int(lower)]
        if self.upper is not None and lower != self.upper[row]:
            return ValueRange(float(lower), float(self.upper[row]))
        return int(lower) if self.kind == INT else float(lower)

    def values(self, texts: Texts, rows: Array) -> list[Value]:
        """The values of some rows."""
        if len(self.lower) == 1:
            return [self.value(0, texts)] * len(rows)
        if self.upper is None:
            found: list[Any] = self.lower[rows].tolist()
            if self.kind == FLOAT:
                return found
            return [texts.names[each] for each in found] if self.kind == TEXT else list(map(int, found))
        return [self.value(row, texts) for row in rows.tolist()]


def column_of(values: Sequence[Value], texts: Texts) -> Column:
    """The column of some values."""
    types = set(map(type, values))
    kinds = {_KINDS.get(each) for each in types}
    if len(kinds) == 1 and None not in kinds:
        return _plain(kinds.pop() or INT, values, texts)
    counts = dict.fromkeys((INT, FLOAT, TEXT), 0)
    for each in values:
        if type(each) in _KINDS:
            counts[_KINDS[type(each)]] += 1
    kind = max(counts, key=lambda each: counts[each])
    return _mixed(kind, values, texts)


def _plain(kind: str, values: Sequence[Value], texts: Texts) -> Column:
    """The column of values of one kind."""
    if kind == TEXT:
        number = texts.number
        known = {each: number(each) for each in dict.fromkeys(values)}  # type: ignore[arg-type]
        return Column(TEXT, np.array([known[each] for each in values], np.int64))
    if kind == FLOAT:
        return Column(FLOAT, np.array(values, np.float64))
    try:
        found = np.array(values, np.int64)
    except OverflowError:
        return _mixed(INT, values, texts)
    is_big = np.abs(found) > _EXACT
    return Column(INT, found, None, is_big if is_big.any() else None)


def _mixed(kind: str, values: Sequence[Value], texts: Texts) -> Column:
    """The column of values of which some are of another kind, or were never fixed."""
    if kind == TEXT:
        bad = np.zeros(len(values), bool)
        found = np.zeros(len(values), np.int64)
        for k, each in enumerate(values):
            if isinstance(each, str):
                found[k] = texts.number(each)
            else:
                bad[k] = True
        return Column(TEXT, found, None, bad)
    odd = [k for k, each in enumerate(values) if _KINDS.get(type(each)) != kind]
    numbers = list(values)
    for k in odd:
        numbers[k] = 0
    lower = np.array(numbers, np.float64)
    bad = ~(np.abs(lower) <= _EXACT) if kind == INT else np.isnan(lower)
    upper = lower.copy()
    for k in odd:
        each = values[k]
        if isinstance(each, ValueRange) and each.lower < each.upper:
            lower[k], upper[k] = each
        else:
            bad[k] = True
    return Column(kind, lower, upper, bad)


def constant(value: Value, texts: Texts) -> Column:
    """The column that holds one value in each row."""
    return column_of([value], texts)


def unknown() -> Column:
    """The column of values of which nothing is known."""
    return Column(FLOAT, np.array([UNKNOWN.lower]), np.array([UNKNOWN.upper]))


def distinct(numbers: Array) -> tuple[list[int], Array]:
    """The small numbers, not below 0, that occur, in order; and the index in that order of each."""
    if len(numbers) and (numbers == numbers[0]).all():  # mostly so, and this is quickly seen
        return [int(numbers[0])], np.zeros(len(numbers), np.int64)
    found = np.flatnonzero(np.bincount(numbers))
    indices = np.zeros(int(found[-1]) + 1 if len(found) else 0, np.int64)
    indices[found] = np.arange(len(found))
    return found.tolist(), indices[numbers]


def joined(parts: Sequence[tuple[Mask, Column]], count: int) -> Column:
    """One column of several, each with its rows; bad where their kinds differ from the first."""
    kind = parts[0][1].kind
    has_ranges = any(part.upper is not None for _, part in parts)
    lower: Array = np.zeros(count, np.float64 if has_ranges else _TYPES[kind])
    upper: Array | None = lower.copy() if has_ranges else None
    bad = np.ones(count, bool)
    for rows, part in parts:
        if part.kind != kind:
            continue
        lower[rows] = part.lower
        if upper is not None:
            upper[rows] = part.lower if part.upper is None else part.upper
        bad[rows] = False if part.bad is None else part.bad
    return Column(kind, lower, upper, bad)
