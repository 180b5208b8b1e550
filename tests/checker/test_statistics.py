"""Intervals have the values of the tables, and the decision follows its rule."""

import math

import pytest

from checker.betting import betting_interval
from checker.rate import judge_rate
from checker.sampling.adaptive import Adaptive
from checker.statistics import confidence_sequence, exact_interval, incomplete_beta


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


def test_the_intervals_are_those_that_the_page_describes() -> None:
    """docs/mission.md: the bounds are where what it compares is equal."""

    def beta(a: float, b: float) -> float:
        return math.exp(math.lgamma(a) + math.lgamma(b) - math.lgamma(a + b))

    mean = sum(beta(a + 10, b + 32) / beta(a, b) for a, b in ((0.5, 0.5), (0.5, 50.0))) / 2
    for rate in confidence_sequence(10, 42, 0.95):
        assert rate**10 * (1 - rate) ** 32 == pytest.approx(0.05 * mean, rel=1e-5)
    stakes = (0.999, 0.98, 0.9, 0.75, *(0.5**power for power in range(1, 12)))
    counted, most = [0.4, 0.0, 0.0, 0.0, 0.0, 1.2] * 20, Adaptive.most_weight
    assert most == 1 / 0.35
    lower, upper = betting_interval(counted, most, 0.95)
    below = sum(math.prod(1 + c * (one / lower - 1) for one in counted) for c in stakes) / len(stakes)
    above = sum(math.prod(1 + c * (upper - one) / (most - upper) for one in counted) for c in stakes) / len(stakes)
    assert (below, above) == pytest.approx((40.0, 40.0), rel=1e-4)


def test_no_missions_say_nothing() -> None:
    assert exact_interval(0, 0, 0.95) == (0.0, 1.0)


def test_the_check_fails_when_the_observed_rate_is_above_the_limit() -> None:
    assert not judge_rate(2, 200, 0.01, 0.95).exceeds
    assert judge_rate(3, 200, 0.01, 0.95).exceeds
    assert not judge_rate(3, 200, 0.01, 0.95).is_certain
    assert judge_rate(20, 200, 0.01, 0.95).is_certain
    assert judge_rate(0, 400, 0.01, 0.95).is_certain
    assert not judge_rate(0, 10, 0.01, 0.95).is_certain


@pytest.mark.parametrize("share", [0.01, 0.05, 0.3])
@pytest.mark.parametrize("most", [1, 3, 10_000])
def test_the_interval_covers_whether_or_not_the_batch_ends_with_its_kth_failure(share: float, most: int) -> None:
    """Exact coverage: every way that at most 60 missions can end, weighed by its probability."""
    missions, covered, going = 60, 0.0, {0: 1.0}
    for flown in range(1, missions + 1):
        ahead: dict[int, float] = {}
        for failures, weight in going.items():
            for more, chance in ((0, 1.0 - share), (1, share)):
                ahead[failures + more] = ahead.get(failures + more, 0.0) + weight * chance
        ended = {failures for failures in ahead if failures >= most or flown == missions}
        for failures in ended:
            lower, upper = exact_interval(failures, flown, 0.95)
            covered += ahead.pop(failures) * (lower <= share <= upper)
        going = ahead
    assert covered >= 0.95
