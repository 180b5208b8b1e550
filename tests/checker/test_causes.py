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
    assert "ruled out by planner.nddl:14:5: duration <= RUN_MAX" in told
    assert "ruled out by planner.nddl:10:5: RUN_MAX = 12" in told
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
    assert "ruled out" not in capsys.readouterr().out
