"""What row code says of many tokens is what the judge of single tokens says of each."""

from collections.abc import Iterator, Sequence
from itertools import product
from math import inf

import numpy as np
import pytest

from checker.judge import row_judge
from checker.judge.columns import Texts
from checker.judge.functions import COMPUTED
from checker.judge.meanings import MEANINGS
from checker.judge.operands import VariableNames
from checker.judge.row_code import RowCode, RowWriter, UnwrittenError
from checker.judge.row_judge import RowJudge
from checker.judge.row_steps import compile_writing
from checker.judge.solving import solver
from compiler.program import Constant, DomainConstant, LocalVariable, NewVariable, Post, TypeCode
from runtime.executive.columns import TokenColumns
from runtime.executive.record import Value
from runtime.rows.evaluator import RowEvaluator
from runtime.rows.operations import BLOCK
from tests.checker.judge.corrupted_columns import FILES, flight
from tests.checker.judge.test_bulk import VALUES
from tests.executive.flying import program

SINGLE: tuple[Value, ...] = tuple(each for each in VALUES if isinstance(each, (int, float, str)))
PROGRAM = program("a.nddl", "class A extends Timeline { predicate P { duration == 1; } } A a = new A(); close();")
SPAN = next(each.span for code in PROGRAM.predicates for each in code.body if isinstance(each, Post))
NAMES = (
    "eq",
    "concurrent",
    "neq",
    "leq",
    "lt",
    "or",
    "allDiff",
    "testEq",
    "testNeq",
    "testLeq",
    "testLessThan",
    "testAnd",
    "testOr",
    "testNot",
    "temporalDistance",
    "addEq",
    "mulEq",
    "allMin",
    "allMax",
    "neg",
    "abs",
    "sqrt",
    "floor",
    "ceil",
    "mod",
    "diffSquare",
)
COUNTS = {"testNot": 2, "neg": 2, "abs": 2, "sqrt": 2, "floor": 2, "ceil": 2, "or": 2, "eq": 2, "neq": 2}
COUNTS |= {"leq": 2, "lt": 2, "concurrent": 2}


def constant(value: Value) -> Constant:
    """An operand that has one value."""
    kind = {bool: "bool", int: "int", float: "float"}.get(type(value), "string")
    assert isinstance(value, (int, float, str))
    return Constant(DomainConstant(kind, kind, None, (value,)))


def told(body: Sequence[Post | NewVariable]) -> tuple[bool, int] | None:
    """Whether a body plainly holds, and how often it judged; None where there is no code for it."""
    names = VariableNames(PROGRAM)
    names.tokens[0] = ("", "A.P")
    code = RowCode(Texts())
    writer = RowWriter(code, names, {}, None)
    try:
        for step in compile_writing(tuple(body), names, {}):
            step(writer)
    except UnwrittenError:
        return None
    writer.count()
    known = RowEvaluator()
    known.code, known.length = np.array(code.numbers or [0], np.int64), len(code.numbers)
    known.cells = np.repeat(np.array(code.registers or [0.0]), BLOCK)
    known.rows, known.count = np.zeros(1, np.int64), 1
    known.holds = np.zeros(1, np.uint8)
    return known.run() == 1, known.judged


@pytest.mark.parametrize("name", NAMES)
def test_what_plainly_holds_in_a_row_holds_of_the_values(name: str) -> None:
    answers = 0
    for values in product(SINGLE, repeat=COUNTS.get(name, 3)):
        answer = told([Post(name, tuple(map(constant, values)), None, SPAN)])
        if answer is not None and answer[0]:
            assert MEANINGS[name](*values) is True, values
            assert answer[1] == 1
            answers += 1
    assert answers > 3


Body = list[Post | NewVariable]


def parts(name: str, some: Sequence[Value]) -> Iterator[tuple[tuple[Value, ...], Body, Body]]:
    """Values of a function, a body in which its result is what it is computed to be, and one in which it is not."""
    count = COUNTS.get(name, 3)
    index = 0 if name.startswith("test") or COMPUTED[name][0] == 0 else count - 1
    solve = solver(name, index, count)
    assert solve is not None
    for values in product(some, repeat=count - 1):
        if any(isinstance(each, str) or each == inf for each in values):
            continue
        expected = solve(*values)
        if isinstance(expected, tuple) or expected != expected:
            continue
        operands = [*map(constant, values)]
        operands.insert(index, LocalVariable(0))  # type: ignore[arg-type]
        made: Body = [NewVariable(0, None, TypeCode("float", "float", None), None, None, SPAN)]
        made.append(Post(name, tuple(operands), None, SPAN))
        same, other = (Post(each, (LocalVariable(0), constant(expected)), None, SPAN) for each in ("eq", "neq"))
        yield values, [*made, same], [*made, other]


@pytest.mark.parametrize("name", [each for each in NAMES if each in COMPUTED or each.startswith("test")])
def test_a_part_of_an_expression_has_the_value_that_it_has_in_one_run(name: str) -> None:
    answers = 0
    for values, same, other in parts(name, SINGLE):
        answer = told(same)
        assert answer in (None, (True, 1), (False, 0)), values
        assert told(other) in (None, (False, 0)), values
        answers += answer == (True, 1)
    assert answers > 3


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.parent.name)
def test_there_is_code_for_all_that_a_simulator_did(path: object, monkeypatch: pytest.MonkeyPatch) -> None:
    left: list[str] = []
    judging = row_judge.RowJudge.judge

    def noting(self: RowJudge, *given: object) -> object:
        found = judging(self, *given)  # type: ignore[arg-type]
        left.extend(each.predicate for each in found)
        return found

    flown = flight(path, 2)  # type: ignore[arg-type]
    monkeypatch.setattr(row_judge.RowJudge, "judge", noting)
    tokens = next(each.tokens for each in flown.record.reactors if isinstance(each.tokens, TokenColumns))
    assert flown.report(tokens).holds
    assert left == []
