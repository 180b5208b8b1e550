"""What `nddlc run` and `nddlc check` say beside a verdict: what lint warns of, and why each open goal stayed open."""

from pathlib import Path

import pytest

from nddlc.main import run

MODEL = """#include "TREX.nddl"
class Oven extends AgentTimeline {
  predicate Empty { }
  predicate Bake { int size; }
  Oven(Mode m) { super(m, "Empty"); }
}
Reusable bus = new Reusable(50.0, 0.0);
Oven::Bake {
  duration == 20;
  if (size > 1) {
    contains(Reusable.uses power);
    power.quantity == 140.0;
  }
}
Oven oven = new Oven(Internal);
Oven stove = new Oven(Internal);
close();
"""
MISSION = """[mission]
name = "kitchen"
final_tick = 100
[[reactor]]
name = "cook"
model = "kitchen.nddl"
solver = "cook.toml"
latency = 1
lookahead = 100
internal = ["oven", "stove"]
[[goal]]
timeline = "oven"
predicate = "Bake"
mandatory = true
end = [0, 15]
[goal.parameters]
size = 1
[[goal]]
timeline = "stove"
predicate = "Bake"
mandatory = true
[goal.parameters]
size = 2
"""
MANAGERS = ("ResourceThreatManager", "ThreatManager", "OpenConditionManager", "UnboundVariableManager")


@pytest.fixture
def kitchen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("kitchen.nddl").write_text(MODEL, encoding="utf-8")
    Path("mission.toml").write_text(MISSION, encoding="utf-8")
    Path("cook.toml").write_text("".join(f'[[manager]]\ncomponent = "{name}"\n' for name in MANAGERS), encoding="utf-8")


@pytest.mark.usefixtures("kitchen")
def test_what_lint_warns_of_is_told_before_a_flight(capsys: pytest.CaptureFixture[str]) -> None:
    told = (
        "2 warnings about these models (`nddlc lint` shows them in full):\n"
        "  kitchen.nddl:12:5: `power` takes 140.0 of `bus`, which has 50.0 [NDDL560]\n"
        "  mission.toml:15:7: this goal can never be achieved: "
        "it ends by tick 15, and cannot before tick 21 [NDDL720]\n"
    )
    assert run(["run", "--until", "1"]) == 1
    assert told in capsys.readouterr().err
    run(["check", "--missions", "1", "--flights", "0", "--no-store"])
    out = capsys.readouterr().out
    assert told in out
    assert out.count("NDDL720") == 1


@pytest.mark.usefixtures("kitchen")
def test_each_open_goal_has_lines_of_its_own(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["run"]) == 1
    told = capsys.readouterr().out
    lines = told[told.index("  these lines together rule out Bake(size=1); it breaks at the first:\n") :].splitlines()
    assert lines[1:3] == ["    kitchen.nddl:9:3: duration == 20", "    mission.toml:15:1: end = [0, 15]"]
    assert lines[3].startswith("  no choice is left for Bake(size=2): `bus` might be used too much at ")
