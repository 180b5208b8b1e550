"""What the planner found no place for is explained by the lines that rule it out, which also name the bucket."""

import re
from pathlib import Path

import pytest

from nddlc.main import run

MODEL = """#include "TREX.nddl"
class Survey extends AgentTimeline {
    predicate Idle { } predicate Transect { } predicate Turn { }
    Survey(Mode m) { super(m, "Idle"); }
}
class Motor extends AgentTimeline {
    predicate Off { } predicate Run { }
    Motor(Mode m) { super(m, "Off"); }
}
int RUN_MAX = 12;
int LEG_MIN = 20;
Survey::Transect { duration >= LEG_MIN; contained_by(Motor.Run run); }
Motor::Run {
    duration <= RUN_MAX;
}
Survey survey = new Survey(Internal);
Motor motor = new Motor(Internal);
close();
"""
MISSION = """
[mission]
name = "leg"
final_tick = 90
[[reactor]]
name = "planner"
model = "planner.nddl"
internal = ["survey", "motor"]
lookahead = 60
"""
GOAL = """
[[goal]]
timeline = "survey"
predicate = "Transect"
mandatory = true
start = [{0}, {0}]
"""
FACT = "goal(Survey.Transect leg); leg.start >= 5; leg.start <= 8;\nclose();"


@pytest.mark.parametrize("code", ["F4", "F10"])
def test_the_wrong_constant_is_named(
    code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    model, goals = MODEL, "".join(map(GOAL.format, (5, 40)))
    if code == "F4":
        model, goals = MODEL.replace("close();", FACT), ""
    (tmp_path / "planner.nddl").write_text(model)
    (tmp_path / "mission.toml").write_text(MISSION + goals)
    place = str(tmp_path / "mission.toml")
    assert run(["run", place]) == 1
    told = capsys.readouterr().out
    assert f"FAIL {code}" in told
    assert "    planner.nddl:14:5: duration <= RUN_MAX" in told
    assert "    planner.nddl:10:5: RUN_MAX = 12" in told
    assert run(["check", place, "--missions", "4"]) == 1
    told = capsys.readouterr().out
    found = re.findall(r"nddlc explain (\w+#\d+)", told)
    assert len(found) == 1, "one fault is one bucket"
    assert run(["explain", found[0]]) == 0
    story = capsys.readouterr().out
    blamed = story[story.index("<== where it breaks") :]
    assert "planner.nddl:14" in blamed and "planner.nddl:10" in blamed
    assert "planner.nddl:10" in story[: story.index("what happened:")], "the constant is among the causes"
    assert story[story.index("what happened:") :].count("RUN_MAX = 12") == 1
    assert "tried in vain: activate it" in story
    # The model with the right constant passes.
    (tmp_path / "planner.nddl").write_text(model.replace("RUN_MAX = 12", "RUN_MAX = 30"))
    assert run(["run", place]) == 0
    assert "rule out" not in capsys.readouterr().out


REFUSING = {
    "arm.nddl": """#include "TREX.nddl"
class Arm extends AgentTimeline {
    predicate Still { }
    predicate Reach { int angle; int speed; }
    Arm(Mode m) { super(m, "Still"); }
}
""",
    "world.nddl": """#include "arm.nddl"
Arm::Reach { duration >= 3; duration <= angle; }
Arm arm = new Arm(Internal);
close();
""",
    "planner.nddl": """#include "arm.nddl"
class Task extends AgentTimeline {
    predicate Idle { }
    predicate Do { }
    Task(Mode m) { super(m, "Idle"); }
}
Task::Do { contains(Arm.Reach reach); reach.angle == 2; duration <= 30; }
Task task = new Task(Internal);
Arm arm = new Arm(External);
close();
""",
    "mission.toml": """
[mission]
name = "arm"
final_tick = 80
[[reactor]]
name = "planner"
model = "planner.nddl"
internal = ["task"]
external = ["arm"]
latency = 1
lookahead = 40
[[reactor]]
name = "world"
model = "world.nddl"
latency = 0
lookahead = 1
internal = ["arm"]
[[goal]]
timeline = "task"
predicate = "Do"
start = [5, 10]
""",
}


def test_a_missed_request_is_told_with_its_values_and_the_answer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for name, text in REFUSING.items():
        (tmp_path / name).write_text(text)
    assert run(["run"]) == 1
    told = capsys.readouterr().out
    assert "FAIL F6" in told
    assert "  world rejected Reach(angle=2) on arm at tick " in told, "what may be anything is left out"
    assert run(["check", "--flights", "0", "--missions", "2"]) == 1
    assert "   world rejected Reach(angle=2) on arm at tick " in capsys.readouterr().out
    assert run(["explain", "--flights", "0"]) == 0
    assert "  world rejected Reach(angle=2) on arm at tick " in capsys.readouterr().out


def test_repairs_of_one_sort_are_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "planner.nddl").write_text(MODEL)
    goals = "".join(map(GOAL.format, (5, 40)))
    (tmp_path / "mission.toml").write_text(MISSION + goals)
    assert run(["run"]) == 1
    told = [line for line in capsys.readouterr().out.splitlines() if " reject " in line]
    assert len(told) == 1
    assert "(and 1 more of this sort" in told[0]
