"""The plain oracle objects to no right mission, and to what is broken by hand."""

from random import Random

import pytest

from tests.checker.judge.corruption import argument, rumour, shift, silence, stretch
from tests.checker.judge.missions import MISSIONS
from tests.checker.judge.plain_mission import objections
from tests.executive.flying import Flown


def executed(mission: Flown) -> list[object]:
    """What anybody could see: tokens that stand for themselves, and what was published."""
    tokens = [one for each in mission.record.reactors for one in each.tokens if one.state == "active"]
    return [*tokens, *mission.outcome.events]


def said(mission: Flown) -> list[str]:
    return objections(mission.agent, mission.programs, mission.outcome, mission.record)


@pytest.mark.parametrize("name", MISSIONS)
def test_a_right_mission_is_not_objected_to(name: str) -> None:
    for seed in range(4):
        assert said(MISSIONS[name](seed)) == []


@pytest.mark.parametrize("name", MISSIONS)
@pytest.mark.parametrize("alter", [shift, stretch, argument, silence, rumour], ids=lambda one: one.__name__)
def test_what_was_executed_otherwise_than_the_model_says_is_objected_to(name: str, alter) -> None:  # type: ignore[no-untyped-def]
    tried, passed = 0, []
    for seed in range(2):
        mission = MISSIONS[name](seed)
        for number in range(8):
            altered = alter(mission, Random(f"{name} {seed} {number}"))
            if altered is None or executed(altered) == executed(mission):
                continue
            tried += 1
            if not said(altered):
                passed.append((seed, number))
    assert tried and not passed
