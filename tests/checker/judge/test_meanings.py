"""What the judge makes of constraints, relations and draws, by itself."""

from math import inf
from typing import Any

import numpy as np
import pytest

from checker.judge.draws import drawn
from checker.judge.functions import COMPUTED
from checker.judge.meanings import MEANINGS, SILENT
from checker.judge.relations import DEMANDS, demands
from checker.judge.solving import solver
from nddl_lang.semantics.constraints import CONSTRAINTS
from nddl_lang.semantics.relations import REFUSED_RELATIONS, RELATIONS
from runtime.executive.chance import sample
from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.record import OpenValues, Value, ValueRange

# What the judge says that it does not judge: domains rather than values, positions, dates.
UNJUDGED = {"eqUnion", "memberImply", "lockCT", "testSingleton", "testSpecified", "commonAncestor", "hasAncestor"}
UNJUDGED |= {"bind", "ll_dist", "wgsdisplace", "wgsdisplacement", "tick_date", "circle_mod"}
ELSEWHERE = {"uses", "sampledParameter"}  # judged with resources and draws


def test_every_constraint_of_the_language_is_judged_or_known_not_to_be() -> None:
    named = {name for name, row in CONSTRAINTS.items() if row.alias_of is None}
    assert named - UNJUDGED - ELSEWHERE - SILENT <= set(MEANINGS)
    assert not UNJUDGED & set(MEANINGS)


@pytest.mark.parametrize(
    ("name", "values", "answer"),
    [
        ("addEq", (2, 3, 5), True),
        ("addEq", (2, 3, 6), False),
        ("addEq", (0.1, 0.2, 0.3), True),
        ("addEq", (0.1, 0.2, 0.3001), False),
        ("addEq", (ValueRange(1, 4), 3, 6), None),
        ("addEq", (ValueRange(1, 4), 3, 9), False),
        ("mulEq", (2.5, 4, 10.0), True),
        ("mulEq", (1e6, 1e6, 1e12), True),
        ("mulEq", (3, 4, 13), False),
        ("divEq", (7, 2, 3), False),
        ("divEq", (6, 2, 3), True),
        ("divEq", (6, 0, 3), False),
        ("ceil", (4, 3.0000001), True),
        ("ceil", (3, 3.0000001), True),
        ("ceil", (5, 3.5), False),
        ("floor", (-3, -2.5), True),
        ("mod", (-1.0, -7, 3), True),
        ("leq", (3, 3), True),
        ("leq", (4, 3), False),
        ("lt", (3, 3), False),
        ("lt", (ValueRange(1, 2), 3), True),
        ("neq", ("red", "red"), False),
        ("eq", (OpenValues(("red", "blue")), "green"), False),
        ("eq", (OpenValues(("red", "blue")), "red"), None),
        ("testLeq", (False, 2, 3), False),
        ("testLessThan", (True, 10.0, 10.1), True),
        ("testLessThan", (False, 10.0, 10.1), False),
        ("testLessThan", (True, 10.0, 10.000000000000007), None),
        ("testLessThan", (False, 10.0, 10.000000000000007), None),
        ("testLessThan", (True, 10.0, 10.0), False),
        ("eq", (72.5, inf), False),
        ("leq", (72.5, inf), True),
        ("towards", (0.6, 0.8, 1.0, 1.0, 4.0, 5.0), True),
        ("towards", (0.8, 0.6, 1.0, 1.0, 4.0, 5.0), False),
        ("towards", (-0.6, -0.8, 1.0, 1.0, 4.0, 5.0), False),
        ("towards", (0.6001, 0.7999, 1.0, 1.0, 4.0, 5.0), False),
        ("towards", (0.0, 0.0, 2.0, 3.0, 2.0, 3.0), True),
        ("towards", (1.0, 0.0, 2.0, 3.0, 2.0, 3.0), False),
        ("towards", (0.0, 1.0, 2.0, 3.0, 2.00001, 3.0), None),
        ("towards", (0.0, 1.0, 2.0, 3.0, ValueRange(2.0, 9.0), 3.0), None),
        ("testAnd", (False, True, ValueRange(0, 1)), None),
        ("or", (False, False), False),
        ("or", (False, ValueRange(0, 1), True), True),
        ("allDiff", (1, 2, 1), False),
        ("countZeroes", (1, 0, 3), True),
        ("countNonZeroes", (2, 0, 3), False),
        ("temporalDistance", (3, ValueRange(2, 5), 9), False),
        ("temporalDistance", (3, 4, 7), True),
        ("sinf", (0.5, 30.0), True),
        ("absf", (2.0, -2.0), True),
        ("travelTime", (5, 0.0, 0.0, 3.0, 4.0, 1.0), True),
        ("withinBounds", (5, ValueRange(1, 2), ValueRange(3, 4)), False),
    ],
)
def test_a_constraint_means_what_the_language_says(name: str, values: tuple[Value, ...], answer: bool | None) -> None:
    assert MEANINGS[name](*values) is answer


def test_a_part_of_an_expression_is_computed() -> None:
    add = solver("addEq", 1, 3)
    assert add is not None and add(2, 9) == 7
    test = solver("testLessThan", 0, 3)
    assert test is not None and test(2, 3) is True and test(ValueRange(0, 9), 3) == ValueRange(0, 1)
    assert solver("or", 0, 2) is None
    assert {name for name, row in COMPUTED.items() if row[0] not in (0, -1)} == set()


@pytest.mark.parametrize("name", sorted(set(RELATIONS) - set(REFUSED_RELATIONS)))
def test_relations_agree_with_the_table_of_the_language(name: str) -> None:
    points = ("origin.start", "origin.end", "target.start", "target.end")
    written = {(points[a], points[b], lower, upper) for a, b, lower, upper in DEMANDS[name]}
    table = {
        (one.earlier.value, one.later.value, one.lower, inf if one.upper >= 2**51 else one.upper)
        for one in RELATIONS[name].distances
    }
    assert written == table


def test_bounds_take_the_place_of_those_of_the_relation() -> None:
    assert demands("before", ((2, 5),)) == ((1, 2, 2, 5),)


@pytest.mark.parametrize("kind", ["uniform", "normal", "truncated_normal", "discrete", "fixed"])
def test_draws_are_those_of_the_mission(kind: Any) -> None:
    values = (2.0, 3.5, 9.0)
    for is_whole in (False, True):
        place = ParameterConfiguration(
            "P",
            2.0,
            9.0,
            kind,
            "intra",
            7,
            (2.5, 8.5),
            is_whole,
            values,
            (1.0, 2.0, 1.0),
        )
        for seed in (0, 7, 2**53 - 1):
            for tick in range(0, 70, 3):
                values_drawn = drawn(place, seed, np.array([tick]))
                assert values_drawn is not None
                (value,) = values_drawn
                assert value == pytest.approx(sample(place, seed, tick).value, abs=1e-9)
