"""Judge tokens that were recorded in columns: by compiled straight code, written once for each kind of run."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from checker.judge.bench import Bench
from checker.judge.bodies import Written
from checker.judge.bulk_relating import fitting_predicates
from checker.judge.columns import Array, Mask, Texts
from checker.judge.operands import VariableNames
from checker.judge.row_code import RowCode, RowWriter, UnwrittenError, value_in
from checker.judge.row_steps import RowWrite, allowed, compile_writing
from checker.judge.row_values import variable_of
from checker.judge.steps import Domain, domain_test
from checker.judge.tables import Tables
from compiler.program import DURATION, FIRST_PARAMETER, OBJECT, PredicateCode, Program
from runtime.executive.columns import RunOutline, TokenColumns, TokenGroup
from runtime.executive.record import ReactorRecord
from runtime.rows import operations as op
from runtime.rows.evaluator import RowEvaluator
from runtime.rows.operations import BLOCK

_Kind = tuple[str, tuple[RunOutline, ...]]  # predicate, and where its runs show what they did
_World = tuple[int, tuple[str, ...], tuple[tuple[str, str], ...]]  # count of texts, predicates, objects with classes


@dataclass(eq=False, slots=True)
class _Bound:
    """Code with the tables of a world."""

    code: RowCode
    numbers: Array
    registers: Array
    tables: Array


class RowJudge:
    """The code of all tokens of a program, written when first asked for."""

    def __init__(self, program: Program, written: Written, codes: dict[str, PredicateCode]) -> None:
        self.program = program
        self.written = written
        self.codes = codes
        self.texts = Texts()
        self.evaluator = RowEvaluator()
        self._rules: dict[int, tuple[VariableNames, list[RowWrite]]] = {}
        self._bodies: dict[str, tuple[VariableNames, list[RowWrite]]] = {}
        self._codes: dict[_Kind, RowCode | None] = {}
        self._bound: dict[_Kind, _Bound] = {}
        self._world: _World = (0, (), ())
        self._symbols: tuple[list[str], Array] = ([], np.zeros(0))

    def judge(self, bench: Bench, tables: Tables, tokens: TokenColumns, wanted: Mask, done: Mask) -> list[TokenGroup]:
        """Judge the wanted tokens; mark those that plainly hold as done. Groups without code come back."""
        if tables.row_of is None:
            return list(tokens.groups)
        self._look_at(tables, tokens)
        self._settle(bench.record, tables)
        left = []
        for group in tokens.groups:
            bound = self._code_of(bench, tables, group)
            if bound is None:
                left.append(group)
            else:
                self._judge_group(bench, tables, group, bound, wanted, done)
        return left

    def _look_at(self, tables: Tables, tokens: TokenColumns) -> None:
        """Give the evaluator the columns of a record."""
        known, times = self.evaluator, tokens.times
        assert tables.row_of is not None
        known.store, known.store_count = tokens.store, len(tokens.store)
        known.starts, known.ends, known.latest = times.starts, times.ends, times.latest
        known.begun = known.planned = tables.is_planned.view(np.uint8)
        known.standing, known.predicates = tables.standing, times.predicates
        known.objects, known.values = times.objects, times.values
        known.row_of, known.key_count = tables.row_of, len(tables.row_of)
        names, numbers = self._symbols
        if names != list(tokens.symbols):
            names = list(tokens.symbols)
            numbers = np.array([*map(self.texts.number, names), 0], float)
            self._symbols = names, numbers
        known.texts, known.symbol_count = numbers, len(names)
        known.object_texts = np.array([*map(self.texts.number, tokens.names)], float)

    def _settle(self, record: ReactorRecord, tables: Tables) -> None:
        """Forget what was made for other names and objects."""
        for value in record.globals:
            if isinstance(value, str):
                self.texts.number(value)
        objects = tuple([(each.name, each.class_name) for each in record.objects])
        world = (len(self.texts.names), tuple(tables.predicates), objects)
        if world != self._world:
            self._world = world
            self._bound.clear()

    def _code_of(self, bench: Bench, tables: Tables, group: TokenGroup) -> _Bound | None:
        kind = (group.predicate, tuple([run.outline for run in group.runs]))
        known = self._bound.get(kind)
        if known is None:
            if kind not in self._codes:
                self._codes[kind] = self._write(*kind)
            code = self._codes[kind]
            if code is None:
                return None
            known = self._bound[kind] = _bind(code, bench, tables)
        return known

    def _write(self, predicate: str, outlines: tuple[RunOutline, ...]) -> RowCode | None:
        """The code of all that is judged of tokens of a predicate whose rules ran so; None where there is none."""
        known = self.codes[predicate]
        if tuple([each.rule for each in outlines]) != known.rules:
            return None
        code = RowCode(self.texts)
        try:
            self._write_own(known, code)
            for number, outline in zip(known.rules, outlines, strict=True):
                names, steps = self._rule(number)
                _write_body(RowWriter(code, names, self.written, outline), steps)
        except UnwrittenError:
            return None
        return code

    def _write_own(self, known: PredicateCode, code: RowCode) -> None:
        """Times, parameters and object of a token, and the body of its predicate."""
        names, steps = self._body(known)
        writer = RowWriter(code, names, self.written, None)
        length = variable_of(writer, 0, DURATION)
        writer.check(op.AT_MOST, 0, code.constant(0 if known.is_event else 1).register, length.register)
        for k, parameter in enumerate(known.parameters):
            test = domain_test(parameter.type, parameter.domain, names)
            if test is not None:
                allowed(writer, test, variable_of(writer, 0, FIRST_PARAMETER + k))
        allowed(writer, Domain((), known.class_name, names), variable_of(writer, 0, OBJECT))
        writer.pending += bool(known.rules)  # that these have fired
        _write_body(writer, steps)

    def _body(self, known: PredicateCode) -> tuple[VariableNames, list[RowWrite]]:
        if known.name not in self._bodies:
            names = VariableNames(self.program)
            names.tokens[0] = ("", known.name)
            self._bodies[known.name] = (names, compile_writing(known.body, names, self.written))
        return self._bodies[known.name]

    def _rule(self, number: int) -> tuple[VariableNames, list[RowWrite]]:
        if number not in self._rules:
            names, rule = VariableNames(self.program), self.program.rules[number]
            names.tokens[0] = ("", rule.predicate)
            self._rules[number] = (names, compile_writing(rule.body, names, self.written))
        return self._rules[number]

    def _judge_group(
        self, bench: Bench, tables: Tables, group: TokenGroup, bound: _Bound, wanted: Mask, done: Mask
    ) -> None:
        rows, known, code = group.indices, self.evaluator, bound.code
        shown, first = (group.runs[0].shown, group.runs[0].first) if group.runs else (rows, rows)
        is_wanted = wanted.take(rows)
        if not is_wanted.all():
            kept = np.flatnonzero(is_wanted)
            rows, shown, first = rows.take(kept), shown.take(kept), first.take(kept)
        if not len(rows):
            return
        known.rows, known.count, known.shown, known.first = rows, len(rows), shown, first
        keys = group.runs[0].keys if group.runs else first
        known.child_keys, known.child_count = keys, len(keys)
        known.code, known.length, known.tables = bound.numbers, len(bound.numbers), bound.tables
        known.cells = _registers(bound, bench, self.texts)
        known.drawn = _drawn(code.samples, bench, known.starts, rows)
        holds = np.zeros(len(rows), bool)
        known.holds = holds.view(np.uint8)
        known.judged = known.open = 0
        found = known.run()
        bench.judged += known.judged
        bench.open += known.open
        for reason in code.skipped if found else ():
            bench.skip(reason, found)
        done[rows if found == len(rows) else rows[holds]] = True


def _write_body(writer: RowWriter, steps: Sequence[RowWrite]) -> None:
    for step in steps:
        step(writer)
    writer.count()


def _bind(code: RowCode, bench: Bench, tables: Tables) -> _Bound:
    """Code with the tables of the names and objects of a record."""
    names, parts, places = code.texts.names, [], {}
    room = 0
    for k, test in enumerate(code.tests):
        parts.append([test(bench, name) is True for name in names])
        places[k] = room
        room += len(names)
    for k, (child, variables) in enumerate(code.fittings):
        parts.append(fitting_predicates(tuple(tables.predicates), child, variables).tolist())
        places[-1 - k] = room
        room += len(tables.predicates)
    numbers = np.array(code.numbers, np.int64)
    for at in code.tables:
        numbers[at] = places[code.numbers[at]]
    flat = np.array([each for part in parts for each in part] or [False], np.uint8)
    return _Bound(code, numbers, np.repeat(np.array(code.registers or [0.0]), BLOCK), flat)


def _registers(bound: _Bound, bench: Bench, texts: Texts) -> Array:
    """The registers, with the global variables of a mission."""
    for register, index, kind in bound.code.globals:
        bound.registers[BLOCK * register : BLOCK * (register + 1)] = value_in(bench.globals[index], kind, texts)
    return bound.registers


def _drawn(samples: Sequence[str], bench: Bench, starts: Array, rows: Array) -> Array:
    """What is drawn for each row, draw by draw."""
    if not samples:
        return np.zeros(1)
    ticks = np.asarray(starts).take(rows)
    found = [bench.draws(name, ticks) for name in samples]
    return np.concatenate([np.full(len(rows), np.nan) if each is None else each for each in found])
