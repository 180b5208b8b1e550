"""Failures are grouped by the line to blame, and tied to the parameter values that bring them about."""

from pathlib import Path

import pytest

from checker.batch.result import MissionResult
from checker.batch.worker import Load, Task, fly_one
from checker.buckets import group_failures
from checker.causes import culprit_of, draws_behind, events_to_abort
from checker.mission import read_mission
from checker.sampling.seeds import mission_seed
from checker.threshold import find_cut, find_thresholds
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.rendering import event_text
from tests.checker.fake_agent import CONSTANT, LIMIT, linked_conflict, load_linked, load_split, split_conflict


def agent() -> AgentConfiguration:
    mission, _ = read_mission(Path("models/gps/mission.toml"))
    assert mission is not None
    return mission.agent


def fly(load: Load) -> tuple[MissionResult, ...]:
    flight = load(agent())
    return tuple(fly_one(flight, Task(number, mission_seed(7234, number))) for number in range(1, 201))


def test_the_line_to_blame_is_the_limit_not_the_draw() -> None:
    for conflict in (linked_conflict(3.95), split_conflict(3.95)):
        found = culprit_of(conflict)
        assert found.place == LIMIT
        assert found.limits == (CONSTANT,)
    assert culprit_of(None).place is None


def test_failures_at_one_line_are_one_bucket() -> None:
    results = fly(load_linked)
    (bucket,) = group_failures(results)
    assert bucket.code == "F1"
    assert bucket.culprit.place == LIMIT
    assert 2 <= len(bucket.missions) <= 20
    assert bucket.share == len(bucket.missions) / 200
    assert bucket.first_tick == bucket.last_tick == 265


@pytest.mark.parametrize(("load", "method"), [(load_linked, "z3 and flights"), (load_split, "flights")])
def test_the_threshold_is_found_by_flying_again(load: Load, method: str) -> None:
    results = fly(load)
    (bucket,) = group_failures(results)
    thresholds = find_thresholds(
        bucket, results, agent(), lambda agent, number, seed: fly_one(load(agent), Task(number, seed))
    )
    assert [one.condition for one in thresholds] == ["GPS_HIT_RATE > 3.8"]
    assert thresholds[0].method == method
    assert thresholds[0].is_causal
    assert thresholds[0].cut is not None
    assert thresholds[0].cut.passing <= 3.8 < thresholds[0].cut.failing
    assert thresholds[0].cut.purity == thresholds[0].cut.coverage == 1.0


def test_without_flights_terms_or_samples_must_do() -> None:
    for load, method in ((load_linked, "z3"), (load_split, "samples")):
        results = fly(load)
        (bucket,) = group_failures(results)
        (threshold,) = find_thresholds(bucket, results, agent(), None)
        assert threshold.parameter == "GPS_HIT_RATE"
        assert threshold.method == method
        assert threshold.edge == pytest.approx(3.8, abs=0.05)


def test_a_cut_is_the_best_there_is() -> None:
    cut = find_cut([3.9, 3.95, 1.0], [0.5, 2.0, 3.0, 3.8])
    assert cut is not None
    assert (cut.is_above, cut.passing, cut.failing) == (True, 3.8, 3.9)
    assert cut.coverage == pytest.approx(2 / 3)
    assert cut.purity == 1.0
    assert cut.luck == 1.0
    below = find_cut([-2.0, -1.9], [0.0, 1.0])
    assert below is not None
    assert (below.is_above, below.passing, below.failing) == (False, 0.0, -1.9)
    assert find_cut([], [1.0]) is None
    assert find_cut([1.0], [1.0]) is None


def test_the_events_lead_from_the_draw_to_the_abort() -> None:
    result = next(one for one in fly(load_split) if one.has_trace)
    assert result.outcome is not None
    events = [event_text(result.outcome.events[index]) for index in events_to_abort(result.outcome, ("GPS_HIT_RATE",))]
    assert events[0].startswith("GPS_HIT_RATE = 3.")
    assert events[1:] == ["Active(minHits=10.0)"]
    assert draws_behind(result.outcome) == ("GPS_HIT_RATE",)
