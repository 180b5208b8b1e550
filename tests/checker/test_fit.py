"""Goals, parameters and roles of a mission file are typed against the models; each mistake is named where it stands."""

import json
import os
from pathlib import Path

import pytest

from nddlc.main import run

MODEL = """\
#include "TREX.nddl"
enum Gear { Low, High }
class Spot { int n; Spot(int m) { n = m; } }
class Drive extends AgentTimeline {
  predicate Idle {}
  predicate Go { float distance; int legs; bool fast; Gear gear; Spot to; string note; legs <= 9; }
  Drive(Mode m) { super(m, "Idle"); }
}
int LEGS = [0 9];
Spot home = new Spot(1);
Spot away = new Spot(2);
Drive drive = new Drive(Internal);
Drive other = new Drive(External);
Drive::Go { float t; t == sampledParameter(LEGS); duration >= 3; }
close();
"""
OWNER = MODEL.replace("drive = new Drive(Internal)", "drive = new Drive(External)").replace(
    "other = new Drive(External)", "other = new Drive(Internal)"
)
SAMPLED = "no model samples a parameter `{}`"
MISSION = """\
[mission]
name = "drive"
final_tick = 50
[[reactor]]
name = "driver"
model = "driver.nddl"
lookahead = 50
internal = ["drive"]
external = ["other"]
[[reactor]]
name = "second"
model = "second.nddl"
internal = ["other"]
[[goal]]
timeline = "drive"
predicate = "Go"
[goal.parameters]
distance = 3.5
legs = 2
fast = true
gear = "Low"
to = "home"
note = "x"
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "driver.nddl").write_text(MODEL)
    second = OWNER.replace("Drive drive = new Drive(External);\n", "").replace("t == sampledParameter(LEGS); ", "")
    (tmp_path / "second.nddl").write_text(second)
    return tmp_path


def found(text: str, capsys: pytest.CaptureFixture[str]) -> list[tuple[str, int, str, str | None]]:
    """What `lint` and `check --dry-run` alike complain of."""
    Path("mission.toml").write_text(text)
    code = run(["lint", "mission.toml", "--format", "json", "--fail-on", "error"])
    linted = json.loads(capsys.readouterr().out)["diagnostics"]
    assert run(["check", "--dry-run", "mission.toml", "--format", "json"]) == 2 * code
    if code:
        assert json.loads(capsys.readouterr().out)["diagnostics"] == linted
    assert not Path("nddlc-report").exists()
    return [(one["code"], one["line"], one["message"], one["help"]) for one in linted if one["severity"] != "info"]


def test_a_mission_in_order_is_said_to_be(capsys: pytest.CaptureFixture[str]) -> None:
    assert found(MISSION, capsys) == []
    assert run(["check", "--dry-run", "mission.toml"]) == 0
    assert "in order; nothing was flown" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("old", "new", "wanted", "advice"),
    [
        ("distance = 3.5", 'distance = "far"', 'a number, or a range of them, not the text "far"', None),
        ("distance = 3.5", "distance = true", "a number, or a range of them, not true or false", None),
        ("distance = 3.5", "distance = nan", "a number, not the number nan", None),
        ("legs = 2", "legs = 2.5", "a whole number, not the number 2.5", None),
        ("legs = 2", "legs = [1, 2.5]", "a whole number, not a list", None),
        ("fast = true", "fast = 1", "true or false, not the number 1", None),
        ('gear = "Low"', 'gear = "Lwo"', 'a value of `Gear`, not the text "Lwo"', "did you mean `Low`?"),
        ('gear = "Low"', "gear = 1", "a value of `Gear`, in quotes, not the number 1", "there are: Low, High"),
        ('to = "home"', 'to = "drive"', 'an object of class `Spot`, not the text "drive"', "there are: home, away"),
        ('note = "x"', "note = 5", "a text, in quotes, not the number 5", None),
    ],
)
def test_a_value_of_another_type_is_named(
    old: str, new: str, wanted: str, advice: str | None, capsys: pytest.CaptureFixture[str]
) -> None:
    text = MISSION.replace(old, new)
    line = text[: text.index(new)].count("\n") + 1
    name = new.partition(" ")[0]
    assert found(text, capsys) == [("NDDL719", line, f"`{name}` of `Drive.Go` must be {wanted}", advice)]


LATER = ", or let the mission end later (`final_tick`)"
ADVICE = {
    "at = 50": f"send it at tick 48 or earlier (`at`){LATER}",
    "start = [60, 70]": f"let it begin at tick 49 or earlier (`start`){LATER}",
    "at = 20\nstart = [5, 20]": "send it before tick 20 (`at`), or let it begin later (`start`)",
    "start = 40\nduration = [20, 30]": f"let it last 10 ticks or less (`duration`){LATER}",
    "end = [51, 90]": f"let it end at tick 50 or earlier (`end`){LATER}",
    "start = 10\nduration = 20\nend = [0, 25]": "widen its bounds",
    "duration = 0": "a token lasts one tick or longer",
}


@pytest.mark.parametrize(
    ("keys", "reason"),
    [
        ("at = 50", "it is sent at tick 50, and the mission ends at tick 50"),
        ("start = [60, 70]", "it begins at tick 60 or later, and the mission ends at tick 50"),
        ("at = 20\nstart = [5, 20]", "it begins by tick 20, and is sent at tick 20"),
        ("start = 40\nduration = [20, 30]", "it ends at tick 60 or later, and the mission ends at tick 50"),
        ("end = [51, 90]", "it ends at tick 51 or later, and the mission ends at tick 50"),
        ("start = 10\nduration = 20\nend = [0, 25]", "it ends by tick 25, and cannot before tick 30"),
        ("duration = 0", "it lasts 0 ticks at most"),
    ],
)
def test_a_goal_without_time_is_named(keys: str, reason: str, capsys: pytest.CaptureFixture[str]) -> None:
    text = MISSION.replace('predicate = "Go"', f'predicate = "Go"\n{keys}')
    ((code, _, message, advice),) = found(text, capsys)
    assert (code, message) == ("NDDL720", f"this goal can never be achieved: {reason}")
    assert advice == ADVICE[keys]


@pytest.mark.parametrize(
    ("rule", "keys", "reason"),
    [
        ("duration == 20;", "start = [31, 40]", "it ends at tick 51 or later, and the mission ends at tick 50"),
        ("duration >= LONG;", "start = [21, 40]", "it ends at tick 51 or later, and the mission ends at tick 50"),
        ("duration >= LATER;", "start = [21, 40]", "it ends at tick 51 or later, and the mission ends at tick 50"),
        ("19 < duration;", "at = 30", "it ends at tick 51 or later, and the mission ends at tick 50"),
        ("start + 20 <= end;", "start = [5, 40]\nend = [6, 24]", "it ends by tick 24, and cannot before tick 25"),
        ("end - start >= 20;", "duration = [2, 19]", "it lasts 19 ticks at most"),
        ("duration == 20;", "start = [30, 40]", None),
        ("duration <= 20;", "start = [31, 40]", None),
        ("if (legs > 5) { duration == 20; }", "start = [31, 40]", None),
    ],
)
def test_a_goal_without_time_for_what_its_rule_says_is_named(
    rule: str, keys: str, reason: str | None, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "driver.nddl").write_text(
        MODEL.replace("duration >= 3;", rule).replace("int LEGS", "int LONG = 30; int LATER; LATER = 30;\nint LEGS")
    )
    told = found(MISSION.replace('predicate = "Go"', f'predicate = "Go"\n{keys}'), capsys)
    wanted = [] if reason is None else [f"this goal can never be achieved: {reason}"]
    assert [message for code, _, message, _ in told if code == "NDDL720"] == wanted


def test_half_a_tick_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    text = MISSION.replace('predicate = "Go"', 'predicate = "Go"\nstart = [1.5, 30]')
    assert [one[2] for one in found(text, capsys)] == ["`start` must be whole ticks, not 1.5"]


def test_a_parameter_of_whole_numbers_is_drawn_from_such(capsys: pytest.CaptureFixture[str]) -> None:
    for keys, reason in (
        ("range = [0.2, 0.7]", "there is none from 0.2 to 0.7"),
        ("values = [1, 2.5]", "2.5 is none"),
        ("clip = [2.5, 9]", "2.5 of its `clip` is none"),
    ):
        ((code, _, message, _),) = found(MISSION + f"[parameters.LEGS]\n{keys}\n", capsys)
        assert (code, message) == ("NDDL713", f"the model samples whole numbers, and {reason}")


@pytest.mark.parametrize(
    ("keys", "drawn"),
    [
        ("range = [0, 40]", "from 0 to 40"),
        ("range = [0, 40]\nclip = [-1, 9]", ""),
        ("range = [2, 9]", ""),
        ("values = [1, 12]", "as 12"),
        ("value = 9", ""),
        ('distribution = "normal"', ""),
    ],
)
def test_a_parameter_that_is_drawn_beyond_what_the_model_says_is_told(
    keys: str, drawn: str, capsys: pytest.CaptureFixture[str]
) -> None:
    told = [(code, message) for code, _, message, _ in found(MISSION + f"[parameters.LEGS]\n{keys}\n", capsys)]
    assert told == ([("NDDL740", f"`LEGS` is drawn {drawn}, and the model says 0 to 9")] if drawn else [])


@pytest.mark.parametrize(
    ("used", "owned", "told"),
    [
        ("5.0", "5.0", ""),
        ("5.0", "50.0", "`other` is made with 5 here, and by its owner `second` with 50"),
        ("REACH", "5.0", ""),
        ("REACH", "7", "`other` is made with 5 here, and by its owner `second` with 7"),
    ],
)
def test_a_timeline_that_two_models_make_with_other_numbers_is_told(
    used: str, owned: str, told: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, reach in (("driver", used), ("second", owned)):
        model = folder / f"{name}.nddl"
        text = model.read_text().replace("Drive(Mode m) {", "float reach; Drive(Mode m, float r) { reach = r;")
        text = text.replace('reach = r; super(m, "Idle");', 'super(m, "Idle"); reach = r;')
        model.write_text(text.replace("al);\n", f"al, {reach});\n").replace("int LEGS", "float REACH = 5.0;\nint LEGS"))
    complaints = [(code, message) for code, _, message, _ in found(MISSION, capsys)]
    assert complaints == ([("NDDL741", told)] if told else [])


def test_a_parameter_of_a_joint_table_that_nobody_samples_is_named_in_it(capsys: pytest.CaptureFixture[str]) -> None:
    text = MISSION + '[joint.AIR]\nparameters = ["LEGS", "HEAT"]\nrows = [[1, 2], [3, 4]]\n'
    ((code, line, message, _),) = found(text, capsys)
    assert (code, line, message) == ("NDDL714", text[: text.index('"HEAT"')].count("\n") + 1, SAMPLED.format("HEAT"))


def test_a_value_that_is_never_drawn_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    Path("mission.toml").write_text(MISSION)
    for value, told in (("4", ""), ("12", "note: 12 is never drawn: LEGS is uniform on [0, 9]")):
        run(["run", "mission.toml", "--param", f"LEGS={value}"])
        said = capsys.readouterr().err
        assert told in said if told else "never drawn" not in said


@pytest.mark.parametrize(
    "text", ["nan", "inf", "-inf", "1e300", "2251799813685248", "\N{ARABIC-INDIC DIGIT THREE}", "1_0", " 3", "2.5"]
)
def test_a_value_that_no_parameter_can_have_is_refused(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path("mission.toml").write_text(MISSION)
    assert run(["run", "mission.toml", "--param", f"LEGS={text}"]) == 2
    assert f"`LEGS` takes a {'whole ' if text == '2.5' else ''}number" in capsys.readouterr().err


def test_an_owner_that_takes_no_requests_is_told_of(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asking = MODEL.replace("duration >= 3;", "duration >= 3; contains(Drive.Go there); there.object == other;")
    asking = asking.replace(
        "class Drive ",
        "class Second extends AgentTimeline { predicate Still {} predicate Go {}\n"
        '  Second(Mode m) { super(m, "Still"); } }\nclass Drive ',
    )
    asking = asking.replace("contains(Drive.Go there); there.object == other;", "contains(Second.Go there);")
    asking = asking.replace("Drive other = new Drive(External)", "Second other = new Second(External)")
    (folder / "driver.nddl").write_text(asking)
    (folder / "second.nddl").write_text(
        asking.replace("t == sampledParameter(LEGS); ", "")
        .replace("Second other = new Second(External)", "Second other = new Second(Internal)")
        .replace("Drive drive = new Drive(Internal);\n", "")
    )
    still = MISSION.replace('model = "second.nddl"', 'model = "second.nddl"\nlookahead = 0')
    assert [(code, message) for code, _, message, _ in found(still, capsys)] == [
        ("NDDL734", "`other` takes no requests: its owner `second` has a lookahead of 0")
    ]
    assert found(still.replace('external = ["other"]', 'external = ["other"]\nobserve = ["other"]'), capsys) == []
    assert found(still.replace("lookahead = 0", "lookahead = 1"), capsys) == []


def test_a_resource_whose_uses_nobody_orders_is_told_of(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    stored = "Reservoir battery = new Reservoir(50.0, 0.0, 90.0);\nclose();"
    (folder / "driver.nddl").write_text(MODEL.replace("close();", stored))
    told = [("NDDL733", "nothing orders the uses of `battery` in the plans of `driver`")]
    assert [(code, message) for code, _, message, _ in found(MISSION, capsys)] == told
    for component, complaints in (("ResourceThreatManager", []), ("OpenConditionManager", told)):
        (folder / "s.toml").write_text(f'[[manager]]\ncomponent = "{component}"\n')
        text = MISSION.replace('model = "driver.nddl"', 'model = "driver.nddl"\nsolver = "s.toml"')
        assert [(code, message) for code, _, message, _ in found(text, capsys)] == complaints
    agent = """<Agent name="a" finalTick="90">
  <EuropaReactor name="driver" model="driver.nddl" latency="1" lookahead="30"/>
</Agent>
"""
    (folder / "agent.xml").write_text(agent)
    (folder / "driver.nddl").write_text(MODEL.replace("close();", stored).replace("(External)", "(Internal)"))
    run(["check", "--dry-run", str(folder / "agent.xml")])
    assert "name a file with a `ResourceThreatManager` as `plan_cfg`" in capsys.readouterr().out


def test_roles_of_model_and_mission_are_compared(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "driver.nddl").write_text(MODEL.replace("other = new Drive(External)", "other = new Drive(Internal)"))
    assert found(MISSION, capsys) == [
        (
            "NDDL721",
            9,
            "`other` is used (`external`) here, and `Internal` in the model `driver.nddl`",
            "list `other` under `internal`, or change its mode in the model",
        )
    ]
    (folder / "driver.nddl").write_text(MODEL)
    text = MISSION.replace('external = ["other"]\n', "")
    assert [(one[0], one[1]) for one in found(text, capsys)] == [("NDDL722", 4)]


def test_a_timeline_misspelt_in_a_model_is_told_once(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "driver.nddl").write_text(MODEL.replace("Drive other =", "Drive ohter ="))
    ((code, line, _, advice),) = found(MISSION, capsys)
    assert (code, line, advice) == ("NDDL716", 9, "did you mean `ohter`?")


def test_a_default_that_the_class_lacks_is_named_in_the_model(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "driver.nddl").write_text(MODEL.replace('super(m, "Idle")', 'super(m, "Idel")'))
    (complaint,) = found(MISSION, capsys)
    assert complaint == (
        "NDDL723",
        7,
        "`drive` falls back to `Idel`, which `Drive` does not have",
        "did you mean `Idle`?",
    )


def test_files_are_regular_ones(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    os.mkfifo(folder / "pipe.nddl")
    for name, what in (("pipe.nddl", "a device or a pipe"), ("/dev/zero", "a device or a pipe"), (".", "a directory")):
        text = MISSION.replace('"second.nddl"', f'"{name}"')
        assert found(text, capsys) == [("NDDL724", 12, f"`{name}` is {what}, not a file", "name a regular file")]


def test_a_level_of_one_value_is_told_of(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    stored = "Reservoir battery = new Reservoir(50.0, 0.0, 90.0);\nclose();"
    (folder / "driver.nddl").write_text(MODEL.replace("close();", stored))
    kept = '[[property]]\nname = "charged"\nkind = "level"\nresource = "battery"\nlevel = '
    told = ("NDDL735", "the level of `battery` would have to be 22 at all times")
    for level, is_told in (("22", True), ("[22, 22]", True), ("[22, inf]", False), ("[-inf, 22]", False)):
        assert (
            told in [(code, message) for code, _, message, _ in found(f"{MISSION}{kept}{level}\n", capsys)]
        ) is is_told


CODED = """\
[[reactor]]
name = "own"
code = "own.py:Own"
"""
OWN = "from runtime.user.reactor import Reactor\nclass Own(Reactor): ...\nclass Other(Own): ...\nThird = Own\n"


@pytest.mark.parametrize(
    ("model", "old", "new"),
    [
        (MODEL.replace("close();", "Reservoir tank = new Reservoir(50.0, 0.0, 90.0);\nclose();"), "", ""),
        (MODEL, '["drive"]', '["drvie"]'),
        (MODEL, 'external = ["other"]\n', ""),
        (MODEL.replace("other = new Drive(External)", "other = new Drive(Internal)"), "", ""),
        (MODEL.replace("Drive::Go {", "Drive::Go { contains(other.Idle i);"), "second.nddl", "second.nddl"),
    ],
)
def test_complaints_stand_where_the_reactor_does(
    folder: Path, capsys: pytest.CaptureFixture[str], model: str, old: str, new: str
) -> None:
    """Whatever reactors in Python stand before it."""
    (folder / "driver.nddl").write_text(model)
    (folder / "own.py").write_text(OWN)
    plain = MISSION.replace(old, new) if old else MISSION
    if "contains(other" in model:
        plain = plain.replace('model = "second.nddl"', 'model = "second.nddl"\nlookahead = 0')
    alone = found(plain, capsys)
    behind = found(plain.replace("[[reactor]]", f"{CODED}[[reactor]]", 1), capsys)
    lines = CODED.count("\n")
    assert alone
    assert behind == [(code, line + lines, message, advice) for code, line, message, advice in alone]


@pytest.mark.parametrize(
    ("named", "complaint"),
    [
        ("own.py:Other", None),
        ("own.py:Third", None),
        ("own.py:Reactor", None),
        ("own.py:Othr", ("`own.py` has no class `Othr`", "did you mean `Other`?")),
        ("own.py:Detector", ("`own.py` has no class `Detector`", "it has `Own`, `Other`")),
        ("free.py:Detector", None),
        ("empty.py:Own", ("`empty.py` has no class `Own`", "it has no class at all")),
        (":LogPlayr", ("nddlc has no class `LogPlayr`", "did you mean `LogPlayer`?")),
    ],
)
def test_a_class_that_its_file_does_not_have_is_told(
    folder: Path, capsys: pytest.CaptureFixture[str], named: str, complaint: tuple[str, str] | None
) -> None:
    """And no line of the file is run for it."""
    mark = "open('mark', 'w')\n"
    for file, text in (("own.py", OWN), ("free.py", "exec('class Detector: ...')\n"), ("empty.py", "")):
        (folder / file).write_text(text + mark)
    coded = CODED.replace("own.py:Own", named)
    Path("mission.toml").write_text(MISSION.replace("[[reactor]]", f"{coded}[[reactor]]", 1))
    run(["lint", "mission.toml", "--format", "json"])
    told = [one for one in json.loads(capsys.readouterr().out)["diagnostics"] if one["code"] == "NDDL736"]
    assert [(one["message"], one["help"]) for one in told] == ([complaint] if complaint else [])
    assert not (folder / "mark").exists()
