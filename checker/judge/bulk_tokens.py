"""Judge tokens that are alike at once: of one predicate, with the same rules fired.

What plainly holds is judged here. All other tokens are left to the judge of single tokens, whose answer is the same
and who finds the words; it is asked for few tokens where a mission is right.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from checker.judge.alike import AlikeTokens, alike_columns
from checker.judge.bench import Bench
from checker.judge.bodies import Written
from checker.judge.bulk_frame import RowFrame, RowStep, RowTally, UnplainError
from checker.judge.bulk_steps import allowed, compile_rows
from checker.judge.columns import INT, Array, Mask
from checker.judge.operands import VariableNames
from checker.judge.row_judge import RowJudge
from checker.judge.steps import Domain, domain_test
from checker.judge.tables import RowTokens, Tables
from compiler.program import END, FIRST_PARAMETER, OBJECT, START, PredicateCode, Program, RuleCode
from runtime.executive.record import TokenRecord

_FEWEST = 12  # tokens that are alike, for which a group is worth its cost


@dataclass(frozen=True, eq=False, slots=True)
class _PredicateRows:
    """A predicate ready to be judged in bulk."""

    code: PredicateCode
    tests: tuple[tuple[int, Domain], ...]
    object_test: Domain
    body: tuple[RowStep, ...]


@dataclass(eq=False, slots=True)
class BulkJudge:
    """What a program says of many tokens at once; compiled when first asked for."""

    program: Program
    written: Written
    codes: dict[str, PredicateCode]
    rows: RowJudge = field(init=False)
    _predicates: dict[str, _PredicateRows] = field(default_factory=dict)
    _rules: dict[int, tuple[RuleCode, list[RowStep]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """No code is written yet."""
        self.rows = RowJudge(self.program, self.written, self.codes)

    def predicate(self, name: str) -> _PredicateRows:
        """A predicate, compiled."""
        known = self._predicates.get(name)
        if known is None:
            code = self.codes[name]
            names = VariableNames(self.program)
            names.tokens[0] = ("", name)
            tests = []
            for k, parameter in enumerate(code.parameters):
                test = domain_test(parameter.type, parameter.domain, names)
                if test is not None:
                    tests.append((FIRST_PARAMETER + k, test))
            body = tuple(compile_rows(code.body, names, self.written))
            holder = Domain((), code.class_name, names)
            known = self._predicates[name] = _PredicateRows(code, tuple(tests), holder, body)
        return known

    def rule(self, number: int) -> tuple[RuleCode, list[RowStep]]:
        """A rule, compiled."""
        known = self._rules.get(number)
        if known is None:
            rule = self.program.rules[number]
            names = VariableNames(self.program)
            names.tokens[0] = ("", rule.predicate)
            known = self._rules[number] = (rule, compile_rows(rule.body, names, self.written))
        return known


def judge_in_bulk(judge: BulkJudge, bench: Bench, tables: Tables) -> Iterator[TokenRecord]:
    """Judge what plainly holds; yield the tokens that are left, in their order."""
    done = ~tables.is_planned
    if tables.is_ordered and tables.count:
        starts = tables.times[START]
        latest = starts.lower if starts.upper is None else starts.upper
        fits = True if starts.bad is None else ~starts.bad
        done |= tables.is_active & (latest > bench.last_tick) & fits
        _judge_merged(bench, tables, done)
        with np.errstate(all="ignore"):
            wanted = ~done & tables.is_active & ~tables.is_cut
            for each in (starts, tables.times[END]):
                if each.open is not None:
                    wanted &= ~each.open
            for group in _groups(judge, bench, tables, wanted, done):
                holds = _judge_group(judge, bench, tables, group)
                done[group.rows[holds]] = True
    return (tables.tokens[row] for row in np.flatnonzero(~done).tolist())


def _groups(judge: BulkJudge, bench: Bench, tables: Tables, wanted: Mask, done: Mask) -> Iterator[AlikeTokens]:
    """The groups that are judged on arrays, which have no code for rows."""
    left = judge.rows.judge(bench, tables, tables.tokens, wanted, done)
    return alike_columns(left, tables.tokens, tables.texts, wanted, _FEWEST)


def _judge_merged(bench: Bench, tables: Tables, done: Array) -> None:
    """Judge merged tokens with the very values of the one that stands for them."""
    rows = np.flatnonzero(tables.is_merged & ~tables.is_cut & (tables.standing != np.arange(tables.count)))
    others = tables.standing[rows]
    alike = tables.predicate[rows] == tables.predicate[others]
    for each in (START, END):
        mine, theirs = tables.times[each].take(rows), tables.times[each].take(others)
        if mine.bad is not None:
            return
        alike &= mine.lower == theirs.lower
        if mine.upper is not None and theirs.upper is not None:
            alike &= mine.upper == theirs.upper
    done[rows[alike]] = True
    bench.judged += int(np.count_nonzero(alike))


def _judge_group(judge: BulkJudge, bench: Bench, tables: Tables, group: AlikeTokens) -> Mask:
    """Judge tokens that are alike; those that plainly hold."""
    rows = group.rows
    nothing = np.zeros(len(rows), bool)
    known = judge.predicate(group.predicate)
    code = known.code
    if tuple(run.rule for run in group.runs) != code.rules:
        return nothing
    tok = RowTokens(tables, rows)
    tally = RowTally(len(rows))
    frame = RowFrame(bench, tok, [None] * code.body_slots, [tok, *[None] * code.body_tokens])
    frame.tally = tally
    try:
        _judge_own(known, frame)
        for step in known.body:
            step(frame)
        if code.rules:
            tally.judged += 1  # that these rules have fired
        for index, number in enumerate(code.rules):
            rule, steps = judge.rule(number)
            frame = RowFrame(bench, tok, [None] * rule.slots, [tok, *[None] * rule.tokens])
            frame.tally = tally
            frame.follow(group.runs[index])
            for step in steps:
                step(frame)
            if not tally.holds.any():
                return nothing
    except UnplainError:
        return nothing
    tally.hand_over(bench, tally.holds)
    return tally.holds


def _judge_own(known: _PredicateRows, frame: RowFrame) -> None:
    """The times, the parameters and the object of tokens."""
    tally = frame.tally
    start, end = (frame.use(frame.tok.column(each)) for each in (START, END))
    length = end.lower - start.lower
    for each in (start, end):
        if each.kind != INT:
            raise UnplainError
        if each.open is not None:
            tally.need(~each.open)
    tally.judge(length >= (0 if known.code.is_event else 1))
    for index, test in known.tests:
        tally.judge(allowed(test, frame.tok.column(index), frame))
    things = frame.use(frame.tok.column(OBJECT))
    if things.kind != "s":
        raise UnplainError
    tally.judge(allowed(known.object_test, things, frame))
