"""What came, and might have stayed away, ended a mission: the draw that decided so is told, and its line is near."""

from pathlib import Path

import pytest

from checker.buckets import group_failures
from checker.counterfactual.candidates import candidates_of
from checker.counterfactual.dependence import Dependence
from checker.counterfactual.search import sites_in
from checker.findings import Fault
from checker.influence import parameters_that_choose
from checker.steps import StepKind
from runtime.executive.outcome import Draw
from tests.checker.fault_study import faults_in, laid_out
from tests.checker.told_steps import failed_mission

pytestmark = pytest.mark.once

TREK = Path(__file__).parent / "unseen" / "trek"
GRIP_FAILS, MISSION = 5, 6  # the fault by its index, and a mission in which each of four grips fails


def test_the_draw_that_decides_whether_a_grip_fails_is_told_and_its_limit_is_a_candidate(tmp_path: Path) -> None:
    place = laid_out(TREK, list(faults_in(TREK))[GRIP_FAILS], tmp_path / "trek")
    given, failed = failed_mission(place, MISSION)
    outcome = failed.outcome
    assert outcome is not None and failed.judgement.code == "F2"
    (bucket,) = group_failures((failed,))
    steps = given.story(failed, Fault(bucket, None, None)).steps
    drawn = [step.subject[0] for step in steps if step.kind is StepKind.DRAW and isinstance(step.subject, tuple)]
    assert [one.parameter for one in drawn if isinstance(one, Draw)] == ["LUCK"]
    lines = [step.place.text for step in steps if step.kind is StepKind.LINE and step.place is not None]
    assert lines == ["fails == (luck < GRIP_FAILS);"]
    agent = given.models.agent
    programs = [given.models.programs[one.model] for one in agent.reactors]
    found = candidates_of(outcome, Dependence(programs, sites_in(agent)), Path(agent.root))
    texts = [one.site.text for one in found]
    assert texts.index("fails == (luck < GRIP_FAILS);") < 6
    assert {name for one in programs for name in parameters_that_choose(one, {"Arm.Missed"})} == {"LUCK"}
    assert not [name for one in programs for name in parameters_that_choose(one, {"Arm.Grip", "Sun.Night"})]
