"""`nddlc plan mission.toml`: the goals of a mission file are planned for, as the planner of the mission would."""

import json
from pathlib import Path

import pytest

from nddlc.main import run

ROOT = Path(__file__).parents[2]
GPS = str(ROOT / "models" / "gps" / "mission.toml")
Captured = pytest.CaptureFixture[str]


def test_the_goals_are_planned_within_what_the_file_allows(capsys: Captured) -> None:
    assert run(["plan", GPS, "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["solve"]["result"] == "plan"
    text = json.dumps(data)
    assert '"goal1"' in text and '"goal2"' in text and "240.0" in text and "180.0" in text


def test_goals_that_cannot_be_met_are_explained(tmp_path: Path, capsys: Captured) -> None:
    assert run(["new", str(tmp_path / "s")]) == 0
    mission = tmp_path / "s" / "mission.toml"
    mission.write_text(mission.read_text().replace("start = [350, 500]", "start = [350, 500]\nduration = 400"))
    capsys.readouterr()
    assert run(["plan", str(mission), "--explain"]) == 1
    assert "duration <= LEG_MAX" in capsys.readouterr().out


def test_goals_that_are_not_mandatory_may_be_rejected(tmp_path: Path, capsys: Captured) -> None:
    assert run(["new", str(tmp_path / "s")]) == 0
    mission = tmp_path / "s" / "mission.toml"
    text = mission.read_text().replace("start = [350, 500]", "start = [350, 500]\nduration = 400")
    mission.write_text(text.replace("mandatory = true", "mandatory = false"))
    capsys.readouterr()
    assert run(["plan", str(mission)]) == 0
    assert "REJECTED" in capsys.readouterr().out


def test_a_reactor_is_named(capsys: Captured) -> None:
    assert run(["plan", GPS, "--reactor", "navigatr"]) == 2
    assert "did you mean `navigator`?" in capsys.readouterr().err
    assert run(["plan", GPS, "--reactor", "navigator", "--horizon", "0", "500", "--allow-unplanned"]) == 0
    assert run(["plan", str(ROOT / "models" / "classic" / "lamp.nddl"), "--reactor", "x"]) == 2


def test_mistakes_of_the_file_are_told(tmp_path: Path, capsys: Captured) -> None:
    assert run(["new", str(tmp_path / "s")]) == 0
    mission = tmp_path / "s" / "mission.toml"
    mission.write_text(mission.read_text().replace("final_tick", "finaltick"))
    assert run(["plan", str(mission)]) == 2
    assert "did you mean `final_tick`" in capsys.readouterr().err


def test_a_goal_without_a_time_is_planned_within_the_mission(tmp_path: Path, capsys: Captured) -> None:
    assert run(["new", str(tmp_path / "battery")]) == 0
    capsys.readouterr()
    assert run(["plan", str(tmp_path / "battery" / "mission.toml"), "--max-steps", "1000"]) == 0
    said = capsys.readouterr().out  # one that decided of times before it kept the level would take 300,000
    assert "plan found" in said and "INACTIVE" not in said and "left out" not in said
    assert "Reservoir.produce" in said


def test_an_agent_file_of_t_rex_is_a_mission_file(
    tmp_path: Path, capsys: Captured, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert run(["new", str(tmp_path / "blank")]) == 0
    monkeypatch.chdir(tmp_path / "blank")
    Path("agent.xml").write_text(
        '<Agent name="a" finalTick="200">\n'
        '  <EuropaReactor name="planner" latency="1" lookahead="200" model="planner.nddl">\n'
        '    <Internal name="task"/> <External name="device"/>\n  </EuropaReactor>\n'
        '  <EuropaReactor name="simulator" latency="0" lookahead="1" model="simulator.nddl">\n'
        '    <Internal name="device"/>\n  </EuropaReactor>\n'
        '  <Goal on="task" pred="Do"> <Variable name="start"> <int min="5" max="60"/> </Variable> </Goal>\n</Agent>\n'
    )
    for command in (
        ["plan", "agent.xml", "--reactor", "planner"],
        ["compile", "agent.xml"],
        ["validate", "agent.xml"],
        ["check", "agent.xml", "--missions", "1"],
        ["explain", "agent.xml#1", "--flights", "0"],
    ):
        assert run(command) == 0, (command, capsys.readouterr().err)


def test_a_solver_without_a_filter_plans_what_lies_in_the_mission(tmp_path: Path, capsys: Captured) -> None:
    """Day and night ask for each other: beyond the final tick there is no end of them."""
    (tmp_path / "sun.nddl").write_text(
        '#include "TREX.nddl"\nclass Sun extends AgentTimeline {\n'
        '  predicate Day { } predicate Night { } Sun(Mode m) { super(m, "Day"); }\n}\n'
        "Sun::Day { duration == 20; meets(object.Night n); }\nSun::Night { duration == 10; meets(object.Day d); }\n"
        "Sun sun = new Sun(Internal);\nclose();\n"
    )
    managers = ("ThreatManager", "OpenConditionManager", "UnboundVariableManager")
    (tmp_path / "solver.toml").write_text("".join(f'[[manager]]\ncomponent = "{one}"\n' for one in managers))
    (tmp_path / "mission.toml").write_text(
        '[mission]\nname = "sun"\nfinal_tick = 100\n[[reactor]]\nname = "sun"\nmodel = "sun.nddl"\nlookahead = 100\n'
        'internal = ["sun"]\nsolver = "solver.toml"\n[[goal]]\ntimeline = "sun"\npredicate = "Day"\nstart = [5, 9]\n'
    )
    for words in ([], ["--horizon", "0", "50"]):
        assert run(["plan", str(tmp_path / "mission.toml"), *words, "--max-steps", "5000"]) == 0
        assert "plan found after " in capsys.readouterr().out
