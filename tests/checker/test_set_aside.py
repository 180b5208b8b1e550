"""A repair that forgets the past sets aside what rules say of it: reports and the judge of a trace say so."""

from pathlib import Path

import pytest

from nddlc.main import run

RIG = """#include "TREX.nddl"
class Drill extends AgentTimeline {
    predicate Stowed { } predicate Bore { } predicate Retract { }
    Drill(Mode m) { super(m, "Stowed"); }
}
class Oven extends AgentTimeline { predicate Empty { } predicate Bake { } Oven(Mode m) { super(m, "Empty"); } }
"""
WORLD = """#include "rig.nddl"
Drill::Bore { duration == 10; }
Drill::Retract { duration == 20; }
Oven::Bake { duration == 5; }
Drill drill = new Drill(Internal);
Oven oven = new Oven(Internal);
close();
"""
PLANNER = """#include "rig.nddl"
class Sol extends AgentTimeline { predicate Idle { } predicate Core { } Sol(Mode m) { super(m, "Idle"); } }
Sol::Core {
    contains(Drill.Bore bore);
    contains(Drill.Retract retract);
    bore before retract;
    contains(Oven.Bake bake);
    retract before bake;
    bake.start <= bore.end + 12;
    bake.end == end;
}
Sol sol = new Sol(Internal);
Drill drill = new Drill(External);
Oven oven = new Oven(External);
close();
"""
MISSION = """[mission]
name = "rig"
final_tick = 120
[[reactor]]
name = "planner"
model = "planner.nddl"
latency = 1
lookahead = 120
internal = ["sol"]
external = ["drill", "oven"]
[[reactor]]
name = "world"
model = "world.nddl"
internal = ["drill", "oven"]
[[goal]]
timeline = "sol"
predicate = "Core"
start = [5, 20]
mandatory = true
"""


@pytest.fixture
def mission(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A mission that passes, though its oven is lit later than the rule of its goal allows."""
    for name, text in (("rig", RIG), ("world", WORLD), ("planner", PLANNER)):
        (tmp_path / f"{name}.nddl").write_text(text, encoding="utf-8")
    (tmp_path / "mission.toml").write_text(MISSION, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path / "mission.toml"


def test_a_trace_that_oversteps_what_a_repair_forgot_is_told_as_such(
    mission: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["run", "mission.toml", "--trace", "t.jsonl"]) == 0
    capsys.readouterr()
    assert run(["validate", "t.jsonl"]) == 1
    told = capsys.readouterr().out
    assert "planner.nddl:9: `bake.start <= bore.end + 12` does not hold" in told
    assert "help: `planner` forgot its past in the repair at tick" in told
    assert "place in the list" not in told  # that is for plans that somebody wrote


def test_a_check_says_how_many_missions_passed_after_repairs(mission: Path, capsys: pytest.CaptureFixture[str]) -> None:
    check = ["check", "mission.toml", "--missions", "1", "--flights", "0", "--no-store"]
    assert run(check) == 0
    assert "1 mission passed after repairs, which may set aside what a rule says" in capsys.readouterr().out
    mission.write_text(MISSION + "[check]\nmax_repairs = 5\n", encoding="utf-8")
    assert run(check) == 0
    assert "passed after repairs" not in capsys.readouterr().out
