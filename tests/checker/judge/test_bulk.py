"""What is judged of many tokens at once is what the judge of single tokens says of each."""

from collections.abc import Sequence
from math import hypot, inf
from random import Random
from typing import Any

import numpy as np
import pytest

from checker.judge import bulk_tokens, judge
from checker.judge.bulk_meanings import FUNCTIONS, HOLDS, TRUTHS, conforms, near, points, value_of
from checker.judge.columns import Texts, column_of, constant, distinct
from checker.judge.functions import COMPUTED
from checker.judge.functions import conforms as conforms_one
from checker.judge.judge import judge_mission
from checker.judge.meanings import MEANINGS, TESTS
from checker.judge.plain_timelines import PlainTimelines
from checker.judge.report import JudgeReport
from checker.judge.straight_judge import StraightJudge
from runtime.executive.columns import TokenColumns
from runtime.executive.mission import record_mission
from runtime.executive.record import MissionRecord, OpenValues, TokenRecord, Value, ValueRange
from tests.checker.judge.corruption import ALTERATIONS, again
from tests.checker.judge.missions import INL, MISSIONS, loaded
from tests.executive.flying import Flown


def one_by_one(mission: Flown) -> JudgeReport:
    """The report of the judge of single tokens alone."""
    with pytest.MonkeyPatch.context() as patched:
        one_at_a_time(patched)
        return again(mission)


def one_at_a_time(patched: pytest.MonkeyPatch) -> None:
    """Leave everything to the judge of single tokens."""
    patched.setattr(judge, "_FEWEST", 10**9)
    patched.setattr(StraightJudge, "judge", lambda self, bench, tokens: list(tokens))
    for asked in ("is_in_order", "is_told"):
        patched.setattr(PlainTimelines, asked, lambda *given: False)


@pytest.mark.parametrize("name", MISSIONS)
def test_reports_are_those_of_the_judge_of_single_tokens(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(judge, "_FEWEST", 1)
    monkeypatch.setattr(bulk_tokens, "_FEWEST", 1)
    for seed in (0, 1, 2):
        mission = MISSIONS[name](seed)
        assert again(mission) == one_by_one(mission)
        for alter in ALTERATIONS:
            for number in range(4):
                changed = alter(mission, Random(f"{name} {seed} {alter.__name__} {number}"))
                if changed is not None:
                    assert again(changed) == one_by_one(changed), (seed, alter.__name__, number)


def test_most_of_a_mission_is_judged_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    mission = MISSIONS["surveying"](3)
    singles: list[TokenRecord] = []
    in_bulk = bulk_tokens.judge_in_bulk

    def counting(*given: Any) -> Sequence[TokenRecord]:
        left = list(in_bulk(*given))
        singles.extend(left)
        return left

    monkeypatch.setattr("checker.judge.tokens.judge_in_bulk", counting)
    monkeypatch.setattr(judge, "_FEWEST", 1)
    monkeypatch.setattr(bulk_tokens, "_FEWEST", 1)
    assert again(mission).holds
    assert all(isinstance(one.end, ValueRange) for one in singles)  # those that go on when the mission ends


VALUES: tuple[Value, ...] = (
    0,
    1,
    -3,
    7,
    2**52,
    True,
    False,
    0.0,
    1.0,
    -2.5,
    0.3,
    1e-6,
    7.000001,
    1e9,
    inf,
    "red",
    "blue",
)
OPEN: tuple[Value, ...] = (ValueRange(0, 1), ValueRange(-inf, 5.0), OpenValues(("red", "blue")), OpenValues((1, 2)))


def rows(dice: Random, count: int, width: int) -> list[list[Value]]:
    """Columns of one kind each, as the parameters of a predicate are."""
    kinds = [[each for each in VALUES if type(each) is kind] for kind in (int, float, bool, str)]
    return [[dice.choice(each) for _ in range(count)] for each in (dice.choice(kinds) for _ in range(width))]


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("name", [*HOLDS, *TRUTHS])
def test_what_plainly_holds_holds(name: str) -> None:
    dice, texts = Random(name), Texts()
    seen = set()
    for _ in range(60):
        columns = rows(dice, 12, 1 if name == "testNot" else 2)
        given = [column_of(each, texts) for each in columns]
        if name in HOLDS:
            answers = np.broadcast_to(HOLDS[name](*given), 12).tolist()  # one row stands for all
            wanted = [MEANINGS[name](*each) for each in zip(*columns, strict=True)]
            assert all(right is True for answer, right in zip(answers, wanted, strict=True) if answer)
            if not any(isinstance(each[0], str) for each in columns):
                assert all(answer for answer, right in zip(answers, wanted, strict=True) if right is True), columns
            seen |= set(wanted)
            continue
        holds, fails = (np.broadcast_to(each, 12) for each in TRUTHS[name](*given))
        wanted = [TESTS[name](*each) for each in zip(*columns, strict=True)]
        assert all(wanted[k] is True for k in np.flatnonzero(holds)), columns
        assert all(wanted[k] is False for k in np.flatnonzero(fails)), columns
        seen |= set(wanted)
    assert {True, False} <= seen


def test_times_are_compared_with_a_clock_that_was_never_fixed() -> None:
    dice, texts = Random(8), Texts()
    seen = set()
    for _ in range(40):
        times: list[Value] = [dice.randrange(8) for _ in range(12)]
        clocks: list[Value] = [ValueRange(first, first + dice.randrange(1, 4)) for first in range(12)]
        clocks[dice.randrange(12)] = 4
        for given in ((times, clocks), (clocks, times)):
            holds, fails = TRUTHS["testLeq"](*[column_of(each, texts) for each in given])
            wanted = [TESTS["testLeq"](*each) for each in zip(*given, strict=True)]
            assert holds.tolist() == [each is True for each in wanted]
            assert fails.tolist() == [each is False for each in wanted]
            seen |= set(wanted)
    assert seen == {True, False, None}


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_unit_vectors_are_those_of_single_tokens() -> None:
    dice, texts = Random(11), Texts()
    seen = set()
    for _ in range(40):
        rows = []
        for _ in range(12):
            x, y, tx, ty = (dice.choice((0.0, 1.0, -3.5, 200.25)) for _ in range(4))
            way = hypot(tx - x, ty - y) or 1.0
            slip = dice.choice((0.0, 0.0, 3e-6, 0.01))
            rows.append(((tx - x) / way + slip, (ty - y) / way, x, y, tx, ty))
        plain = points(*[column_of(each, texts) for each in zip(*rows, strict=True)]).tolist()
        wanted = [MEANINGS["towards"](*row) for row in rows]
        assert all(right is True for told, right in zip(plain, wanted, strict=True) if told)
        assert all(told for told, right, row in zip(plain, wanted, rows, strict=True) if right and row[2:4] != row[4:])
        seen |= set(wanted)
    assert {True, False} <= seen


ALONE = {"absVal", "abs", "absf", "neg", "sqrt", "sqrtf", "floor", "floorf", "ceil", "ceilf", "sin", "sinf"}
ALONE |= {"cosf", "deg_to_rad"}


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("name", FUNCTIONS)
def test_what_plainly_conforms_conforms(name: str) -> None:
    dice, texts = Random(name), Texts()
    _, function, monotone = COMPUTED[name]
    width = 1 if name in ALONE else 4 if name == "calcDistance" else 2
    told = 0
    for _ in range(240):
        columns = [each for each in rows(dice, 12, width) if not isinstance(each[0], str) and inf not in each]
        if len(columns) < width:
            continue
        expected = value_of(name, [column_of(each, texts) for each in columns])
        assert expected is not None
        exact = [function(*each) for each in zip(*columns, strict=True)]
        results = [each + dice.choice((0, 0, 0, 1)) for each in exact]
        found = column_of(results, texts)
        plain = conforms(found, expected)
        for column in (found, expected):
            plain &= True if column.bad is None else ~column.bad
        for k in np.flatnonzero(plain).tolist():
            inputs = tuple(each[k] for each in columns)
            told += 1
            assert conforms_one(results[k], function, inputs, monotone) is True, (results[k], inputs)
    assert told > 50


def test_a_single_value_stands_for_all_rows() -> None:
    texts = Texts()
    one, many = constant(2.5, texts), column_of([2.5, 7.0, 2.5], texts)
    rows = np.arange(3)
    assert near(one, many).tolist() == near(many, one).tolist() == [True, False, True]
    assert one.take(rows).values(texts, rows) == [2.5, 2.5, 2.5] and one.part(1, 3) is one
    assert many.part(1, 3).values(texts, rows[:2]) == [7.0, 2.5]
    found = value_of("eqMaximum", [one, many])
    assert found is not None and found.lower.tolist() == [2.5, 7.0, 2.5]


def test_sums_that_are_not_exact_on_the_way_are_left_to_the_judge_of_single_tokens() -> None:
    small, large = ([column_of([each], Texts()) for each in given] for given in ((7, 1, -1), (2**53, 1, -1)))
    found = value_of("eqSum", small)
    assert found is not None and found.lower.tolist() == [7]
    assert value_of("eqSum", large) is None


def test_distinct_numbers_are_those_that_occur() -> None:
    numbers, indices = distinct(np.array([7, 2, 7, 0]))
    assert numbers == [0, 2, 7] and indices.tolist() == [2, 1, 2, 0]
    assert distinct(np.array([], np.int64))[0] == []


def test_a_column_gives_back_its_values() -> None:
    dice, texts = Random(3), Texts()
    for _ in range(80):
        kind = dice.choice((int, float, bool, str))
        plain = [each for each in VALUES if type(each) is kind]
        given = [dice.choice((*plain, *OPEN)) for _ in range(9)]
        column = column_of(given, texts)
        for k, value in enumerate(given):
            if column.bad is None or not column.bad[k]:
                assert column.value(k, texts) == value
            else:
                assert not isinstance(value, kind)


@pytest.mark.parametrize("seed", range(3))
def test_a_record_in_columns_is_judged_like_single_tokens(seed: int) -> None:
    agent, programs = loaded(INL)
    outcome, record = record_mission(agent, programs, seed, until=400)
    assert any(isinstance(each.tokens, TokenColumns) for each in record.reactors)
    reports = [
        judge_mission(agent, programs.programs, outcome, MissionRecord(tuple(reactors)), programs.constraints)
        for reactors in (record.reactors, [each._replace(tokens=tuple(each.tokens)) for each in record.reactors])
    ]
    assert reports[0] == reports[1] and reports[0].holds and reports[0].judged > 10_000
