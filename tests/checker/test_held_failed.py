"""A mission fails (F8) where a timeline comes to hold `Failed`, whoever said so (reference of T-REX, 1.10)."""

from pathlib import Path

import pytest

from checker.oracle import Verdict, judge
from nddlc.main import run
from runtime.executive.outcome import Outcome
from tests.executive.flying import flown, planner, simulator

LAMP = """
class Lamp extends AgentTimeline { predicate Off { } Lamp(Mode m) { super(m, "Off"); } }
class Mood extends AgentTimeline { predicate Low { } predicate High { } Mood(Mode m) { super(m, "Low"); } }
"""
LIT = f"{LAMP} Lamp::Off {{ duration == 8; meets(object.%s next); }} Lamp lamp = new Lamp(Internal); close();"
USER = f"""{LAMP}
Lamp::Failed {{ equals(Mood.High h); }}
Lamp lamp = new Lamp(Observe); Mood mood = new Mood(Internal); close();
"""

MISSION = """[mission]
name = "lamp"
final_tick = 20
[[reactor]]
name = "sim"
model = "sim.nddl"
latency = 0
lookahead = 1
internal = ["lamp"]
[check]
missions = 1
"""


def said(predicate: str, lookahead: int) -> Outcome:
    """A mission in which a lamp comes to hold something at tick 8, and the planner goes on."""
    lamp = simulator("sim", LIT % predicate, "lamp")
    if lookahead > 1:
        lamp = planner("sim", LIT % predicate, "lamp", latency=0, lookahead=lookahead)
    return flown(lamp, planner("plan", USER, "mood", "lamp", latency=1, lookahead=5), until=20).outcome


@pytest.mark.parametrize("lookahead", [1, 10], ids=["compiled", "planned"])
def test_an_owner_that_says_that_it_failed_fails_the_mission(lookahead: int) -> None:
    outcome = said("Failed", lookahead)
    assert outcome.abort is None and outcome.last_tick == 20
    judgement = judge(outcome)
    assert (judgement.verdict, judgement.code) == (Verdict.FAIL, "F8")
    assert judgement.reason is not None
    assert (judgement.reason.timeline, judgement.reason.tick) == ("lamp", 8)


@pytest.mark.parametrize("lookahead", [1, 10], ids=["compiled", "planned"])
def test_what_is_only_unknown_fails_no_mission(lookahead: int) -> None:
    assert judge(said("undefined", lookahead)).verdict is Verdict.PASS


def test_the_story_tells_who_said_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sim.nddl").write_text(f'#include "TREX.nddl"\n{LIT % "Failed"}')
    (tmp_path / "mission.toml").write_text(MISSION)
    assert run(["check", "mission.toml", "--workers", "1", "--flights", "0", "--no-conditions"]) == 1
    assert "`lamp` holds `Failed` from tick 8 on" in capsys.readouterr().out
    assert run(["explain", "latest#1", "--flights", "0"]) == 0
    assert "tick 8: sim publishes lamp = Failed" in capsys.readouterr().out
