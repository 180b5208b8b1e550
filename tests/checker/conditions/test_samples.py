"""Conditions of the missions of a run alone: weights count, what a design chose does not, and gaps are told."""

from functools import partial

import numpy as np
import pytest

from checker.batch.result import MissionResult
from checker.buckets import group_failures
from checker.conditions.condition import Condition, Literal, Row, axis_feature
from checker.conditions.find import find_condition
from checker.conditions.flights import Ended
from checker.conditions.measure import weighted_on
from checker.conditions.record import read_condition, write_condition
from checker.conditions.rendering import condition_data, condition_evidence, condition_text
from checker.oracle import Judgement, Verdict
from checker.sampling.sampler import RANDOM_POINT, MissionRole, SamplePoint
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from runtime.executive.outcome import Draw, Outcome

RANGE, LIMIT = 10.0, 8.0  # of the parameter, and above which missions fail
NEAR = 0.1  # of missions are drawn from the whole range, the others from where it is above 6
MOST = 1.0 / NEAR
DESIGNED = SamplePoint(role=MissionRole.DESIGNED)
weighted = partial(SamplePoint, (), MissionRole.WEIGHTED)


def agent(*, is_whole: bool = False) -> AgentConfiguration:
    one = ParameterConfiguration("P", 0.0, 100.0 if is_whole else RANGE, is_whole=is_whole)
    return AgentConfiguration("pump", ".", 9, (), parameters=(one,))


def mission(number: int, value: float, *, fails: bool, point: SamplePoint = RANDOM_POINT) -> MissionResult:
    judgement = Judgement(Verdict.FAIL, "F1") if fails else Judgement(Verdict.PASS)
    outcome = Outcome(1, 9, 9, None, (Draw("P", 0, value, value),), (), ())
    return MissionResult(number, number, judgement, outcome, has_trace=True, point=point)


def whole(values: list[float]) -> list[MissionResult]:
    """Missions that fail from 64 on."""
    return [mission(number, one, fails=one >= 64.0) for number, one in enumerate(values, 1)]


def found_in(results: list[MissionResult], given: AgentConfiguration, most: float = 1.0) -> Condition | None:
    (bucket,) = group_failures(tuple(results))
    return find_condition(bucket, results, given, 1, None, most_weight=most)


def drawn(chance: np.random.Generator, count: int) -> list[tuple[float, float]]:
    """Values of missions of which most were chosen, each with its weight."""
    low, high = 6.0, RANGE
    wide = chance.random(count) < NEAR
    values = np.where(wide, RANGE * chance.random(count), low + (high - low) * chance.random(count))
    density = NEAR + (1.0 - NEAR) * (values > low) * RANGE / (high - low)
    return list(zip(values.tolist(), (1.0 / density).tolist(), strict=True))


def row(value: float) -> Row:
    return {"P": (value, value)}


@pytest.mark.parametrize(("claimed", "precision", "recall"), [(5.0, 0.4, 1.0), (9.0, 1.0, 0.5)])
def test_intervals_of_weighted_missions_cover(claimed: float, precision: float, recall: float) -> None:
    chance = np.random.default_rng(3)
    literal = Literal(axis_feature("P"), True, claimed)
    missed, errors = 0, []
    for _ in range(100):
        rows = [
            (row(value), Ended.FAILS if value > LIMIT else Ended.PASSES, weight) for value, weight in drawn(chance, 200)
        ]
        found = weighted_on(rows, [(literal,)], MOST)
        for share, truth in ((found.precision, precision), (found.recall, recall)):
            missed += not share.interval[0] <= truth <= share.interval[1]
        errors.append((found.precision.value - precision, found.recall.value - recall))
    assert missed <= 5
    assert np.abs(np.mean(errors, axis=0)).max() < 0.05  # without weights the precision is 0.5 in place of 0.4


def test_chosen_missions_count_with_their_weights() -> None:
    values = drawn(np.random.default_rng(5), 300)
    rows = enumerate(values, 1)
    results = [mission(number, one, fails=one > LIMIT, point=weighted(weight)) for number, (one, weight) in rows]
    found = found_in(results, agent(), MOST)
    assert found is not None
    assert found.fresh == 150  # the later half
    assert found.recall.interval[0] < 0.9 < found.recall.interval[1]  # counted alike, 0.95 and more would be shown


def test_missions_of_a_design_say_nothing_of_how_often() -> None:
    values = np.linspace(0.0, RANGE, 40).tolist()
    designed = [mission(number, one, fails=one > LIMIT, point=DESIGNED) for number, one in enumerate(values, 1)]
    assert found_in(designed, agent()) is None
    plain = [mission(number, one, fails=one > LIMIT) for number, one in enumerate(values, 41)]
    found = found_in([*designed, *plain], agent())
    assert found is not None and found.fresh == 20  # the half of those that were plainly drawn


def test_an_edge_of_whole_numbers_is_one_that_was_seen_and_what_lies_beside_it_is_told() -> None:
    found = found_in(whole([*range(20, 60, 2), *range(64, 100, 2)]), agent(is_whole=True))
    assert found is not None
    assert condition_text(found) == "P >= 64"
    assert condition_evidence(found).endswith("none was flown for it; of P nothing between 58 and 64 was seen")
    (unseen,) = (condition_data(found) or {})["unseen"]
    assert unseen == {"term": "P", "draw": "only", "below": 58.0, "above": 64.0}
    assert read_condition(write_condition(found)) == found


@pytest.mark.parametrize(("beside", "is_told"), [(63.0, False), (62.0, True)])
def test_an_edge_between_neighbours_is_known(beside: float, is_told: bool) -> None:
    seen = [*np.arange(20.0, 60.0, 2.0).tolist(), beside, beside, *np.arange(64.0, 100.0, 2.0).tolist()]
    found = found_in(whole(seen), agent(is_whole=True))
    assert found is not None
    assert bool(found.unseen) is is_told
