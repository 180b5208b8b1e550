"""Timelines that are parts of other objects are shared like those that global variables hold."""

from pathlib import Path

import pytest

from checker.declared_roles import declared_roles
from checker.mission import read_mission
from checker.models import load_models
from nddlc.main import run

ROVER = """#include "TREX.nddl"
class Arm extends AgentTimeline { predicate Idle { } predicate Move { duration == 2; }
  Arm(Mode m) { super(m, "Idle"); } }
class Rig { Arm arm; Rig(Mode m) { arm = new Arm(m); } }
class Robot extends Rig { Arm spare; Rig small;
  Robot(Mode m) { super(m); spare = new Arm(Private); small = new Rig(Observe); } }
class Loop { Loop again; Loop other; Loop() { again = new Loop(); other = new Loop(); } }
class Ghost { Arm arm; Ghost(Arm a) { arm = a; } }
Robot robot = new Robot(Internal);
Ghost ghost = new Ghost(robot.arm);
close();
rejectable(robot.arm.Move g);
"""
MISSION = """[mission]
name = "rover"
final_tick = 8
[[reactor]]
name = "r"
model = "rover.nddl"
latency = 0
lookahead = 5
{roles}
[[goal]]
timeline = "robot.arm"
predicate = "{predicate}"
start = 5
[[property]]
name = "moves"
kind = "reached"
timeline = "robot.arm"
predicate = "Move"
"""


@pytest.fixture
def model(tmp_path: Path) -> Path:
    file = tmp_path / "rover.nddl"
    file.write_text(ROVER)
    return file


def mission(model: Path, roles: str, predicate: str = "Move") -> Path:
    file = model.parent / "mission.toml"
    file.write_text(MISSION.format(roles=roles, predicate=predicate))
    return file


def test_a_model_declares_the_roles_of_what_its_constructors_make(model: Path) -> None:
    roles = declared_roles(model)
    assert roles == {"internal": ("robot.arm",), "external": ("robot.small.arm",), "observe": ("robot.small.arm",)}


def test_a_class_that_makes_its_own_kind_ends_the_search(model: Path) -> None:
    model.write_text(f"{ROVER}Loop loop = new Loop();")
    assert declared_roles(model)["internal"] == ("robot.arm",)


@pytest.mark.parametrize("roles", ["", 'internal = ["robot.arm", "robot.small.arm"]'])
def test_it_is_owned_and_takes_goals(model: Path, roles: str, capsys: pytest.CaptureFixture[str]) -> None:
    model.write_text(ROVER.replace("Observe", "Internal"))
    assert run(["run", str(mission(model, roles))]) == 0
    shown = capsys.readouterr().out
    assert "robot.arm" in shown
    assert "goals achieved 2" in shown  # of the mission file and of the model


def test_what_is_left_out_is_told(model: Path) -> None:
    model.write_text(ROVER.replace("Observe", "Internal"))
    found, problems = read_mission(mission(model, 'internal = ["robot.arm"]'))
    assert found is not None, problems
    told = [(one.code.id, one.message) for one in load_models(found).diagnostics]
    assert told == [("NDDL722", "`robot.small.arm` is `Internal` in the model `rover.nddl`, and not listed here")]


def test_a_goal_for_it_is_held_against_its_class(model: Path) -> None:
    found, problems = read_mission(mission(model, 'internal = ["robot.arm"]', predicate="Mvoe"))
    assert found is not None, problems
    told = [(one.code.id, one.message) for one in load_models(found).diagnostics]
    assert ("NDDL717", "`Arm` has no predicate `Mvoe`") in told
