"""A judge that agrees with a right mission disagrees as soon as its record or its trace is altered."""

from collections.abc import Callable
from random import Random

import pytest

from tests.checker.judge.corruption import ALTERATIONS, again
from tests.checker.judge.missions import MISSIONS
from tests.executive.flying import Flown

OFTEN = 6


@pytest.mark.parametrize("alter", ALTERATIONS, ids=lambda one: one.__name__)
@pytest.mark.parametrize("name", MISSIONS)
def test_an_altered_record_is_noticed(name: str, alter: Callable[[Flown, Random], Flown | None]) -> None:
    silent = []
    for seed in (0, 1, 2):
        mission = MISSIONS[name](seed)
        assert mission.report.holds
        for number in range(OFTEN):
            altered = alter(mission, Random(f"{name} {seed} {alter.__name__} {number}"))
            if altered is None or (altered.record, altered.outcome) == (mission.record, mission.outcome):
                continue
            if again(altered).holds:
                silent.append((seed, number))
    assert not silent


@pytest.mark.parametrize("name", MISSIONS)
def test_a_right_mission_raises_no_alarm_and_little_is_left_open(name: str) -> None:
    for seed in range(12):
        report = MISSIONS[name](seed).report
        assert report.holds
        assert report.judged > 100 and report.open < report.judged / 10
