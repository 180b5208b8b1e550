"""What a plan put before tick 0, though it might have been done later, is named: nobody carried it out."""

from pathlib import Path

import pytest

from nddlc.main import run

MODEL = """#include "TREX.nddl"
class Plan extends AgentTimeline { predicate Idle { } predicate Do { } Plan(Mode m) { super(m, "Idle"); } }
class Aux extends AgentTimeline { predicate Nothing { } predicate Prep { } Aux(Mode m) { super(m, "Nothing"); } }
Plan::Do { duration == 4; RULE }
Plan plan = new Plan(Internal);
Aux aux = new Aux(Internal);
close();
"""
MISSION = """[mission]
name = "m"
final_tick = 30
[[reactor]]
name = "p"
model = "p.nddl"
lookahead = 20
[[goal]]
timeline = "plan"
predicate = "Do"
start = [3, 10]
"""


@pytest.mark.parametrize(
    ("rule", "is_told"),
    [
        ("any(Aux.Prep p); p.duration == 2; p.end <= start;", True),
        ("any(Aux.Prep p); p.duration == 2; p.end <= start; p.start >= 0;", False),
        ("contains(Aux.Prep p);", False),
    ],
)
def test_what_was_put_before_the_mission_is_named(
    tmp_path: Path, rule: str, is_told: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "p.nddl").write_text(MODEL.replace("RULE", rule))
    (tmp_path / "mission.toml").write_text(MISSION)
    assert run(["run", str(tmp_path / "mission.toml")]) == 0
    told = capsys.readouterr().out
    assert ("never carried out: Aux.Prep on `aux`, asked for by Plan.Do" in told) is is_told
    assert "PASS" in told
