"""Judge children and relations of many tokens at once."""

from math import inf

import numpy as np

from checker.judge.bulk_frame import RowFrame, RowStep, UnplainError, row_reader
from checker.judge.bulk_meanings import near
from checker.judge.columns import TEXT, Column, Mask
from checker.judge.operands import VariableNames
from checker.judge.relations import Demand, demands
from checker.judge.tables import RowTokens
from compiler.program import END, OBJECT, START, Child, Relate


def row_child(child: Child, names: VariableNames) -> RowStep:
    """The step that judges a child in all rows."""
    slot, origin = child.slot, child.origin
    pairs = demands(child.relation, child.bounds)
    given = None if isinstance(child.object, str) else row_reader(child.object, names)
    fitting: dict[tuple[str, ...], Mask] = {}  # by the predicates of a record, which are mostly the same

    def step(frame: RowFrame) -> None:
        keys = next(frame.children, None)
        if keys is None:
            raise UnplainError
        tables, tally = frame.tables, frame.tally
        rows = tables.rows_of(keys)
        is_missing = rows < 0
        if is_missing.any():
            tally.need(~is_missing)
            rows = np.maximum(rows, 0)
        predicates = tuple(tables.predicates)
        if predicates not in fitting:
            fitting[predicates] = fitting_predicates(predicates, child, names)
        tally.need(fitting[predicates].take(tables.predicate.take(rows)))
        tokens = frame.tokens[slot] = RowTokens.children(tables, rows)
        holder = frame.tok.column(OBJECT) if child.object == "own" else None if given is None else given(frame)
        if holder is not None:
            things = frame.use(tokens.column(OBJECT))
            if frame.use(holder).kind != TEXT or things.kind != TEXT:
                raise UnplainError
            tally.judge(near(things, holder))
        first = frame.tokens[origin]
        if first is None:
            raise UnplainError
        tally.need(tables.is_planned.take(rows))
        _relate(frame, pairs, first, tokens)

    return step


def row_relate(given: Relate) -> RowStep:
    """The step that judges a relation between two tokens of a rule."""
    pairs = demands(given.relation, given.bounds)

    def step(frame: RowFrame) -> None:
        origin, target = frame.tokens[given.origin], frame.tokens[given.target]
        if origin is None or target is None:
            raise UnplainError
        _relate(frame, pairs, origin, target)

    return step


def fitting_predicates(predicates: tuple[str, ...], child: Child, names: VariableNames) -> Mask:
    """Which predicates are the one that a rule asks for; on its own object, of a subclass too."""
    wanted, _, suffix = child.predicate.rpartition(".")
    found = []
    for name in predicates:
        kind, _, last = name.rpartition(".")
        is_heir = child.object == "own" and last == suffix and names.is_kind_of(kind, wanted)
        found.append(name == child.predicate or is_heir)
    return np.array(found, bool)


def _relate(frame: RowFrame, pairs: tuple[Demand, ...], origin: RowTokens, target: RowTokens) -> None:
    """Judge a relation between two tokens in all rows; where a time is open, whether it can hold."""
    tables, tally = frame.tables, frame.tally
    if tables.has_cut:
        tally.need(~(tables.is_cut.take(origin.rows) | tables.is_cut.take(target.rows)))
    times = ((origin, START), (origin, END), (target, START), (target, END))
    for first, second, lower, upper in pairs:
        a, b = (frame.fit(tokens.column(variable)) for tokens, variable in (times[first], times[second]))
        if a.upper is None and b.upper is None:
            if lower == upper == 0:
                tally.judge(a.lower == b.lower)
                continue
            gap = b.lower - a.lower
            holds = lower <= gap
            if upper < inf:
                holds &= gap <= upper
            tally.judge(holds)
            continue
        (least_a, most_a), (least_b, most_b) = _ends(a), _ends(b)
        is_open = (least_a != most_a) | (least_b != most_b)
        holds = (least_b - most_a <= upper) & (lower <= most_b - least_a)
        if lower == upper:
            planned = tables.is_planned.take(target.rows)
            holds &= ~is_open | ~planned | ((least_a != most_a) & (least_b != most_b))
        tally.need(holds)
        tally.more.append(~is_open)
        tally.open.append(is_open)


def _ends(times: Column) -> tuple[np.ndarray, np.ndarray]:
    return times.lower, times.lower if times.upper is None else times.upper
