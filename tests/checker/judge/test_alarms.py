"""The judge raises no false alarms: missions in which it once did."""

import pytest

from checker.judge.judge import judge_mission
from checker.judge.rendering import disagreement_text
from runtime.executive.mission import record_mission
from tests.checker.judge.corruption import again
from tests.checker.judge.missions import walking
from tests.executive.determined_models import random_case

# 7: a guard at a real that is near its bound; 85 and 428: numbers beyond all bounds; 3372: a merged token that left the
# plan before a repair gave up the bound of its end.
ONCE_ALARMED = (7, 85, 428, 3372)


@pytest.mark.parametrize("compiles", [True, False])
@pytest.mark.parametrize("number", ONCE_ALARMED)
def test_a_right_mission_raises_no_alarm(number: int, compiles: bool) -> None:
    agent, programs = random_case(number).agent()
    outcome, record = record_mission(agent, programs, number, compiles=compiles)
    report = judge_mission(agent, programs.programs, outcome, record)
    assert [disagreement_text(one) for one in report.disagreements] == []
    assert report.judged > 100


@pytest.mark.parametrize(("later", "found"), [(5, set()), (0, {"overlap"})])
def test_of_tokens_that_repairs_put_in_each_others_place_the_last_counts(later: int, found: set[str]) -> None:
    mission = walking(1)
    reactor = mission.record.reactors[0]
    steps = [one for one in reactor.tokens if one.predicate == "Walk.Step" and one.fate == "over"]
    taken = steps[len(steps) // 2]
    assert isinstance(taken.end, int)
    first = taken._replace(fate="cut", tick=taken.end)
    second = first._replace(key=max(one.key for one in reactor.tokens) + 1, tick=taken.end + later)
    others = [one for one in reactor.tokens if one.key != taken.key]
    altered = reactor._replace(tokens=tuple(sorted([*others, first, second])))
    report = again(mission._replace(record=mission.record._replace(reactors=(altered,))))
    assert {one.kind for one in report.disagreements} == found
