"""Tables from the single records of tokens."""

from collections.abc import Iterator, Sequence

import numpy as np

from checker.judge.columns import Array, Column, Mask, Texts, column_of
from checker.judge.tables import GuardRows, RunRows, Tables, TokenRows, missing
from compiler.program import DURATION, END, OBJECT, START
from runtime.executive.record import NOBODY, BodyRun, TokenRecord, Value

_Shape = tuple["_RunShape", ...]  # of all runs of a token
_RunShape = tuple[int, int, int, tuple["_GuardShape", ...]]  # rule, how many locals and children, guards
_GuardShape = tuple[str, bool, _RunShape | None]  # branch, whether it is decided, what it ran


class _PredicateTable:
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


class RecordTables(Tables):
    """All tokens of a reactor, read one by one."""

    def __init__(self, tokens: Sequence[TokenRecord]) -> None:
        fields = tuple(zip(*tokens, strict=True)) or ((),) * len(TokenRecord._fields)
        keys, predicates, objects, states, durations, starts, ends, _, merged, origins, fates, ticks, runs = fields
        super().__init__(tokens, np.array(keys, np.int64), Texts())
        self.predicates = list(dict.fromkeys(predicates))
        numbers = {name: k for k, name in enumerate(self.predicates)}
        self.predicate = np.array([numbers[each] for each in predicates], np.int64)
        self.is_active = np.array([each == "active" for each in states], bool)
        self.is_merged = np.array([each == "merged" for each in states], bool)
        self.is_cut = np.array([each == "cut" for each in fates], bool)
        self.is_observed = np.array([each == "observation" for each in origins], bool)
        self.ticks = np.array(ticks, np.int64)
        self._runs: tuple[tuple[BodyRun, ...], ...] = runs
        self.times = {
            OBJECT: column_of(objects, self.texts),
            DURATION: column_of(durations, self.texts),
            START: column_of(starts, self.texts),
            END: column_of(ends, self.texts),
        }
        self.standing = self.find_standing(np.array(merged, np.int64))
        own = np.where(self.standing == np.arange(self.count), self.predicate, NOBODY)
        order = np.argsort(own, kind="stable")
        ordered = own[order]
        self._kinds = own
        self._places = np.empty(self.count, np.int64)  # of each row in the table of its predicate
        self._places[order] = np.arange(self.count) - np.searchsorted(ordered, ordered)
        self._tables: dict[int, _PredicateTable] = {}

    def argument(self, predicate: int, number: int, rows: Array) -> Column:
        """A parameter of tokens that stand for themselves."""
        table = self._tables.get(predicate)
        if table is None:
            own = np.flatnonzero(self._kinds == predicate)
            table = self._tables[predicate] = _PredicateTable([self.tokens[k] for k in own.tolist()], self.texts)
        if not 0 <= number < table.width:
            return missing(len(rows))
        return table.column(number).take(self._places[rows])

    def equals_standing(self, rows: Array) -> Mask:
        """Where merged tokens have the very predicate and values of those that stand for them."""
        tokens = self.tokens
        pairs = zip(rows.tolist(), self.standing[rows].tolist(), strict=True)
        return np.array([_is_same(tokens[row], tokens[other]) for row, other in pairs], bool)

    def groups(self, wanted: Mask, fewest: int) -> Iterator[TokenRows]:
        """Active tokens among the rows `wanted` that are alike, where there are `fewest` of them."""
        found: dict[tuple[int, _Shape], list[int]] = {}
        rows = np.flatnonzero(wanted & self.is_active)
        runs = self._runs
        for row, predicate in zip(rows.tolist(), self.predicate[rows].tolist(), strict=True):
            shape = tuple([_run_shape(run) for run in runs[row]]) if runs[row] else ()
            found.setdefault((predicate, shape), []).append(row)
        for (predicate, shape), alike in found.items():
            if len(alike) >= fewest:
                own = tuple(self._run_rows([runs[row][k] for row in alike]) for k in range(len(shape)))
                yield TokenRows(self.predicates[predicate], np.array(alike), own)

    def _run_rows(self, runs: Sequence[BodyRun]) -> RunRows:
        """Runs of one shape as columns."""
        named = tuple(column_of(each, self.texts) for each in zip(*[run.locals for run in runs], strict=True))
        children = tuple(np.array(each, np.int64) for each in zip(*[run.children for run in runs], strict=True))
        guards = []
        for each in zip(*[run.guards for run in runs], strict=True):
            inner = [guard.run for guard in each if guard.run is not None]
            guards.append(GuardRows(each[0].branch, each[0].is_decided, self._run_rows(inner) if inner else None))
        return RunRows(runs[0].rule, named, children, tuple(guards))


def _is_same(mine: TokenRecord, theirs: TokenRecord) -> bool:
    return (
        mine.predicate == theirs.predicate
        and mine.start == theirs.start
        and mine.end == theirs.end
        and (mine.arguments is theirs.arguments or mine.arguments == theirs.arguments)
    )


def _run_shape(run: BodyRun) -> _RunShape:
    """What a run has in common with others: rule, branches, and how much it has made."""
    guards = run.guards
    if not guards:
        return (run.rule, len(run.locals), len(run.children), ())
    inner = tuple([(g.branch, g.is_decided, None if g.run is None else _run_shape(g.run)) for g in guards])
    return (run.rule, len(run.locals), len(run.children), inner)
