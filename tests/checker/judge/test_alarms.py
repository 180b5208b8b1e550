"""The judge raises no false alarms: missions in which it once did."""

import pytest

from checker.judge.judge import judge_mission
from checker.judge.rendering import disagreement_text
from runtime.executive.mission import record_mission
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
