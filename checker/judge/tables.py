"""Tables of a record in columns: keys, times and arguments of all tokens of a reactor, read row by row of a group.

They are read for what is judged of many tokens at once; what else the judge asks of a record it asks token by token.
"""

import numpy as np

from checker.judge.alike import SymbolNumbers
from checker.judge.columns import INT, TEXT, Array, Column, Mask, Texts, distinct, joined
from compiler.program import DURATION, END, FIRST_PARAMETER, OBJECT, START
from runtime.executive.columns import ORIGINS, TokenColumns, has_nan, table_of, value_column
from runtime.executive.record import NOBODY

_SPARSE = 4
_LONG = 8  # rows on end, for which one reading is worth the search for them
_DEEPEST = 64  # merged into what is merged into ...
_ACTIVE, _MERGED = 0, 1


class _Stored:
    """Arguments of tokens of one predicate that the record keeps in a store; what has not begun has none."""

    def __init__(self, store: Array, first: Array, kinds: tuple[str, ...], numbers: SymbolNumbers) -> None:
        self.store = store
        self.kinds = kinds
        self.numbers = numbers
        self.missing: Mask | None = None
        if len(first) and first.min() < 0:
            self.missing = first < 0
            first = np.maximum(first, 0)
        self.first = first
        self.before: _Stored | None = None  # arguments of tokens of which each but the first has one of these
        self._table: Array | None = None
        self._may_be_open = True

    def is_followed(self, other: "_Stored") -> bool:
        """Whether the others are these without the first, and one more."""
        return self._table is not None and len(other.first) > 1 and np.array_equal(self.first[1:], other.first[:-1])

    def _values(self, number: int) -> Array:
        if self.before is not None:
            last = self.store[self.first[-1] + number]
            return np.append(self.before._values(number)[1:], last)
        if self._table is None:
            self._table = table_of(self.store, self.first, range(len(self.kinds)))
            self._may_be_open = has_nan(self._table)
        found: Array = self._table[number]
        return found

    def column(self, number: int) -> Column:
        """An argument, by the number of its parameter; bad where there is none."""
        if not 0 <= number < len(self.kinds):
            return _no_column(len(self.first))
        values = self._values(number)
        column = self.numbers.column(value_column(values, self.kinds[number], self._may_be_open))
        if self.missing is not None:
            column.bad = self.missing if column.bad is None else self.missing | column.bad
        return column


class _StoredReader:
    """Reads stored arguments; what follows on the tokens that were read last is not gathered again."""

    def __init__(self, tokens: TokenColumns, texts: Texts) -> None:
        self.tokens = tokens
        self.numbers = SymbolNumbers(tokens.symbols, texts)
        self.last: dict[int, _Stored] = {}  # by predicate

    def of(self, predicate: int, rows: Array) -> _Stored:
        """The arguments of tokens of one predicate."""
        first = self.tokens.times.values.take(rows)
        found = _Stored(self.tokens.store, first, self.tokens.kinds[predicate], self.numbers)
        known = self.last.get(predicate)
        if known is not None and known.is_followed(found):
            found.before = known
        else:
            self.last[predicate] = found
        return found


def _no_column(count: int) -> Column:
    return Column(TEXT, np.zeros(count, np.int64), None, np.ones(count, bool))


class Tables:
    """All tokens of a reactor; a row is an index in the record."""

    def __init__(self, tokens: TokenColumns) -> None:
        self.texts = Texts()
        self.tokens = tokens
        self._take(tokens)
        self.count = len(self.keys)
        self.is_planned = self.is_active | self.is_merged
        self.has_cut = bool(self.is_cut.any())
        self.is_ordered = bool((self.keys[1:] > self.keys[:-1]).all())
        self.row_of: Array | None = None  # by key, where there are not many more keys than tokens
        if self.is_ordered and self.count and self.keys[0] >= 0 and self.keys[-1] < _SPARSE * self.count:
            self.row_of = np.full(int(self.keys[-1]) + 1, NOBODY)
            self.row_of[self.keys] = np.arange(self.count)
        self.standing = self._standing()
        self.arguments = _StoredReader(tokens, self.texts).of

    def _take(self, tokens: TokenColumns) -> None:
        """Take the columns; what is inactive has no times yet."""
        for symbol in tokens.symbols:
            self.texts.number(symbol)
        times, names = tokens.times, np.array([self.texts.number(name) for name in tokens.names], np.int64)
        self.keys, self.ticks, self.merged_into = times.keys, times.ticks, times.merged_into
        self.predicates, self.predicate = list(tokens.names), times.predicates
        self.is_active, self.is_merged = times.states == _ACTIVE, times.states == _MERGED
        self.is_cut = np.zeros(len(self.keys), bool)
        self.is_observed = times.origins == ORIGINS.index("observation")
        begun = self.is_active | self.is_merged
        self.times = {
            OBJECT: Column(TEXT, names.take(times.objects)),
            START: Column(INT, times.starts, None if begun.all() else np.where(begun, times.starts, np.inf)),
            END: Column(INT, times.ends, None if (times.ends == times.latest).all() else times.latest),
        }

    def rows_of(self, keys: Array) -> Array:
        """The rows of tokens by their keys; NOBODY where there is none."""
        if not self.count:
            return np.full(len(keys), NOBODY)
        if self.row_of is None:
            return self._found(keys)
        is_known = (keys >= 0) & (keys < len(self.row_of))
        found = self.row_of.take(keys, mode="clip")
        return found if is_known.all() else np.where(is_known, found, NOBODY)

    def _found(self, keys: Array) -> Array:
        found = np.minimum(np.searchsorted(self.keys, keys), self.count - 1)
        return np.where(self.keys[found] == keys, found, NOBODY)

    def _standing(self) -> Array:
        """The row of the token that stands for each."""
        found = np.arange(self.count)
        left = np.flatnonzero(self.merged_into != NOBODY) if self.is_ordered else found[:0]
        for _ in range(_DEEPEST):
            if not len(left):
                break
            into = self.rows_of(self.merged_into[found[left]])
            left, into = left[into != NOBODY], into[into != NOBODY]
            found[left] = into
            left = left[self.merged_into[into] != NOBODY]
        return found


class RowTokens:
    """One token per row of a group: `rows` are their indices in the record."""

    __slots__ = ("_arguments", "_columns", "_part", "_rows", "_standing", "_whole", "tables")

    def __init__(
        self, tables: Tables, part: Array, whole: "RowTokens | None" = None, rows: Array | None = None
    ) -> None:
        self.tables = tables
        self._whole = whole  # the tokens of which these are the part in some rows
        self._part = part
        self._rows: Array | None = part if whole is None else rows
        self._standing: Array | None = None
        self._columns: dict[int, Column] = {}
        self._arguments: list[tuple[Mask, _Stored]] | None = None

    @staticmethod
    def children(tables: Tables, rows: Array) -> "RowTokens":
        """Children: as a rule one token stands for those of many rows on end, and is read once."""
        standing = tables.standing.take(rows)
        is_other = np.empty(len(rows), bool)
        is_other[:1] = True
        np.not_equal(standing[1:], standing[:-1], out=is_other[1:])
        heads = np.flatnonzero(is_other)
        if _LONG * len(heads) > len(rows):
            return RowTokens(tables, rows)
        return RowTokens(tables, np.cumsum(is_other) - 1, RowTokens(tables, standing.take(heads)), rows)

    @property
    def rows(self) -> Array:
        """The indices of these tokens in the record."""
        if self._rows is None:
            assert self._whole is not None
            self._rows = self._whole.rows.take(self._part)
        return self._rows

    @property
    def standing(self) -> Array:
        """The indices of those that stand for these tokens."""
        if self._standing is None:
            whole = self._whole
            self._standing = self.tables.standing.take(self.rows) if whole is None else whole.standing.take(self._part)
        return self._standing

    def __len__(self) -> int:
        return len(self._part)

    def part(self, rows: Array) -> "RowTokens":
        """The tokens of some rows of the group."""
        return RowTokens(self.tables, rows, self)

    def column(self, variable: int) -> Column:
        """A variable of these tokens, of those that stand for them where they are merged."""
        known = self._columns.get(variable)
        if known is None:
            known = self._read(variable) if self._whole is None else self._whole.column(variable).take(self._part)
            self._columns[variable] = known
        return known

    def _read(self, variable: int) -> Column:
        if variable in (OBJECT, START, END, DURATION):
            return self.tables.times[variable].take(self.standing)
        if self._arguments is None:
            self._arguments = self._sort()
        number = variable - FIRST_PARAMETER
        if len(self._arguments) == 1:
            return self._arguments[0][1].column(number)
        return joined([(rows, each.column(number)) for rows, each in self._arguments], len(self))

    def _sort(self) -> list[tuple[Mask, _Stored]]:
        """The arguments by predicate, with the rows of each."""
        kinds, indices = distinct(self.tables.predicate.take(self.standing))
        if len(kinds) == 1:
            return [(indices == 0, self.tables.arguments(kinds[0], self.standing))]
        found = []
        for k, kind in enumerate(kinds):
            rows = indices == k
            found.append((rows, self.tables.arguments(kind, self.standing[rows])))
        return found
