"""A mission that fails after repairs: the story tells where the plan broke first, and under which condition."""

from pathlib import Path

import pytest

from checker.batch.result import MissionResult
from checker.batch.worker import fly_one
from checker.broken_plans import broken_plan, usual_breaking
from checker.campaign import Campaign
from checker.excerpts import Excerpts
from checker.mission import read_mission
from checker.models import load_models
from checker.oracle import Judgement, Verdict
from checker.pinned import pinned
from checker.report.html import html_report
from checker.steps import Step, StepKind
from runtime.executive.outcome import (
    Conflict,
    Event,
    EventKind,
    OpenGoal,
    Outcome,
    Phase,
    PropertyFate,
    Reason,
    ReasonKind,
    RepairStage,
)

pytestmark = pytest.mark.once

SHARED = """#include "TREX.nddl"
class Arm extends AgentTimeline {
    predicate Idle { }
    predicate Grip { bool soft; }
    Arm(Mode m) { super(m, "Idle"); }
}
class Wheel extends AgentTimeline {
    predicate Turns { }
    predicate Stuck { }
    Wheel(Mode m) { super(m, "Turns"); }
}
"""
WORLD = """#include "shared.nddl"
int TURNS = 60;
int LONGEST = 20;
Arm::Grip { if (soft == true) { duration == 4; } else { duration == 12; } meets(object.Idle idle); }
Wheel::Turns { duration == TURNS; meets(object.Stuck stuck); }
Wheel::Stuck { duration <= LONGEST; duration >= 30; }
Arm arm = new Arm(Internal);
Wheel wheel = new Wheel(Internal);
close();
"""
PLANNER = """#include "shared.nddl"
int SHORT = 5;
int LONG = 8;
class Work extends AgentTimeline {
    predicate Rest { }
    predicate Task { bool soft; }
    Work(Mode m) { super(m, "Rest"); }
}
Work::Task {
    contains(Arm.Grip grip);
    grip.soft == soft;
    if (soft == true) {
        grip.duration <= SHORT;
    } else {
        grip.duration <= LONG;
    }
    meets(object.Rest rest);
}
Work work = new Work(Internal);
Arm arm = new Arm(External);
close();
"""
MISSION = """
[mission]
name = "work"
final_tick = {end}
[[reactor]]
name = "planner"
model = "planner.nddl"
latency = 1
lookahead = 50
internal = ["work"]
external = ["arm"]
[[reactor]]
name = "world"
model = "world.nddl"
latency = 0
lookahead = 1
internal = ["arm", "wheel"]
[[goal]]
timeline = "work"
predicate = "Task"
start = [2, 10]
parameters = {{ soft = {soft} }}
[check]
missions = 1
{limit}
"""


def mission(folder: Path, soft: str, end: int, limit: str = "") -> tuple[Campaign, MissionResult]:
    """A mission whose hard grips take longer than planned; its wheel fails at tick 60."""
    for name, text in (("shared", SHARED), ("world", WORLD), ("planner", PLANNER)):
        (folder / f"{name}.nddl").write_text(text)
    (folder / "mission.toml").write_text(MISSION.format(soft=soft, end=end, limit=limit))
    read, found = read_mission(folder / "mission.toml")
    assert read is not None, found
    models = load_models(read)
    assert not models.has_errors, models.diagnostics
    given = Campaign(read, models, pinned(models))
    task = given.task(1)
    return given, given.judged(fly_one(given.load(task.agent or models.agent), task, keep_trace=True))


def texts(steps: tuple[Step, ...], kind: StepKind) -> list[str]:
    return [one.place.text for one in steps if one.kind is kind and one.place is not None]


def test_too_many_repairs_are_told_as_what_broke(tmp_path: Path) -> None:
    given, failed = mission(tmp_path, "false", 50, "max_repairs = 0")
    assert failed.judgement.code == "L3"
    story = given.story(failed, None)
    assert texts(story.steps, StepKind.FAULT) == ["grip.duration <= LONG"]
    blamed = next(one for one in story.steps if one.kind is StepKind.FAULT)
    assert [(one.place.text, one.is_else) for one in blamed.under] == [("if (soft == true) {", True)]
    assert [one.text for one in blamed.limits] == ["LONG = 8"]
    assert story.confirmation is not None and story.confirmation.is_minimal
    page = html_report(given.assess((failed,), may_fly=False), Excerpts(tmp_path), [story])
    assert "which stands in the <code>else</code> of:" in page


def test_what_broke_before_the_end_is_told_first(tmp_path: Path) -> None:
    given, failed = mission(tmp_path, "false", 100)
    assert failed.verdict is Verdict.FAIL and failed.outcome is not None and failed.outcome.last_tick == 60
    steps = given.story(failed, None).steps
    assert texts(steps, StepKind.BROKEN) == ["grip.duration <= LONG"]
    kinds = [one.kind for one in steps]
    assert kinds.index(StepKind.BROKEN) < kinds.index(StepKind.FAULT)


def test_what_breaks_in_missions_that_pass_is_not_told(tmp_path: Path) -> None:
    _, passed = mission(tmp_path, "false", 50)
    assert passed.verdict is Verdict.PASS and usual_breaking([passed])
    given, failed = mission(tmp_path, "false", 100)
    assert not texts(given.story(failed, None, (passed,)).steps, StepKind.BROKEN)


def test_a_plan_that_did_not_break_is_not_told(tmp_path: Path) -> None:
    given, failed = mission(tmp_path, "true", 100)
    assert failed.verdict is Verdict.FAIL
    steps = given.story(failed, None).steps
    assert not texts(steps, StepKind.BROKEN) and texts(steps, StepKind.FAULT)


@pytest.mark.parametrize(("violated", "given_up", "is_told"), [(None, 2, True), (None, 0, False), (40, 2, False)])
def test_a_plan_that_broke_after_all_was_decided_has_no_part_in_it(
    violated: int | None, given_up: int, is_told: bool
) -> None:
    reason = Reason(ReasonKind.REJECTED)
    events = (
        Event(3, Phase.DELIBERATE, EventKind.REJECT, "planner"),
        Event(50, Phase.REPAIR, EventKind.RELAX, "planner", stage=RepairStage.KEEP_PAST, conflict=Conflict(())),
        Event(70, Phase.DELIBERATE, EventKind.REJECT, "planner"),
    )
    goal = OpenGoal("work", "Task", (), reason, given_up)
    broken = None if violated is None else PropertyFate("p", False, violated, -1.0)
    outcome = Outcome(1, 90, 90, None, (), events, (goal,))
    failed = MissionResult(1, 1, Judgement(Verdict.FAIL, "F10", broken=broken), outcome, True)
    assert (broken_plan(failed) is not None) is is_told
