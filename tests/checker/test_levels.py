"""The level of a resource is promised, broken and told, wherever the resource stands in the model."""

import json
from pathlib import Path

import pytest

from nddlc.main import run

ROVER = """
class Battery extends Reservoir { Battery(float charge) { super(charge, 0.0, 100.0); } }
class Rover extends Timeline {
    predicate Idle { duration >= 1; }
    predicate Drive { duration == 5; }
}
float DRAIN = [10.0 40.0];
Battery battery = new Battery(100.0);
Rover rover = new Rover();
close();
Rover::Drive {
    float used;
    used == sampledParameter(DRAIN);
    starts(battery.consume drain);
    drain.quantity == used;
}
"""
ROVER_MISSION = """
[mission]
name = "rover"
final_tick = 40
[[reactor]]
name = "rover"
model = "rover.nddl"
lookahead = 40
internal = ["rover"]
[[goal]]
timeline = "rover"
predicate = "Drive"
[[property]]
name = "a reserve is left"
kind = "level"
resource = "battery"
level = [75, inf]
"""


def test_missions_fail_by_the_level_that_they_leave(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "rover.nddl").write_text(ROVER)
    (tmp_path / "mission.toml").write_text(ROVER_MISSION)
    monkeypatch.chdir(tmp_path)
    arguments = ["check", "mission.toml", "--missions", "30", "--max-failure-rate", "1", "--format", "json"]
    assert run([*arguments, "--workers", "1"]) == 0
    missions = json.loads(capsys.readouterr().out)["missions"]
    assert {one["verdict"] for one in missions} == {"PASS", "FAIL"}
    for one in missions:
        fate = one["properties"]["a reserve is left"]
        assert fate["margin"] == pytest.approx(25.0 - one["draws"][-1]["value"], abs=1e-6)
        assert fate["kept"] == (one["verdict"] == "PASS") == (fate["margin"] >= 0.0)


def test_a_resource_may_be_a_part_of_another_object(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    part = ROVER.replace("Battery battery = new Battery(100.0);\n", "")
    part = part.replace(
        "Timeline {\n", "Timeline {\n    Battery battery;\n    Rover() { battery = new Battery(100.0); }\n"
    )
    (tmp_path / "rover.nddl").write_text(part.replace("starts(battery.", "starts(object.battery."))
    (tmp_path / "mission.toml").write_text(ROVER_MISSION.replace('"battery"', '"rover.battery"'))
    monkeypatch.chdir(tmp_path)
    run(["lint", "mission.toml"])
    assert "nothing orders the uses of `rover.battery`" in capsys.readouterr().out
    assert run(["check", "mission.toml", "--missions", "30", "--max-failure-rate", "1", "--format", "json"]) == 0
    for one in json.loads(capsys.readouterr().out)["missions"]:
        margin = one["properties"]["a reserve is left"]["margin"]
        assert margin == pytest.approx(25.0 - one["draws"][-1]["value"], abs=1e-6)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"battery"', '"batery"', "no model has a resource `batery`"),
        ('"battery"', '"rover"', "no model has a resource `rover`"),
        ("level = [75, inf]", 'reactor = "rver"\nmargin = 3', "there is no reactor `rver`"),
        ("level = [75, inf]", "", "[[property]] needs the key `level`"),
        ("level = [75, inf]", "level = [40, 30]", "`level` runs backwards"),
        ('resource = "battery"', 'timeline = "rover"', "is `resource` meant, which is missing?"),
        ("level = [75, inf]", "level = [75, inf]\nby = 9000", "`by = 9000` has no effect here"),
        ("level = [75, inf]", "level = [75, inf]\nfrom = 9000", "`from` must be before the end of the mission"),
        ("level = [75, inf]", "level = [75, inf]\nfrom = 9\nby = 5", "`from` must be at most `by`, 5, not 9"),
    ],
)
def test_a_mistake_about_a_level_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, message: str
) -> None:
    (tmp_path / "rover.nddl").write_text(ROVER)
    (tmp_path / "mission.toml").write_text(ROVER_MISSION.replace(old, new))
    assert run(["lint", str(tmp_path / "mission.toml")]) != 0
    assert message in capsys.readouterr().out


def test_a_story_tells_what_led_to_a_level_and_what_would_keep_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "rover.nddl").write_text(ROVER.replace("[10.0 40.0]", "[28.0 34.0]"))
    late = '[[property]]\nname = "it never idles"\nkind = "never"\ntimeline = "rover"\npredicate = "Idle"\n'
    again = '[[goal]]\ntimeline = "rover"\npredicate = "Drive"\nstart = [20, 25]\n'
    text = ROVER_MISSION.replace("level = [75, inf]", "level = [40, inf]")
    text = text.replace("[[property]]", f"start = [0, 5]\n{again}[[property]]", 1)
    (tmp_path / "mission.toml").write_text(text + late)
    monkeypatch.chdir(tmp_path)
    assert run(["check", "mission.toml", "--missions", "10", "--workers", "1"]) == 1
    shown = capsys.readouterr().out
    assert "the level of battery is 3" in shown
    assert ", at least 40 is promised; so is `it never idles` at tick " in shown
    assert "as to this property and not to `it never idles`" in shown
    assert "cause: change `" in shown
    assert run(["explain", "latest", "--flights", "0"]) == 0
    story = capsys.readouterr().out
    first, second = (line for line in story.splitlines() if " of battery: its level is " in line)
    assert "Rover.Drive takes " in first
    assert "tick 20: Rover.Drive takes " in second
    assert story.count("drain.quantity == used;") >= 2
    assert story.index("DRAIN is ") < story.index("tick 1: Rover.Drive takes") < story.index("tick 20: rover publishes")
