"""Draws are the same everywhere, and distributed as promised."""

import math
from collections import Counter
from statistics import NormalDist, fmean, variance

import numpy as np
import pytest
from scipy import stats

from checker.sampling.seeds import mission_seed
from runtime.executive.chance import draw, draw_bits, sample
from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.expression import ExpressionError, parse_expression
from runtime.executive.normal import natural_logarithm, normal_quantile


@pytest.mark.parametrize(
    ("seed", "name", "index", "bits", "value"),
    [
        (0, "A", 0, 0x761DCA90DAFCAE02, 0.4613920787478373),
        (7234, "GPS_HIT_RATE", 0, 0xF3EB3120A3961547, 0.9528074936566429),
        (7234, "GPS_HIT_RATE", 1, 0x9F498154F8FD3036, 0.6222153503849668),
        (-1, "é", 2**40, 0x6636DAC391E7C906, 0.39927451395661173),
    ],
)
def test_a_draw_has_its_reference_value(seed: int, name: str, index: int, bits: int, value: float) -> None:
    assert draw_bits(seed, name, index) == bits
    assert draw(seed, name, index) == value


def test_draws_are_even_and_independent() -> None:
    ones = [draw(seed, "A", 0) for seed in range(20_000)]
    others = [draw(seed, "B", 0) for seed in range(20_000)]
    assert fmean(ones) == pytest.approx(0.5, abs=0.01)
    assert variance(ones) == pytest.approx(1 / 12, abs=0.002)
    covariance = fmean(a * b for a, b in zip(ones, others, strict=True)) - fmean(ones) * fmean(others)
    assert abs(covariance * 12) < 0.02


@pytest.mark.parametrize(
    ("share", "value"),
    [
        (0.5, 0.0),
        (0.975, 1.959963984540054),
        (0.025, -1.9599639845400545),
        (0.9999, 3.719016485455709),
        (1e-10, -6.361340902404056),
        (1e-300, -37.0471),
    ],
)
def test_the_normal_quantile_has_known_values(share: float, value: float) -> None:
    assert normal_quantile(share) == pytest.approx(value, rel=1e-6 if share == 1e-300 else 1e-14)


def test_the_normal_quantile_agrees_with_the_standard_library() -> None:
    for step in range(1, 5000):
        share = step / 5000
        assert normal_quantile(share) == pytest.approx(NormalDist().inv_cdf(share), rel=1e-14, abs=1e-15)


def test_the_logarithm_needs_no_libm() -> None:
    assert natural_logarithm(1.0) == 0.0
    assert natural_logarithm(10.0) == pytest.approx(2.302585092994046, rel=3e-16)
    assert natural_logarithm(2.0**-1000) == pytest.approx(-693.1471805599453, rel=3e-16)


@pytest.mark.parametrize("distribution", ["uniform", "normal"])
def test_a_distribution_is_matched_to_the_range(distribution: str) -> None:
    """In 100,000 draws: 4 standard errors of the mean, and 3 of the variance of a normal distribution."""
    parameter = ParameterConfiguration("P", 0.1, 4.0, distribution)
    values = np.array([sample(parameter, seed, 0).value for seed in range(100_000)])
    assert values.mean() == pytest.approx(2.05, abs=0.015)
    assert values.var() == pytest.approx(3.9**2 / 12, rel=0.0135)


def test_a_truncated_normal_stays_inside() -> None:
    parameter = ParameterConfiguration("P", 0.1, 4.0, "truncated_normal")
    assert all(0.1 <= sample(parameter, seed, 0).value <= 4.0 for seed in range(5_000))


def test_a_whole_uniform_gives_every_number_its_share() -> None:
    parameter = ParameterConfiguration("CLUSTER_ID", 0.0, 38.0, is_whole=True)
    values = [sample(parameter, seed, 0).value for seed in range(39_000)]
    counts = [values.count(float(number)) for number in range(39)]
    assert sum(counts) == 39_000
    assert min(counts) > 850


def test_a_discrete_draw_keeps_to_its_weights() -> None:
    parameter = ParameterConfiguration("P", 1.0, 3.0, "discrete", values=(1.0, 2.0, 3.0), weights=(1.0, 0.0, 3.0))
    values = [sample(parameter, seed, 0).value for seed in range(4_000)]
    assert values.count(2.0) == 0
    assert values.count(3.0) == pytest.approx(3_000, abs=120)


def test_a_draw_is_clipped_and_remembers_what_it_was() -> None:
    parameter = ParameterConfiguration("P", 0.1, 4.0, "normal", clip=(0.02, float("inf")))
    draws = [sample(parameter, seed, 0) for seed in range(1_000)]
    clipped = [one for one in draws if one.raw < 0.02]
    assert clipped
    assert all(one.value == 0.02 for one in clipped)
    assert all(one.value == one.raw for one in draws if one.raw >= 0.02)


def test_only_an_intra_parameter_changes_within_a_mission() -> None:
    inter = ParameterConfiguration("P", 0.0, 1.0)
    assert {sample(inter, 5, tick) for tick in range(100)} == {sample(inter, 5, 0)}
    intra = ParameterConfiguration("P", 0.0, 1.0, mode="intra", update=10)
    draws = [sample(intra, 5, tick) for tick in range(100)]
    assert [one.tick for one in draws] == [tick // 10 * 10 for tick in range(100)]
    assert len({one.value for one in draws}) == 10
    assert draws[0].value == sample(inter, 5, 0).value


def test_missions_have_different_seeds() -> None:
    assert [mission_seed(7234, number) for number in (1, 2, 3)] == REFERENCE
    assert len({mission_seed(7234, number) for number in range(1, 100_001)}) == 100_000
    assert all(0 <= mission_seed(1, number) < 2**32 for number in range(1, 1_000))


REFERENCE = [1635799601, 967531508, 3592271144]


def test_a_given_normal_has_its_mean_and_deviation() -> None:
    parameter = ParameterConfiguration("P", 0.0, 0.0, "normal", mean=7.0, deviation=0.5)
    values = [sample(parameter, seed, 0).value for seed in range(20_000)]
    assert stats.kstest(values, stats.norm(7.0, 0.5).cdf).pvalue > 0.001


def test_a_given_normal_is_truncated_to_its_range() -> None:
    parameter = ParameterConfiguration("P", 6.0, 7.2, "truncated_normal", mean=7.0, deviation=0.5)
    values = [sample(parameter, seed, 0).value for seed in range(20_000)]
    other = stats.truncnorm((6.0 - 7.0) / 0.5, (7.2 - 7.0) / 0.5, 7.0, 0.5)
    assert stats.kstest(values, other.cdf).pvalue > 0.001
    assert min(values) >= 6.0
    assert max(values) <= 7.2


def test_a_truncation_far_from_the_mean_stays_in_its_range() -> None:
    parameter = ParameterConfiguration("P", 60.0, 61.0, "truncated_normal", mean=7.0, deviation=0.5)
    assert all(60.0 <= sample(parameter, seed, 0).value <= 61.0 for seed in range(100))


def test_parameters_of_one_stream_are_drawn_together() -> None:
    columns = ((1.0, 2.0, 3.0), (10.0, 20.0, 30.0))
    one, other = (
        ParameterConfiguration(name, 0.0, 0.0, "discrete", values=column, weights=(1.0, 1.0, 2.0), stream="joint S")
        for name, column in zip("AB", columns, strict=True)
    )
    pairs = Counter((sample(one, seed, 0).value, sample(other, seed, 0).value) for seed in range(4_000))
    assert set(pairs) == set(zip(*columns, strict=True))
    assert pairs[3.0, 30.0] == pytest.approx(2_000, abs=150)


def test_a_share_stands_in_place_of_the_draw() -> None:
    parameter = ParameterConfiguration("P", 1.0, 3.0, share=0.25)
    assert {sample(parameter, seed, 0).value for seed in range(9)} == {1.5}


@pytest.fixture(scope="module")
def hit_rates() -> list[float]:
    """Of 100,000 missions."""
    return [draw(seed, "GPS_HIT_RATE", 0) for seed in range(100_000)]


@pytest.mark.parametrize("name", list("ABCDEF"))
def test_streams_of_different_names_are_not_correlated(name: str, hit_rates: list[float]) -> None:
    others = [draw(seed, name, 0) for seed in range(100_000)]
    assert abs(stats.pearsonr(hit_rates, others).statistic) < 0.01


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2 * A + B / 4", 7.0),
        ("-A if A > B else min(A, B, 1.5) + max(0, A)", 4.5),
        ("abs(-A) * floor(2.7) - ceil(B - 3.5) + sqrt(16)", 9.0),
        ("not A == 3 or B >= 4 and A != B", 1.0),
        ("1 < A < 3", 0.0),
    ],
)
def test_an_expression_has_the_value_that_python_gives_it(text: str, value: float) -> None:
    found = parse_expression(text)
    assert set(found.names) <= {"A", "B"}
    assert found.value({"A": 3.0, "B": 4.0}) == value
    functions = {"abs": abs, "min": min, "max": max, "floor": math.floor, "ceil": math.ceil, "sqrt": math.sqrt}
    assert float(eval(text, functions, {"A": 3.0, "B": 4.0})) == value


@pytest.mark.parametrize(
    "text",
    [
        "", "A +", "A ** 9", "__import__('os')", "A.real", "A[0]", "lambda: A", "exp(A)", "min(A)", "'a'", "True",
        "A if", "(" * 300 + "A" + ")" * 300, "-" * 300 + "A", "A" * 2000, "1e999", "f(x=1)", "[A]", "A @ B",
    ],
)  # fmt: skip
def test_what_is_no_arithmetic_is_refused(text: str) -> None:
    with pytest.raises(ExpressionError):
        parse_expression(text)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("A <= 40 && B < 3", "A <= 40 and B < 3"),
        ("A<1||B<1", "A<1 or B<1"),
        ("!(A < 1)", "not (A < 1)"),
        ("A != 1 AND B = 2", "A != 1 and B == 2"),
        ("A =< 4", "A <= 4"),
        ("A <> 4", "A != 4"),
        ("A =", ""),
        ("3 && 4", ""),
        ("A + + &&", ""),
    ],
)
def test_signs_of_other_languages_are_told_as_they_are_written_here(text: str, meant: str) -> None:
    with pytest.raises(ExpressionError) as told:
        parse_expression(text)
    assert told.value.meant == meant


def test_an_expression_without_a_value_says_so() -> None:
    with pytest.raises(ExpressionError, match="it has no value for A = 0: float division by zero"):
        parse_expression("1 / A").value({"A": 0.0})
    with pytest.raises(ExpressionError, match="not finite"):
        parse_expression("A * A").value({"A": 1e200})
    with pytest.raises(ExpressionError, match="cannot be held"):
        parse_expression("A * A").value({"A": 5e7})
