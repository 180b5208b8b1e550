"""A property that every mission violates hides no cause of another failure, which is told without regard to it."""

from pathlib import Path

import pytest

from nddlc.main import run

DEV = """#include "TREX.nddl"
class Dev extends AgentTimeline { predicate Off { } predicate Run { int n; } Dev(Mode m) { super(m, "Off"); } }
"""
PLAN = """class Job extends AgentTimeline {
    predicate Idle { }
    predicate Go { int n; }
    Job(Mode m) { super(m, "Idle"); }
}
Job::Go { contains(Dev.Run a); a.n == n; a.end == end; duration <= 8; }
Job job = new Job(Internal);
Dev dev = new Dev(External);
close();
"""
SIM = """float W = [0.0 10.0];
Dev::Run { float w; w == sampledParameter(W); duration == 2 + ceil(w); }
Dev dev = new Dev(Internal);
close();
"""
MISSION = """[mission]
name = "m"
final_tick = 40
[[reactor]]
name = "planner"
model = "plan.nddl"
latency = 1
lookahead = 100
internal = ["job"]
external = ["dev"]
[[reactor]]
name = "sim"
model = "sim.nddl"
latency = 0
lookahead = 1
internal = ["dev"]
[[goal]]
timeline = "job"
predicate = "Go"
start = [5, 5]
mandatory = true
parameters = { n = 1 }
[[property]]
name = "it rests"
kind = "never"
timeline = "dev"
predicate = "Run"
[check]
seed = 3
"""


def test_a_plan_that_breaks_has_a_cause_although_each_mission_violates_a_property(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "plan.nddl").write_text(DEV + PLAN)
    (tmp_path / "sim.nddl").write_text(DEV + SIM)
    (tmp_path / "mission.toml").write_text(MISSION)
    monkeypatch.chdir(tmp_path)
    assert run(["check", "mission.toml", "--missions", "4", "--workers", "1", "--no-conditions", "--flights", "8"]) == 1
    shown = capsys.readouterr().out
    broken, property_ = sorted(shown.split("\n\n")[1:3], key=lambda part: " P1 " in part)
    assert "cause: change `8` to `13`: " in broken
    assert ", whether `it rests` is kept or not" in broken
    assert "change `8`" not in property_
    assert "whether" not in property_
