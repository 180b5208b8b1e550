"""Of the time before the mission nothing is known: what a token there would ask for in turn is left open."""

import json
from pathlib import Path

import pytest

from nddlc.main import run

SHARED = """#include "TREX.nddl"
class Wheels extends AgentTimeline {
    predicate Still { }
    predicate Leg { int metres; }
    Wheels(Mode m) { super(m, "Still"); }
}
"""
PLANNER = """#include "shared.nddl"
int HOP = 15;
class Hop extends AgentTimeline {
    predicate None { }
    predicate Step { int left; left >= 1; }
    Hop(Mode m) { super(m, "None"); }
}
Hop::Step {
    contains(Wheels.Leg leg);
    leg.end == end;
    if (left > HOP) {
        leg.metres == HOP;
        any(object.Step next);
        next.left == left - HOP;
    } else {
        leg.metres == left;
    }
}
Hop hop = new Hop(Internal);
Wheels wheels = new Wheels(External);
close();
"""
SIMULATOR = """#include "shared.nddl"
Wheels::Leg { duration == metres; }
Wheels wheels = new Wheels(Internal);
close();
"""
MISSION = """[mission]
name = "hop"
final_tick = 60
[[reactor]]
name = "planner"
model = "planner.nddl"
latency = 1
lookahead = 60
internal = ["hop"]
external = ["wheels"]
[[reactor]]
name = "simulator"
model = "simulator.nddl"
lookahead = 1
internal = ["wheels"]
[[goal]]
timeline = "hop"
predicate = "Step"
mandatory = true
start = [9, 12]
parameters = { left = 38 }
"""


def test_a_guard_before_the_mission_is_left_open(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, text in (("shared", SHARED), ("planner", PLANNER), ("simulator", SIMULATOR)):
        (tmp_path / f"{name}.nddl").write_text(text)
    mission = tmp_path / "mission.toml"
    mission.write_text(MISSION)
    assert run(["run", str(mission)]) == 0
    assert "goals achieved 1" in capsys.readouterr().out
    assert run(["validate", str(mission), "--record", str(tmp_path / "record.json")]) == 0
    capsys.readouterr()
    record = json.loads((tmp_path / "record.json").read_text())
    guards = {
        str(token["start"]): guard
        for token in record["reactors"][0]["tokens"]
        for one in token["runs"]
        for guard in one["guards"]
    }
    assert [guard["branch"] for guard in guards.values()] == ["then", "waiting"]
    for guard in list(guards.values())[::-1]:  # what there is given decides it, and it has not run
        guard.update(branch="waiting", is_decided=True, run=None)
        (tmp_path / "record.json").write_text(json.dumps(record))
        is_before = guard is not guards["9"]
        assert run(["validate", str(tmp_path / "record.json")]) == (0 if is_before else 1)
        assert ("`no branch` ran" in capsys.readouterr().out) is not is_before
