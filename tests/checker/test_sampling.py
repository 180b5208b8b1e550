"""Samplers choose what they promise, and the rate that is told of their missions is right: by simulation and scipy."""

import numpy as np
import pytest
from scipy import stats

from checker.batch.result import MissionResult
from checker.betting import betting_interval
from checker.oracle import Judgement, Verdict
from checker.rate import Method, judge_missions
from checker.report.sentences import rate_line
from checker.sampling.adaptive import EXPLORING, Adaptive
from checker.sampling.sampler import MissionRole, SamplePoint, Setting, ShareAxis, Trial, axes_of, with_point
from checker.sampling.seeds import mission_seed
from checker.sensitivity import sensitivities, sensitivity
from checker.statistics import LEAST_CHANCE, confidence_sequence, exact_interval, mcnemar
from checker.stopping import parse_rule
from nddlc.samplers import SAMPLERS, find_sampler
from runtime.executive.chance import sample
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from tests.checker.sampling_study import AXES, WORLDS, End, batches, coverages

pytestmark = pytest.mark.once

DESIGNS = ("lhs", "sobol")


def shares_of(points: list[SamplePoint]) -> np.ndarray:
    return np.array([[share for _, share in point.shares] for point in points if point.shares])


def chosen(name: str, missions: int, axes: tuple[ShareAxis, ...] = AXES, seed: int = 7) -> list[SamplePoint]:
    sampler = find_sampler(name)[1](Setting(axes, seed, missions))
    points: list[SamplePoint] = []
    while len(points) < missions:
        trials = [Trial(point, False) for point in points]
        points += sampler.choose(trials, missions - len(points))[: missions - len(points)]
    return points


# ---- what is chosen ----


@pytest.mark.parametrize("name", SAMPLERS)
def test_points_lie_in_the_box_and_are_the_same_again(name: str) -> None:
    points = chosen(name, 70)
    assert len(points) == 70
    assert points == chosen(name, 70)
    assert all(0.0 <= share < 1.0 for point in points for _, share in point.shares)
    if name not in ("random", "corners"):
        assert points != chosen(name, 70, seed=8)


@pytest.mark.parametrize("name", SAMPLERS)
def test_without_axes_missions_are_plain_random_ones(name: str) -> None:
    assert {(point.shares, point.weight) for point in chosen(name, 30, axes=())} == {((), 1.0)}


def test_a_latin_hypercube_has_one_mission_in_each_slice() -> None:
    rows = shares_of(chosen("lhs", 50))
    for axis in rows.T:
        assert sorted((axis * 50).astype(int)) == list(range(50))


def test_sobol_points_are_more_even_than_random_ones() -> None:
    rows = shares_of(chosen("sobol", 128))
    generator = np.random.default_rng(1)
    random = [stats.qmc.discrepancy(generator.random((128, len(AXES)))) for _ in range(20)]
    assert stats.qmc.discrepancy(rows) < min(random)


def test_corners_come_first_and_are_half_of_the_missions_at_most() -> None:
    points = chosen("corners", 200)
    corners = shares_of(points)
    assert len(corners) == 17
    assert list(corners[0]) == [0.5] * 4
    assert len({tuple(row > 0.5) for row in corners[1:]}) == 16
    assert len(shares_of(chosen("corners", 10))) == 5


def test_a_corner_of_a_matched_normal_is_the_end_of_its_range() -> None:
    normal = ParameterConfiguration("N", -0.6, 0.6, "normal")
    agent = AgentConfiguration("a", "", 10, (), parameters=(normal,))
    points = chosen("corners", 20, axes_of(agent))
    values = {round(sample(with_point(agent, point).parameters[0], 1, 0).raw, 9) for point in points if point.shares}
    assert values == {0.0, -0.6, 0.6}


@pytest.mark.parametrize("name", ["art", "art-partition"])
def test_adaptive_random_testing_finds_a_block_sooner_than_chance(name: str) -> None:
    """A block of 2 % of two axes, somewhere else in each of 150 batches (trex 4 row 40)."""
    firsts: dict[str, list[int]] = {name: [], "random": []}
    for number in range(150):
        corner = np.random.default_rng([number, 3]).random(2) * (1.0 - 0.02**0.5)
        dice = np.random.default_rng([number, 4])
        for kind, found in firsts.items():
            points = chosen(kind, 400, AXES[:2], seed=number)
            rows = [np.array([s for _, s in point.shares]) if point.shares else dice.random(2) for point in points]
            hits = (i for i, row in enumerate(rows, 1) if ((row >= corner) & (row <= corner + 0.02**0.5)).all())
            found.append(next(hits, 400))
    assert np.mean(firsts[name]) <= np.mean(firsts["random"])


@pytest.mark.parametrize("world", ["rare edge", "rare corner"])
def test_the_adaptive_sampler_finds_a_fault_of_two_in_a_thousand(world: str) -> None:
    found = 0
    for batch, sampler in batches("adaptive", WORLDS[world], 300, 60):
        found += any(failed for failed, _ in batch.flown)
        rate = judge_missions(batch.flown, 0.0, 0.95, most_weight=sampler.most_weight)
        assert rate.interval is not None
        assert rate.interval[0] <= 0.002 <= rate.interval[1]
    assert found >= 48


def test_the_adaptive_sampler_finds_a_ball_of_two_in_a_thousand_wherever_it_lies() -> None:
    """A ball of six parameters cannot lie near an edge; 300 plain random missions find it in 45 % of batches."""
    axes = tuple(ShareAxis(name, 0.0, 1.0 - 2.0**-53) for name in "ABCDEF")
    radius = (0.002 / (np.pi**3 / 6.0)) ** (1.0 / 6.0)
    found = []
    for seed in range(20):  # while nothing fails, a batch is the same wherever the ball lies
        rows = shares_of(chosen("adaptive", 300, axes, seed))
        rows = np.vstack([rows, np.random.default_rng([seed, 7]).random((300 - len(rows), 6))])
        centres = radius + (1.0 - 2.0 * radius) * np.random.default_rng([seed, 8]).random((20, 6))
        distances = ((rows[None] - centres[:, None]) ** 2).sum(axis=2)
        found += list((distances <= radius**2).any(axis=1))
    assert np.mean(found) > 0.7


def test_the_adaptive_sampler_finds_twice_the_failures_and_looks_elsewhere_too() -> None:
    """B2 fails beyond both of two limits: in four corners of 4 % each (trex 4 row 39)."""
    world = WORLDS["four corners"]
    failures, outside, missions, estimates = 0, 0, 0, []
    for batch, sampler in batches("adaptive", world, 200, 25):
        failures += sum(failed for failed, _ in batch.flown)
        outside += sum(not bool(world.fails(shares)) for shares in batch.shares)
        missions += len(batch.flown)
        estimates.append(judge_missions(batch.flown, 0.0, 0.95, most_weight=sampler.most_weight).observed)
    assert failures >= 2 * world.rate * missions
    assert outside >= 0.25 * missions
    assert np.mean(estimates) == pytest.approx(world.rate, abs=4 * float(np.std(estimates)) / 5)


def test_the_densities_that_explore_are_those_of_what_they_draw() -> None:
    """The mean of 1 / density over what was drawn in a part of the box is the volume of that part."""
    dice = np.random.default_rng(4)
    rows = EXPLORING.draw(dice, 40_000, 2)
    for lower, upper in ((0.002, 0.05), (0.93, 0.99), (0.05, 0.17), (0.35, 0.65), (0.0002, 0.9998)):
        in_part = ((rows > lower) & (rows < upper)).all(axis=1)
        weights = np.where(in_part, 1.0 / EXPLORING.density(rows), 0.0)
        assert weights.mean() == pytest.approx((upper - lower) ** 2, abs=5.0 * float(weights.std()) / 200.0)
    assert EXPLORING.share.sum() == pytest.approx(1.0)


def test_weights_are_the_inverse_of_a_density() -> None:
    """The mean of 1 over uniform shares, found by importance sampling: weights of any generation have mean 1."""
    means = []
    for seed in range(40):
        sampler = Adaptive(Setting(AXES[:2], seed, 100))
        trials: list[Trial] = []
        for _ in range(5):
            points = sampler.choose(trials, 20)
            trials += [Trial(point, point.shares[0][1] > 0.9) for point in points]
        means.append(np.mean([trial.point.weight for trial in trials]))
        assert max(trial.point.weight for trial in trials) <= sampler.most_weight
    assert np.mean(means) == pytest.approx(1.0, abs=4 * float(np.std(means)) / 40**0.5)


def test_distress_attracts_the_adaptive_sampler_before_anything_fails() -> None:
    sampler = Adaptive(Setting(AXES[:2], 3, 200))
    trials: list[Trial] = []
    while len(trials) < 160:
        for point in sampler.choose(trials, 20):
            trials.append(Trial(point, False, distress=-abs(point.shares[0][1] - 0.37)))
    late = [trial.point.shares[0][1] for trial in trials[100:]]
    assert np.mean([abs(share - 0.37) < 0.1 for share in late]) > 0.35


def test_the_guided_sampler_meets_more_behaviours_than_chance() -> None:
    """A behaviour per cell of a grid that gets finer towards one corner."""

    def behaviours(points: list[np.ndarray]) -> set[tuple[int, int]]:
        return {(int(-np.log2(row[0] + 1e-9)), int(-np.log2(row[1] + 1e-9))) for row in points}

    guided, random = 0, 0
    for seed in range(10):
        sampler = find_sampler("guided")[1](Setting(AXES[:2], seed, 200))
        dice = np.random.default_rng(seed)
        trials: list[Trial] = []
        rows: list[np.ndarray] = []
        while len(trials) < 200:
            for point in sampler.choose(trials, 200 - len(trials)):
                row = np.array([share for _, share in point.shares]) if point.shares else dice.random(2)
                (cell,) = behaviours([row])
                trials.append(Trial(point, False, behaviour=frozenset({cell[0] * 100 + cell[1]})))
                rows.append(row)
        guided += len(behaviours(rows))
        random += len(behaviours(list(dice.random((200, 2)))))
    assert guided > 1.2 * random


# ---- what is said of it ----


@pytest.mark.parametrize("name", [name for name in SAMPLERS if name not in DESIGNS])
@pytest.mark.parametrize("world", ["four corners", "rare edge", "scattered"])
def test_intervals_cover_whatever_ends_a_batch(name: str, world: str) -> None:
    found = coverages(name, WORLDS[world], 80, 60 if name == "adaptive" else 2000)
    assert list(found) == list(End)
    assert [end for end, one in found.items() if not one.is_nominal()] == []


@pytest.mark.parametrize("name", DESIGNS)
def test_designs_refuse_an_interval(name: str) -> None:
    assert coverages(name, WORLDS["edge"], 50, 1) == {}


def test_the_exact_interval_is_that_of_scipy() -> None:
    for failures, missions in ((0, 7), (1, 50), (33, 200), (200, 200)):
        other = stats.binomtest(failures, missions).proportion_ci(0.95, "exact")
        assert exact_interval(failures, missions, 0.95) == pytest.approx((other.low, other.high), abs=1e-8)


def test_mcnemar_is_the_binomial_test_of_scipy() -> None:
    for one, other in ((0, 0), (0, 1), (3, 11), (11, 3), (20, 20), (0, 30)):
        wanted = stats.binomtest(one, one + other).pvalue if one + other else 1.0
        assert mcnemar(one, other) == pytest.approx(wanted, abs=1e-8)
    assert mcnemar(0, 55) == LEAST_CHANCE > 0.0


@pytest.mark.parametrize("rate", [0.002, 0.05, 0.4])
def test_the_confidence_sequence_covers_at_all_times_at_once(rate: float) -> None:
    dice = np.random.default_rng(11)
    missed = 0
    for _ in range(400):
        failures = np.cumsum(dice.random(300) < rate)
        for missions in (1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144, 233, 300):
            lower, upper = confidence_sequence(int(failures[missions - 1]), missions, 0.9)
            if not lower <= rate <= upper:
                missed += 1
                break
    assert missed <= 400 * 0.1


def test_the_confidence_sequence_narrows_and_holds_what_was_seen() -> None:
    widths = []
    for missions in (10, 100, 1000, 10_000):
        lower, upper = confidence_sequence(missions // 10, missions, 0.95)
        assert lower < 0.1 < upper
        widths.append(upper - lower)
    assert widths == sorted(widths, reverse=True)
    assert confidence_sequence(0, 0, 0.95) == (0.0, 1.0)
    assert confidence_sequence(5, 5, 0.95)[1] == 1.0


def test_bets_on_equal_weights_are_not_much_wider_than_the_exact_interval() -> None:
    values = [1.0] * 20 + [0.0] * 180
    lower, upper = betting_interval(values, 1.0, 0.95)
    exact = exact_interval(20, 200, 0.95)
    assert lower < exact[0] < 0.1 < exact[1] < upper
    assert upper - lower < 2.0 * (exact[1] - exact[0])
    assert betting_interval([], 2.0, 0.95) == (0.0, 1.0)
    assert betting_interval([0.0] * 50, 2.0, 0.95)[0] == 0.0


def test_designed_missions_are_in_no_rate_and_still_fail_the_check() -> None:
    flown = [(True, SamplePoint((("A", 0.99),), MissionRole.DESIGNED)), *[(False, SamplePoint())] * 30]
    rate = judge_missions(flown, 0.0, 0.95)
    assert (rate.observed, rate.counted, rate.failures, rate.method) == (0.0, 30, 1, Method.EXACT)
    assert rate.exceeds
    assert rate.is_certain
    undecided = judge_missions(flown, 0.05, 0.95)  # 0 of 30 leave up to 11.6 %
    assert (undecided.exceeds, undecided.is_certain) == (True, False)
    shown = judge_missions(flown, 0.12, 0.95)
    assert (shown.exceeds, shown.is_certain) == (False, True)
    passing = [(False, point) for _, point in flown]
    assert not judge_missions(passing, 0.05, 0.95).exceeds


def test_of_no_missions_no_rate_is_told() -> None:
    assert rate_line(judge_missions([], 0.01, 0.95, is_sequential=True)) == "failure rate: not known"
    in_flight = judge_missions([(False, SamplePoint())] * 3, 0.01, 0.95, is_sequential=True, gapless=0)
    assert rate_line(in_flight) == "failure rate: not known"


@pytest.mark.parametrize(
    ("text", "rate", "confidence"), [("p<0.01@95%", 0.01, 0.95), (" P > 2 % @ 99.5 % ", 0.02, 0.995)]
)
def test_rules_to_stop_by_are_read(text: str, rate: float, confidence: float) -> None:
    rule = parse_rule(text)
    assert rule is not None
    assert (rule.rate, rule.confidence) == pytest.approx((rate, confidence))


@pytest.mark.parametrize("text", ["", "p=1@95%", "p<2@95%", "p<0.1", "p<0.1@195%", "q<0.1@95%", "p<.@95%"])
def test_what_is_no_rule_is_refused(text: str) -> None:
    assert parse_rule(text) is None


def test_a_rule_is_shown_refuted_or_open() -> None:
    rule = parse_rule("p<0.1@95%")
    assert rule is not None
    passing, failing = (False, SamplePoint()), (True, SamplePoint())
    assert rule.outcome([passing] * 10, 1.0) is None
    assert rule.outcome([passing] * 200, 1.0) is True
    assert rule.outcome([failing] * 10, 1.0) is False
    designed = SamplePoint(role=MissionRole.DESIGNED)
    assert rule.outcome([(True, designed)] * 100, 1.0) is None


def test_of_many_parameters_none_is_named_by_chance() -> None:
    """Failures that depend on nothing: in one batch of twenty at most is any of thirty parameters told from chance."""
    agent = AgentConfiguration(
        "a", "", 10, (), parameters=tuple(ParameterConfiguration(f"P{number}", 0.0, 1.0) for number in range(30))
    )
    named = 0
    for batch in range(60):
        failures = [failed(mission_seed(batch, number)) for number in range(1, 21)]
        assert sensitivities(agent, failures, 0.95) == ()  # where none passes there is nothing that decides it
        found = sensitivities(agent, [*failures, passed(mission_seed(batch, 0))], 0.95)
        assert len(found) == 30
        named += any(one.interval[0] > 0.0 for one in found)
    assert named <= 60 * 0.05 + 4.0 * (60 * 0.05 * 0.95) ** 0.5


def passed(seed: int) -> MissionResult:
    return MissionResult(21, seed, Judgement(Verdict.PASS, ""), None, False)


def failed(seed: int) -> MissionResult:
    return MissionResult(1, seed, Judgement(Verdict.FAIL, "F1"), None, False)


def test_missions_in_flight_when_a_signal_comes_do_not_bend_the_rate() -> None:
    """A hundred lanes, where missions that fail take a tenth of the time of others, are ended after a few missions."""
    dice, covered = np.random.default_rng(9), 0
    for _ in range(100):
        failing = dice.random(2000) < 0.1
        ends, lanes = np.empty(2000), np.zeros(100)
        for number, fails in enumerate(failing):
            lane = int(lanes.argmin())
            lanes[lane] += 0.1 if fails else 1.0
            ends[number] = lanes[lane]
        finished = np.flatnonzero(ends <= dice.uniform(0.5, 3.0))
        gapless = int((finished == np.arange(len(finished))).sum())
        flown = [(bool(failing[number]), SamplePoint()) for number in finished]
        rate = judge_missions(flown, 0.0, 0.95, is_sequential=True, gapless=gapless)
        assert rate.interval is not None
        assert rate.missions == len(finished)
        covered += rate.interval[0] <= 0.1 <= rate.interval[1]
    assert covered >= 90


def test_a_distance_is_that_of_kolmogorov_and_its_interval_covers() -> None:
    """Failing when a share is above 0.7: the distance from chance is exactly 0.7."""
    dice = np.random.default_rng(5)
    covered = 0
    for _ in range(300):
        shares = list(0.7 + 0.3 * dice.random(12))
        found = sensitivity("A", shares, 0.95)
        assert found.distance == pytest.approx(stats.kstest(shares, "uniform").statistic, abs=1e-8)
        covered += found.interval[0] <= 0.7 <= found.interval[1]
    assert covered >= 300 * 0.95
