"""Where reactors are killed, a failure is told as it is where they end the mission: at its tick, with its conflict."""

from pathlib import Path

import pytest

from nddlc.main import run

pytestmark = pytest.mark.once

CLASSES = """#include "TREX.nddl"
class Task extends AgentTimeline {
  predicate Idle { }
  predicate Do { }
  Task(Mode m) { super(m, "Idle"); }
}
class Arm extends AgentTimeline {
  predicate Rest { }
  predicate Act { }
  Arm(Mode m) { super(m, "Rest"); }
}
"""
PLANNER = f"""{CLASSES}
Task::Do {{ equals(Arm.Act a); }}
Arm::Act {{ duration <= 10; }}
Task task = new Task(Internal);
Arm arm = new Arm(External);
close();
"""
SIMULATOR = f"""{CLASSES}
Arm::Act {{ duration == 20; }}
Arm arm = new Arm(Internal);
close();
"""
CODE = """from runtime.user.reactor import Reactor


class Arm(Reactor):
    def tick(self, now):
        if now.tick == 4:
            raise ValueError("broken")
        now.publish("arm", "Rest")
        now.wake(4)
"""
MISSION = """[mission]
name = "killed"
final_tick = 40
on_failure = "kill_reactor"
[[reactor]]
name = "plan"
model = "plan.nddl"
latency = 1
lookahead = 60
internal = ["task"]
external = ["arm"]
[[reactor]]
name = "owner"
{}
latency = 0
lookahead = 1
internal = ["arm"]
[[goal]]
timeline = "task"
predicate = "Do"
start = [5, 5]
[check]
missions = 2
"""


def told(folder: Path, owner: str, capsys: pytest.CaptureFixture[str]) -> tuple[str, str]:
    """What `check` and `explain` tell of the mission."""
    texts = {"plan.nddl": PLANNER, "sim.nddl": SIMULATOR, "arm.py": CODE, "mission.toml": MISSION.format(owner)}
    for name, text in texts.items():
        (folder / name).write_text(text)
    assert run(["check", "mission.toml", "--workers", "1", "--no-conditions"]) == 1
    checked = capsys.readouterr().out
    assert run(["explain", "latest#1"]) == 0
    return checked, capsys.readouterr().out


def test_a_killed_planner_fails_at_its_tick_with_its_conflict(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    checked, story = told(tmp_path, 'model = "sim.nddl"', capsys)
    assert "2 missions (100 %), at tick 15" in checked
    assert "failed at tick 15 of 40" in story
    last = "tick 15: plan gives up after 2 repairs (F1: an expected observation did not come in time); the others go on"
    assert last in story
    assert "Arm.Act#1.duration == 20" in story  # why its owner let it last
    assert "tick 40" not in story


def test_where_python_failed_in_a_killed_reactor_its_line_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    checked, story = told(tmp_path, 'code = "arm.py:Arm"', capsys)
    assert "2 missions (100 %), at tick 4" in checked
    for text in (checked, story):
        assert "--> arm.py:7" in text
    assert "tick 4: owner gives up (F7: a reactor could not start a tick); the others go on" in story
