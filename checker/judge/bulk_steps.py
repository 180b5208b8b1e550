"""Steps that judge the runs of a body for many tokens at once."""

from collections.abc import Callable, Sequence

import numpy as np

from checker.judge.alike import GuardRows
from checker.judge.bodies import StepMaker, Written, compile_body
from checker.judge.bulk_frame import RowFrame, RowRead, RowStep, UnplainError, row_reader
from checker.judge.bulk_meanings import (
    HOLDS,
    TRUTHS,
    are_numbers,
    conforms,
    difference_of,
    near,
    points,
    truth,
    value_of,
)
from checker.judge.bulk_relating import row_child, row_relate
from checker.judge.columns import FLOAT, INT, TEXT, Column, Mask, column_of, distinct, unknown
from checker.judge.functions import COMPUTED, result_index
from checker.judge.meanings import Meaning
from checker.judge.operands import VariableNames, domain_value
from checker.judge.solving import solver
from checker.judge.steps import Domain, domain_test
from checker.judge.values import may_be_equal
from compiler.program import START, Assign, Constant, Guard, Instruction, NewObject, NewVariable, Post, Sample, UnionOf
from runtime.executive.record import OpenValues, Value, ValueRange


def _unplain(*_: object) -> RowStep:
    def step(frame: RowFrame) -> None:
        raise UnplainError

    return step


def _define_slot(slot: int, make: RowRead) -> RowStep:
    def step(frame: RowFrame) -> None:
        frame.slots[slot] = make(frame)

    return step


# ---- variables ----


def allowed(test: Domain, column: Column, frame: RowFrame) -> Mask:
    """Where a declaration plainly allows the values of a column."""
    frame.use(column)
    if column.kind == TEXT:
        numbers, indices = distinct(column.lower)
        names = frame.tables.texts.names
        return np.array([test(frame.bench, names[each]) is True for each in numbers], bool)[indices]
    holds = np.ones(len(column.lower), bool)
    for limit in test.limits:
        holds &= _lies_in(limit, column)
    if test.class_name:
        raise UnplainError
    return holds


def _lies_in(limit: Value, column: Column) -> Mask:
    if isinstance(limit, ValueRange):
        return np.asarray((limit.lower <= column.lower) & (column.lower <= limit.upper))
    numbers = limit.values if isinstance(limit, OpenValues) else (limit,)
    return np.isin(column.lower, [each for each in numbers if not isinstance(each, str)])


def _variable(new: NewVariable, names: VariableNames) -> RowStep:
    slot = new.slot
    test = domain_test(new.type, new.domain, names)
    copied = None if new.copy_of is None else row_reader(new.copy_of, names)

    def step(frame: RowFrame) -> None:
        column = next(frame.locals, None)
        if column is None:
            raise UnplainError
        frame.slots[slot] = column
        if test is not None:
            frame.tally.judge(allowed(test, column, frame))
        if copied is not None:
            _count_equal(frame, column, copied(frame))

    return step


def _count_equal(frame: RowFrame, a: Column, b: Column) -> None:
    """Count the rows in which two values are, or may be, the same."""
    frame.tally.more.append(near(frame.use(a), frame.use(b)))


def _assign(given: Assign, names: VariableNames) -> RowStep:
    target = row_reader(given.target, names)
    limit = None if given.domain is None else domain_value(given.domain)
    source = given.value
    read = row_reader(source, names) if source is not None and not isinstance(source, NewObject) else None

    def step(frame: RowFrame) -> None:
        column = frame.use(target(frame))
        if limit is not None:
            if column.kind == TEXT:
                numbers, indices = distinct(column.lower)
                names = frame.tables.texts.names
                holds = np.array([may_be_equal(names[each], limit) for each in numbers], bool)[indices]
            else:
                holds = _lies_in(limit, column)
            frame.tally.judge(holds)
        if read is not None:
            _count_equal(frame, column, read(frame))

    return step


def _sample(sample: Sample, slot: int | None, names: VariableNames) -> RowStep:
    parameter, target = sample.parameter, sample.target
    read = row_reader(target, names)

    def step(frame: RowFrame) -> None:
        starts = frame.use(frame.tok.column(START))
        if starts.kind != INT:
            raise UnplainError
        values = frame.bench.draws(parameter, starts.lower.astype(np.int64, copy=False))
        drawn = unknown() if values is None else Column(FLOAT, values)
        if slot is not None:
            frame.slots[slot] = drawn
            return
        frame.tally.judge(near(frame.use(read(frame)), frame.use(drawn)))

    return step


# ---- constraints ----


def _pass_over(name: str) -> RowStep:
    return lambda frame: frame.tally.skip(f"constraint `{name}`")


def _check(post: Post, meaning: Meaning, names: VariableNames) -> RowStep:
    reads = [row_reader(each, names) for each in post.operands]
    plain = _plain(post.name)

    is_function = post.name in COMPUTED

    def step(frame: RowFrame) -> None:
        columns = [frame.use(read(frame)) for read in reads]
        if is_function:
            _need_numbers(columns)
        holds = None if plain is None else plain(columns)
        frame.tally.judge(_one_by_one(meaning, columns, frame) if holds is None else holds)

    return step


def _check_loose(post: Post, meaning: Meaning, names: VariableNames) -> RowStep:
    if any(isinstance(operand, UnionOf) for operand in post.operands):
        return _unplain()
    reads = [row_reader(each, names) for each in post.operands]
    ranges = [domain_value(one.domain) if isinstance(one, Constant) else None for one in post.operands]

    def step(frame: RowFrame) -> None:
        tally, texts = frame.tally, frame.tables.texts
        rows = np.arange(tally.count)
        columns = [frame.use(read(frame)) for read, one in zip(reads, ranges, strict=True) if one is None]
        parts = iter([column.values(texts, rows) for column in columns])
        given = [next(parts) if one is None else [one] * tally.count for one in ranges]
        tally.judge(np.array([meaning(*values) is not False for values in zip(*given, strict=True)], bool))

    return step


def _need_numbers(columns: Sequence[Column]) -> None:
    """Leave a function of texts to others: only a child that is another token than the rule asks for has them."""
    if not are_numbers(*columns):
        raise UnplainError


def _one_by_one(meaning: Meaning, columns: Sequence[Column], frame: RowFrame) -> Mask:
    """Where a constraint holds, asked row by row."""
    texts, rows = frame.tables.texts, np.arange(frame.tally.count)
    given = zip(*[column.values(texts, rows) for column in columns], strict=True)
    return np.array([meaning(*values) is True for values in given], bool)


def _plain(name: str) -> Callable[[list[Column]], Mask | None] | None:
    """Where a constraint plainly holds over columns, if that is known here."""
    if name in HOLDS:
        holds = HOLDS[name]
        return lambda columns: holds(*columns)
    if name in TRUTHS:
        test = TRUTHS[name]

        def told(columns: list[Column]) -> Mask:
            yes, no = truth(columns[0])
            holds, fails = test(*columns[1:])
            return (yes & holds) | (no & fails)

        return told
    if name in COMPUTED:
        index = 0 if COMPUTED[name][0] == 0 else -1

        def computed(columns: list[Column]) -> Mask | None:
            inputs = columns[1:] if index == 0 else columns[:-1]
            expected = value_of(name, inputs)
            if expected is None:
                return None
            holds = conforms(columns[index], expected)
            return holds if expected.bad is None else holds & ~expected.bad

        return computed
    if name == "temporalDistance":
        return lambda columns: _distance(*columns)
    if name == "towards":
        return lambda columns: points(*columns)
    return None


def _distance(earlier: Column, gap: Column, later: Column) -> Mask | None:
    expected = value_of("addEq", [earlier, gap])
    return None if expected is None or expected.bad is not None else conforms(later, expected)


def _define(post: Post, index: int, slot: int, names: VariableNames) -> RowStep:
    """Compute a part of an expression from the constraint that defines it."""
    solve = solver(post.name, index, len(post.operands))
    others = [row_reader(each, names) for k, each in enumerate(post.operands) if k != index]
    if solve is None:
        return _define_slot(slot, lambda frame: unknown())
    quick = _solved(post.name, index, len(post.operands))
    is_function, compares = post.name in COMPUTED, post.name == "testLeq" and index == 0

    def make(frame: RowFrame) -> Column:
        columns = [read(frame) for read in others]
        takes_ranges = compares and columns[0].kind == INT and columns[1].kind == INT
        for each in columns:
            (frame.fit if takes_ranges else frame.use)(each)
        if is_function:
            _need_numbers(columns)
        found = None if quick is None else quick(columns, frame)
        if found is not None:
            return found
        texts = frame.tables.texts
        rows = np.arange(frame.tally.count)
        given = zip(*[column.values(texts, rows) for column in columns], strict=True)
        return column_of([solve(*values) for values in given], texts)

    return _define_slot(slot, make)


def _solved(name: str, index: int, count: int) -> Callable[[list[Column], RowFrame], Column | None] | None:
    """The value that a constraint gives one of its arguments, over columns without open values."""
    if name in TRUTHS and index == 0:
        test = TRUTHS[name]

        def told(columns: list[Column], frame: RowFrame) -> Column:
            holds, fails = test(*columns)
            frame.tally.need(holds | fails)
            return Column(INT, holds.astype(float))

        return told
    if name in COMPUTED and index == result_index(name, count):
        return lambda columns, frame: value_of(name, columns)
    if name in ("eq", "concurrent") and count == 2:
        return lambda columns, frame: columns[0]
    if name == "addEq":
        return lambda columns, frame: difference_of(columns[1], columns[0])
    if name == "neg" and index == 0:
        return lambda columns, frame: value_of("neg", columns)
    return None


# ---- branches ----


def _guard(guard: Guard, then: list[RowStep], otherwise: list[RowStep], names: VariableNames) -> RowStep:
    condition = row_reader(guard.condition, names)

    def step(frame: RowFrame) -> None:
        reached = next(frame.guards, None)
        if reached is None:
            raise UnplainError
        _judge_branches(frame, reached, frame.use(condition(frame)))
        for part in reached:
            if part.run is None:
                continue
            inner = frame.branch(part)
            try:
                for each in then if part.branch == "then" else otherwise:
                    each(inner)
            except UnplainError:
                if part.rows is None:
                    raise
                inner.tally.holds[:] = False
            if part.rows is not None:
                frame.tally.add(part.rows, inner.tally)

    return step


def _judge_branches(frame: RowFrame, reached: GuardRows, condition: Column) -> None:
    """Judge which branches were taken; a guard that waits is left to the judge of single tokens."""
    tally = frame.tally
    yes, no = (np.ones(1, bool), np.zeros(1, bool)) if condition.kind == TEXT else truth(condition)
    right = np.zeros(tally.count, bool)
    for part in reached:
        if part.branch == "waiting":
            continue
        holds = yes if part.branch == "then" else no
        if part.rows is None:
            right |= holds
        else:
            right[part.rows] = holds if len(holds) == 1 else holds.take(part.rows)
    tally.judge(right)


_ROWS = StepMaker(
    _variable,
    _unplain,
    _assign,
    _sample,
    row_child,
    row_relate,
    _unplain,
    _define,
    _pass_over,
    _check,
    _check_loose,
    _guard,
    _unplain,
)


def compile_rows(body: tuple[Instruction, ...], names: VariableNames, written: Written) -> list[RowStep]:
    """The steps of a body for many runs."""
    return compile_body(body, names, written, _ROWS)
