"""A condition of failing separates missions with other draws; what does not is marked or not claimed."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf
from pathlib import Path

import numpy as np
import pytest

from checker.batch.result import MissionResult
from checker.conditions.condition import Condition, Extreme, Feature, Literal, Share, axis_feature, holds
from checker.conditions.find import claimed
from checker.conditions.flights import Ended
from checker.conditions.measure import Quality, measured_on, parts_that_hold
from checker.conditions.record import read_condition, write_condition
from checker.conditions.rendering import condition_claim, condition_text
from checker.conditions.rules import induce
from checker.conditions.saddles import taken_apart
from checker.conditions.space import Range, Space
from checker.oracle import Judgement, Verdict
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from runtime.executive.outcome import Draw, Outcome
from tests.checker.conditions.campaigns import RANGES, campaign, conditions, flown

pytestmark = pytest.mark.once

WHOLE = "int P = [0 10]; int Q = [0 10]; float R = [0.0 1.0];"
SIGNED = "float P = [-1.0 1.0]; float Q = [-1.0 1.0]; float R = [0.0 1.0];"
GUARDS = "bool u; bool v; u == (p > {0}); v == (q < {1});"
Truth = Callable[[float, float, float], bool]


def outside_of_a_circle(p: float, q: float, r: float) -> bool:
    return (p - 0.5) ** 2 + (q - 0.4) ** 2 > 0.2


@pytest.mark.slow
@pytest.mark.parametrize(
    ("rule", "ranges", "text", "truth"),
    [
        ("p <= 0.8;", RANGES, "P > 0.8", lambda p, q, r: p > 0.8),
        (
            GUARDS.format(0.6, 0.35) + "if (u == true) { if (v == true) { r >= 2.0; } }",
            RANGES,
            "P > 0.6 and Q < 0.35",
            lambda p, q, r: p > 0.6 and q < 0.35,
        ),
        (
            "bool u; bool v; u == (p > 0.2); v == (p < 0.5); if (u == true) { if (v == true) { r >= 2.0; } }",
            RANGES,
            "0.2 < P < 0.5",
            lambda p, q, r: 0.2 < p < 0.5,
        ),
        (
            GUARDS.format(0.5, 0.25)
            + "if (u == true) { if (v == true) { r >= 2.0; } } else { if (v == false) { r >= 2.0; } }",
            RANGES,
            None,
            lambda p, q, r: (p > 0.5) is (q < 0.25),
        ),
        ("p * q <= 0.5;", RANGES, "P * Q > 0.5", lambda p, q, r: p * q > 0.5),
        ("float s; s == p + 3.0 * q; s <= 2.5;", RANGES, "P + 3 * Q > 2.5", lambda p, q, r: p + 3 * q > 2.5),
        ("float s; s == p - q; s <= r;", RANGES, "P - Q - R > 0", lambda p, q, r: p - q - r > 0),
        ("p * p + q * q <= 1.0;", RANGES, "P * P + Q * Q > 1", lambda p, q, r: p * p + q * q > 1.0),
        ("1.37 * p + q <= 1.6;", RANGES, None, lambda p, q, r: 1.37 * p + q > 1.6),
        ("(p - 0.5) * (p - 0.5) + (q - 0.4) * (q - 0.4) <= 0.2;", RANGES, None, outside_of_a_circle),
        ("p * q + r <= 1.2;", RANGES, "P * Q + R > 1.2", lambda p, q, r: p * q + r > 1.2),
        ("p * q >= -0.3;", SIGNED, "P * Q < -0.3", lambda p, q, r: p * q < -0.3),
        ("float s; s == p + q; s <= 13.5;", WHOLE, "P + Q >= 14", lambda p, q, r: p + q >= 14),
        ("p != 3; p != 7;", WHOLE, "P = 7, or P = 3", lambda p, q, r: p in (3, 7)),
    ],
    ids=[
        "half line",
        "conjunction",
        "band",
        "equivalence",
        "product",
        "weighted sum",
        "three",
        "squares",
        "odd weight",
        "circle",
        "sum of a product",
        "product of any sign",
        "whole numbers",
        "single values",
    ],
)
def test_the_truth_is_stated(tmp_path: Path, rule: str, ranges: str, text: str | None, truth: Truth) -> None:
    (found,) = conditions(campaign(tmp_path, rule, ranges=ranges))
    assert found is not None
    assert text is None or condition_text(found) == text
    chance = np.random.default_rng(5)
    draw: dict[str, Callable[[], Sequence[float]]] = {
        RANGES: lambda: tuple(chance.random(3)),
        SIGNED: lambda: (*chance.uniform(-1.0, 1.0, 2), chance.random()),
        WHOLE: lambda: (float(chance.integers(11)), float(chance.integers(11)), chance.random()),
    }
    draws = [draw[ranges]() for _ in range(2000)]
    fails = [truth(*draw) for draw in draws]
    claimed = [holds(found.conjunctions, {name: (v, v) for name, v in zip("PQR", d, strict=True)}) for d in draws]
    both = sum(one and other for one, other in zip(fails, claimed, strict=True))
    assert both >= 0.95 * sum(fails)
    assert both >= 0.95 * sum(claimed)
    assert found.precision.value >= 0.95
    assert found.recall.value >= 0.95
    assert found.near is not None and 0 < found.near < found.fresh


@pytest.mark.slow
def test_a_failure_in_a_thousand_is_found_from_one_example(tmp_path: Path) -> None:
    rule = GUARDS.format(0.97, 0.06) + "if (u == true) { if (v == true) { r >= 2.0; } }"
    (found,) = conditions(campaign(tmp_path, rule, missions=900))
    assert found is not None
    assert condition_text(found) == "P > 0.97 and Q < 0.06"


@pytest.mark.slow
def test_two_faults_have_two_conditions(tmp_path: Path) -> None:
    found = conditions(campaign(tmp_path, "p <= 0.8;\n    q >= 0.25;"))
    assert sorted(condition_text(one) for one in found if one is not None) == ["P > 0.8", "Q < 0.25"]


@pytest.mark.slow
def test_once_the_time_is_over_no_flights_are_made_for_further_conditions(tmp_path: Path) -> None:
    """Each takes hundreds of flights: with four faults of slow missions they took ten minutes."""
    given = campaign(tmp_path, "p <= 0.8;\n    q >= 0.25;")
    for seconds, flown_for in ((1e-6, 1), (60.0, 2)):
        found = given.assess(flown(given), seconds=seconds)
        assert [one.is_tested for one in found.faults].count(True) == flown_for
        assert all(one.condition is not None for one in found.faults)


@pytest.mark.slow
def test_of_a_redrawn_parameter_the_draws_are_told_that_matter(tmp_path: Path) -> None:
    more = '[parameters.P]\nmode = "intra"\nupdate = 8'
    (found,) = conditions(campaign(tmp_path, "p <= 0.8;", more=more, missions=60, final_tick=40))
    assert found is not None
    assert condition_text(found) == "a draw of P > 0.8"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("rule", "text"),
    [
        ("p + q <= 1.6;", "P + Q > 1.6 at some draw"),
        ("p - q <= 0.4;", "P - Q > 0.4 at some draw"),
        ("q - p <= 0.6;", "P - Q < -0.6 at some draw"),
        ("p * q <= 0.7;", "P * Q > 0.7 at some draw"),
    ],
)
def test_a_term_may_have_a_redrawn_parameter(tmp_path: Path, rule: str, text: str) -> None:
    more = '[parameters.P]\nmode = "intra"\nupdate = 8'
    (found,) = conditions(campaign(tmp_path, rule, more=more, missions=200, final_tick=40))
    assert found is not None
    assert condition_text(found) == text


@pytest.mark.slow
def test_nothing_is_claimed_of_draws_that_have_to_come_together(tmp_path: Path) -> None:
    more = '[parameters.P]\nmode = "intra"\nupdate = 8\n[parameters.Q]\nmode = "intra"\nupdate = 8'
    found = conditions(campaign(tmp_path, "p + q <= 1.5;", more=more, missions=100, final_tick=60))
    assert found
    for one in found:
        assert one is None or not one.is_partial


@pytest.mark.slow
@pytest.mark.parametrize(
    ("rule", "text"),
    [
        ("if (u == true) { q <= 9.0; } else { r <= 4.0; }", "P <= 0 and R > 4, or P > 0 and Q > 9"),
        (
            "v == (p > 1.5); if (v == true) { q <= 8.0; } if (u == true) { r <= 8.0; }",
            "R > 8 and P >= 1, or Q > 8 and P >= 2",
        ),
    ],
)
def test_a_setting_is_told_as_such_and_is_no_term(tmp_path: Path, rule: str, text: str) -> None:
    ranges = f"int P = [0 {2 if 'v' in rule else 1}]; float Q = [0.0 10.0]; float R = [0.0 10.0];"
    rule = f"bool u; bool v; u == (p > 0.5); {rule}"
    (found,) = conditions(campaign(tmp_path, rule, ranges=ranges, missions=400))
    assert found is not None
    assert condition_text(found) == text


@pytest.mark.slow
def test_without_flights_half_of_the_run_is_held_back(tmp_path: Path) -> None:
    (found,) = conditions(campaign(tmp_path, "p <= 0.8;"), may_fly=False)
    assert found is not None
    assert found.near is None
    assert found.fresh == 75
    assert found.flights == 0
    assert "held back" in condition_claim(found)
    assert found.single[0].edge == pytest.approx(0.8, abs=0.05)


def row(p: float, q: float) -> dict[str, tuple[float, float]]:
    return {"P": (p, p), "Q": (q, q)}


def test_rules_leave_out_what_separates_nothing() -> None:
    chance = np.random.default_rng(1)
    rows = [row(*chance.random(2)) for _ in range(300)]
    labels = [Ended.FAILS if one["P"][0] > 0.5 else Ended.PASSES for one in rows]
    edges = [Literal(axis_feature("Q"), True, 0.3), Literal(axis_feature("P"), True, 0.5)]
    assert induce(list(zip(rows, labels, strict=True)), edges) == ((edges[1],),)
    assert induce(list(zip(rows, labels, strict=True)), edges[:1]) == ()


def test_figures_are_counted_from_the_missions() -> None:
    literal = Literal(axis_feature("P"), True, 0.5)
    rows = [(row(p / 10, 0.0), Ended.FAILS if p >= 8 else Ended.PASSES) for p in range(11)]
    found = measured_on(rows, [(literal,)])
    assert found.precision.value == pytest.approx(3 / 5)
    assert found.recall.value == 1.0
    assert found.precision.interval[0] < 3 / 5 < found.precision.interval[1]


def test_words_of_conditions() -> None:
    share = Share(0.9, (0.8, 0.95))
    high, low = Literal(axis_feature("P"), False, 0.5, holds_at_edge=True), Literal(axis_feature("P"), True, 0.25)
    drawn = Literal(axis_feature("Q", Extreme.GREATEST), True, 3.8)
    told = Condition(((low, high), (drawn,), (drawn.negation,)), share, share, 40, 10, 7)
    assert condition_text(told) == "0.25 < P <= 0.5, or a draw of Q > 3.8, or every draw of Q <= 3.8"
    assert condition_claim(told).startswith("in part when 0.25 < P")
    assert "partial: precision 90 % (80 % to 95 %)" in condition_claim(told)
    sure = Share(1.0, (0.63, 1.0))
    for fresh, said in ((12, "as far as 12 missions tell when 0.25"), (59, "when 0.25")):
        assert condition_claim(replace(told, precision=sure, recall=sure, fresh=fresh)).startswith(said)
    product = Feature(((2.0, (("P", 1), ("Q", -1))), (-1.0, (("R", 2),))))
    told = replace(told, conjunctions=((Literal(product, True, 0.1),),), in_terms=(high,))
    assert condition_text(told) == "2 * P / Q - R * R > 0.1"
    assert read_condition(write_condition(told)) == told
    assert read_condition(write_condition(None)) is None


@pytest.mark.parametrize(
    ("precision", "share", "outside", "is_told"),
    [
        (0.84, 0.88, 0.5, False),
        (0.9, 0.88, 0.5, False),
        (0.97, 0.88, 0.5, True),
        (0.84, 0.3, 0.0, True),
        (0.5, 0.02, 0.0, True),
        (0.5, 0.3, 0.0, False),
        (1.0, 1.0, None, False),  # `P < 0.4 or P >= 0.2`
        (1.0, 1.0, 1.0, False),
        (1.0, 1.0, 0.9, True),
    ],
)
def test_a_condition_that_tells_hardly_more_than_the_rate_is_none(
    precision: float, share: float, outside: float | None, is_told: bool
) -> None:
    literal = Literal(axis_feature("P"), True, 0.5)
    agent = AgentConfiguration("one", ".", 10, (), parameters=(ParameterConfiguration("P", 0.0, 1.0),))
    quality = Quality(Share(precision, (0.0, 1.0)), Share(0.9, (0.0, 1.0)), 200, 20, (), outside)
    found = claimed(((literal,),), quality, 10, Space(agent, []), share, has_flown=True)
    assert (found is not None) == is_told


def test_an_endless_range_is_that_of_what_was_drawn() -> None:
    parameter = ParameterConfiguration("P", -inf, inf, distribution="normal", mean=1.0, deviation=2.0)
    agent = AgentConfiguration("endless", ".", 10, (), parameters=(parameter,))
    draws = tuple(Draw("P", 0, value, value) for value in (-1.0, 3.0))
    results = [
        MissionResult(number, number, Judgement(Verdict.PASS), Outcome(number, 9, 9, None, (one,), (), ()), False)
        for number, one in enumerate(draws, 1)
    ]
    (found,) = Space(agent, results).parameters
    assert (found.lower, found.upper, found.at(0.5)) == (-1.0, 3.0, 1.0)


def _between(name: str, lower: float, upper: float) -> Range:
    return Range(ParameterConfiguration(name, lower, upper), lower, upper)


@pytest.mark.parametrize(
    ("edge", "ranges", "limits"),
    [
        (-27.0, ((0.0, 0.5), (4.0, 20.0)), {"SNOW": 0.3, "HOOKING": 9.0}),  # (10 * SNOW - 3) * (HOOKING - 9) > 0
        (-27.0, ((0.4, 0.5), (4.0, 20.0)), None),  # of which one part alone may be
        (-10.0, ((0.0, 0.5), (4.0, 20.0)), None),  # far from the saddle
    ],
)
def test_an_edge_through_a_saddle_is_taken_apart(
    edge: float, ranges: tuple[tuple[float, float], ...], limits: dict[str, float] | None
) -> None:
    monomials = ((10.0, (("SNOW", 1), ("HOOKING", 1))), (-90.0, (("SNOW", 1),)), (-3.0, (("HOOKING", 1),)))
    literal = Literal(Feature(monomials), True, edge)
    found = taken_apart(
        literal, [_between(name, *each) for name, each in zip(("SNOW", "HOOKING"), ranges, strict=True)]
    )
    if limits is None:
        assert found == [literal]
    else:
        assert {one.feature.parameters[0]: round(one.edge, 1) for one in found} == limits


def test_a_part_of_a_condition_that_fresh_missions_refute_is_dropped() -> None:
    parts = ((Literal(axis_feature("P"), True, 0.8),), (Literal(axis_feature("Q"), True, 0.8),))
    rows = [({"P": (0.9, 0.9), "Q": (0.1, 0.1)}, Ended.FAILS)] * 6 + [
        ({"P": (0.1, 0.1), "Q": (0.9, 0.9)}, Ended.PASSES)
    ] * 6
    assert parts_that_hold(parts, measured_on(rows, parts)) == parts[:1]
    assert parts_that_hold(parts, measured_on(rows[:8], parts)) == parts  # two missions tell nothing
