"""`nddlc check --coverage` shows which rules and branches no mission exercised, each with its text."""

from pathlib import Path

import pytest

from nddlc.main import run

pytestmark = pytest.mark.once

MODEL = """\
#include "TREX.nddl"
enum Kind { calm, alarm }
class Lamp extends AgentTimeline {
  predicate Off { }
  predicate On { Kind kind; }
  predicate Broken { }
  Lamp(Mode m) { super(m, "Off"); }
}
Lamp::On {
  duration == 3;
  if (kind == alarm) {
    end <= 90;
  } else {
    end <= 80;
  }
}
Lamp::Broken { duration == 1; }
Lamp lamp = new Lamp(Internal);
close();
"""
MISSION = """\
[mission]
name = "lamp"
final_tick = 20
[[reactor]]
name = "sim"
model = "m.nddl"
lookahead = 1
internal = ["lamp"]
[[goal]]
timeline = "lamp"
predicate = "On"
[goal.parameters]
kind = "alarm"
"""


def test_what_no_mission_exercised_is_shown_with_its_text(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("m.nddl").write_text(MODEL)
    Path("mission.toml").write_text(MISSION)
    assert run(["check", "--missions", "1", "--workers", "1", "--no-store", "--coverage", "--flights", "0"]) == 0
    told = capsys.readouterr().out
    assert "1 of 2 rules fired, 1 of 2 branches taken" in told
    assert "m.nddl:11: in Lamp.On, never false: if (kind == alarm) {" in told
    assert "m.nddl:17: the rule of Lamp.Broken never fired: Lamp::Broken { duration == 1; }" in told


@pytest.mark.parametrize(
    ("condition", "branches"),
    [
        ("start <= AGENT_CLOCK", 1),
        ("AGENT_CLOCK > start", 1),
        ("AGENT_CLOCK - start >= 1", 1),
        ("start - AGENT_CLOCK <= -1", 1),
        ("start + 1 == AGENT_CLOCK", 1),
        ("!(AGENT_CLOCK < start)", 1),
        ("start <= AGENT_CLOCK || kind == calm", 1),
        ("start <= AGENT_CLOCK && kind == alarm", 2),
        ("start + 1 <= end", 2),
    ],
)
def test_what_the_clock_can_never_tell_is_no_branch_left_to_take(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], condition: str, branches: int
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("m.nddl").write_text(MODEL.replace("kind == alarm", condition))
    Path("mission.toml").write_text(MISSION)
    run(["check", "--missions", "1", "--workers", "1", "--no-store", "--coverage", "--flights", "0"])
    assert f" of {branches} branch" in capsys.readouterr().out
