"""What a member of an object is that is still open, and what a goal of the mission file asks, are told with places."""

from pathlib import Path

import pytest

from checker.flight import fly_programs
from checker.mission import read_mission
from checker.models import load_models
from checker.proofs.conflict import Finding, confirm
from checker.proofs.places import ModelText, text_of
from runtime.executive.outcome import Conflict, ElementKind
from runtime.executive.rendering import element_text
from tests.checker.checked import faults_of
from tests.programs import programs_of

SHARED = """#include "TREX.nddl"
enum Site { depot, clinic, island }
class Rotor extends AgentTimeline {
    predicate Parked { }
    predicate Flying { Site to; }
    Rotor(Mode m) { super(m, "Parked"); }
}
"""
COURIER = """#include "shared.nddl"
class Courier extends AgentTimeline {
    predicate Idle { }
    predicate Deliver { Site to; }
    Courier(Mode m) { super(m, "Idle"); }
}
Courier::Deliver {
    equals(Rotor.Flying go);
    go.to == to;
}
Courier courier = new Courier(Internal);
Rotor rotor = new Rotor(External);
close();
"""
WORLD = """#include "shared.nddl"
class Route {
    Site to;
    int ticks;
    Route(Site t, int n) { to = t; ticks = n; }
}
Rotor::Flying {
    Route r;
    r.to == to;
    duration == r.ticks;
}
Route near = new Route(clinic, 60);
Route far = new Route(island, 140);
Rotor rotor = new Rotor(Internal);
close();
"""
MISSION = """[mission]
name = "courier"
final_tick = 400
[[reactor]]
name = "courier"
model = "courier.nddl"
latency = 1
lookahead = 400
internal = ["courier"]
external = ["rotor"]
[[reactor]]
name = "world"
model = "world.nddl"
latency = 0
lookahead = 1
internal = ["rotor"]
[[goal]]
timeline = "courier"
predicate = "Deliver"
mandatory = true
start = [5, 100]
[goal.parameters]
to = "clinic"
[[goal]]
timeline = "courier"
predicate = "Deliver"
[goal.parameters]
to = "island"
"""


@pytest.fixture
def conflict(tmp_path: Path) -> tuple[Conflict, ModelText]:
    """The first delivery takes longer than the second one can wait; the courier does not know how long it takes."""
    for name, text in (("shared", SHARED), ("courier", COURIER), ("world", WORLD)):
        (tmp_path / f"{name}.nddl").write_text(text, encoding="utf-8")
    (tmp_path / "mission.toml").write_text(MISSION, encoding="utf-8")
    mission, _ = read_mission(tmp_path / "mission.toml")
    assert mission is not None
    models = load_models(mission)
    agent = models.agent
    programs = programs_of(agent)
    (goal,) = fly_programs(agent, programs, 1).open_goals
    assert goal.conflict is not None
    return goal.conflict, text_of(agent, models.programs)


def test_a_member_of_an_open_object_has_its_name(conflict: tuple[Conflict, ModelText]) -> None:
    texts = [element_text(element) for element in conflict[0].elements]
    assert any(text.endswith("::r.to is that of near or far") for text in texts)
    assert any("::r.ticks is that of near or far" in text for text in texts)


def test_z3_is_told_of_what_it_stands_for(conflict: tuple[Conflict, ModelText]) -> None:
    found = confirm(*conflict)
    assert found.finding is Finding.CONFIRMED
    assert not found.untranslated


def test_what_a_goal_asks_stands_in_the_mission_file(conflict: tuple[Conflict, ModelText]) -> None:
    asked = [one.place for one in conflict[0].elements if one.kind is ElementKind.REQUEST and one.place is not None]
    assert [(place.file, place.text) for place in asked] == [("mission.toml", "start = [5, 100]")]
    (place,) = asked
    assert MISSION.splitlines()[place.line - 1] == "start = [5, 100]"


def test_a_deadline_that_the_conflict_speaks_of_is_tried_beside_lines_that_mend(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    models = {"shared.nddl": SHARED, "courier.nddl": COURIER, "world.nddl": WORLD}
    (fault,) = faults_of(tmp_path, capsys, models | {"mission.toml": f"{MISSION}[check]\nmissions = 1\n"})
    ranked = fault["causes"]["ranked"]
    assert any(one["claim"] == "mends" and one["file"] == "world.nddl" for one in ranked)
    assert ("start = [5, 100]", "mends") in [(one["text"], one["claim"]) for one in ranked]
