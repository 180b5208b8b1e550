"""What straight code says of a token is what the judge of single tokens says of it."""

from collections.abc import Sequence
from itertools import product

import pytest

from checker.judge.bench import Bench
from checker.judge.functions import COMPUTED
from checker.judge.meanings import MEANINGS
from checker.judge.operands import VariableNames
from checker.judge.row_code import UnwrittenError
from checker.judge.straight_code import StraightText, StraightWriter, finish
from checker.judge.straight_judge import StraightJudge
from checker.judge.straight_steps import compile_straight
from compiler.program import NewVariable, Post
from runtime.executive.record import ReactorRecord, TokenRecord
from tests.checker.judge.corruption import again
from tests.checker.judge.missions import MISSIONS
from tests.checker.judge.test_rows import COUNTS, NAMES, PROGRAM, SINGLE, SPAN, constant, parts

SOME = SINGLE[::2]  # code is written for each row of values
BENCH = Bench(ReactorRecord("a", 9, (), (), (), ()), 9, lambda parameter, ticks: None)


def told(body: Sequence[Post | NewVariable]) -> tuple[int, int] | None:
    """How often a body judged, and left open, if it plainly holds."""
    names = VariableNames(PROGRAM)
    names.tokens[0] = ("", "A.P")
    text = StraightText()
    writer = StraightWriter(text, names, {})
    try:
        for step in compile_straight(tuple(body), names, {}):
            step(writer)
    except UnwrittenError:
        return None
    writer.count()
    return finish(text)(None, {}, BENCH)


@pytest.mark.parametrize("name", NAMES)
def test_what_plainly_holds_of_a_token_holds_of_the_values(name: str) -> None:
    answers = 0
    for values in product(SINGLE if COUNTS.get(name) == 2 else SOME, repeat=COUNTS.get(name, 3)):
        if told([Post(name, tuple(map(constant, values)), None, SPAN)]) is not None:
            assert MEANINGS[name](*values) is True, values
            answers += 1
    assert answers > 2


@pytest.mark.parametrize("name", [each for each in NAMES if each in COMPUTED or each.startswith("test")])
def test_a_part_of_an_expression_has_the_value_that_a_run_gives_it(name: str) -> None:
    answers = 0
    for values, same, other in parts(name, SOME):
        answer = told(same)
        assert answer in (None, (1, 0)), values
        assert told(other) is None, values
        answers += answer == (1, 0)
    assert answers > 2


def test_straight_code_leaves_what_goes_on_or_was_cut_off(monkeypatch: pytest.MonkeyPatch) -> None:
    left: list[TokenRecord] = []
    judging = StraightJudge.judge

    def noting(self: StraightJudge, bench: Bench, tokens: Sequence[TokenRecord]) -> list[TokenRecord]:
        found = judging(self, bench, tokens)
        left.extend(found)
        return found

    mission = MISSIONS["surveying"](3)
    monkeypatch.setattr(StraightJudge, "judge", noting)
    assert again(mission).holds
    assert all(not isinstance(one.end, int) or one.fate in ("cut", "end") for one in left), left
