"""Intervals have the values of the tables, and the decision follows its rule."""

import math

import pytest

from checker.statistics import exact_interval, incomplete_beta, judge_rate, wilson_interval


@pytest.mark.parametrize(
    ("failures", "lower", "upper"),
    [(0, 0.0, 0.019), (8, 0.020, 0.077), (22, 0.074, 0.161), (40, 0.150, 0.261)],
)
def test_wilson_intervals_at_200_missions(failures: int, lower: float, upper: float) -> None:
    """The values of the reference of T-REX, 5.7."""
    found = wilson_interval(failures, 200, 0.95)
    assert found == pytest.approx((lower, upper), abs=5e-4)


@pytest.mark.parametrize(
    ("failures", "missions", "lower", "upper"),
    [
        (0, 10, 0.0, 0.308497107),
        (1, 10, 0.002528579, 0.445016117),
        (5, 10, 0.187086028, 0.812913972),
        (10, 10, 0.691502893, 1.0),
        (0, 400, 0.0, 1 - 0.025 ** (1 / 400)),
    ],
)
def test_exact_intervals_have_known_values(failures: int, missions: int, lower: float, upper: float) -> None:
    assert exact_interval(failures, missions, 0.95) == pytest.approx((lower, upper), abs=1e-8)


@pytest.mark.parametrize("trials", [1, 7, 40, 300])
def test_the_incomplete_beta_is_the_binomial_tail(trials: int) -> None:
    for share in (0.01, 0.2, 0.5, 0.93):
        for least in {1, trials // 3 + 1, trials}:
            tail = math.fsum(
                math.comb(trials, k) * share**k * (1 - share) ** (trials - k) for k in range(least, trials + 1)
            )
            assert incomplete_beta(least, trials - least + 1, share) == pytest.approx(tail, rel=1e-10)


def test_the_incomplete_beta_has_its_ends_and_its_symmetry() -> None:
    assert incomplete_beta(3, 4, 0.0) == 0.0
    assert incomplete_beta(3, 4, 1.0) == 1.0
    assert incomplete_beta(2.5, 1.5, 0.3) == pytest.approx(1 - incomplete_beta(1.5, 2.5, 0.7), abs=1e-14)
    assert incomplete_beta(0.5, 0.5, 0.25) == pytest.approx(1 / 3, abs=1e-13)


def test_no_missions_say_nothing() -> None:
    assert wilson_interval(0, 0, 0.95) == exact_interval(0, 0, 0.95) == (0.0, 1.0)


def test_the_check_fails_when_the_observed_rate_is_above_the_limit() -> None:
    assert not judge_rate(2, 200, 0.01, 0.95).exceeds
    assert judge_rate(3, 200, 0.01, 0.95).exceeds
    assert not judge_rate(3, 200, 0.01, 0.95).is_certain
    assert judge_rate(20, 200, 0.01, 0.95).is_certain
    assert judge_rate(0, 400, 0.01, 0.95).is_certain
    assert not judge_rate(0, 10, 0.01, 0.95).is_certain
