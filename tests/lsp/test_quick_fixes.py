"""A model with five mistakes is repaired by quick fixes alone, as somebody would who is new to NDDL."""

import shutil
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
LAMP = (ROOT / "models" / "classic" / "lamp.nddl").read_text()
ROVER = (ROOT / "models" / "classic" / "rover.nddl").read_text()
ROBOT = """\
enum Mode { Slow, Fast }
class Place {
    string name;
    float x;
    Place(string n, float _x) { name = n; x = _x; }
}
class Robot extends Timeline {
    predicate At { Place place; }
    predicate Going { Place from; Place to; Mode mode; }
}
Robot::At {
    met_by(object.Going way);
    way.to == place;
}
Robot::Going {
    met_by(object.At a);
    any(object.At b);
    a before b;
    neq(from, to);
    a.place == from;
    if (mode == Fast) {
        duration <= 5;
    }
}
Place lab = new Place("lab", 1.5);
Place hall = new Place("hall", 9.0);
Robot robot = new Robot();
close();
fact(Robot.At first);
first.start == 0;
goal(Robot.At last);
last.place == hall;
"""
ROVING = ROBOT.replace("class Place", "int LIMIT = 5;\n\nclass Place", 1).replace(
    "duration <= 5;\n    }", "duration <= LIMIT;\n    } else {\n        duration >= 6;\n    }"
)
_LIMIT = "int LIMIT = 5;\n"
ORDERED = ROVING.replace(f"{_LIMIT}\n", "").replace("Robot::Going {", f"{_LIMIT}Robot::Going {{")
_USE = ORDERED[ORDERED.index(_LIMIT) : ORDERED.index("close();")]
ERROR = 1


def broken(text: str, *mistakes: tuple[str, ...], form: int = 1) -> str:
    """The text with mistakes; with `form` -1 as it should be once they are mended."""
    for mistake in mistakes:
        assert mistake[0] in text
        text = text.replace(mistake[0], mistake[form] if len(mistake) > 2 or form > 0 else mistake[0], 1)
    return text


# What is right, what is written in its place, and, where it is another, what mends that.
MODELS: dict[str, tuple[str, *tuple[tuple[str, ...], ...]]] = {
    "letters": (
        LAMP,
        ("predicate Press", "Predicate Press"),
        ("met_by(Switch.Press p)", "metby(Switch.Press p)"),
        ("new Lamp()", "new Lam()"),
        ("reading.start", "readin.start"),
        ("goal(Lamp.On reading)", "goal(Lamp.Onn reading)"),
    ),
    "signs": (
        LAMP,
        ("class Switch extends Timeline", "class Switch : Timeline"),
        ("Lamp::On {", "Lamp.On {"),
        ("duration == 1;", "duration = 1;"),
        ("new Switch();", "new Switch;"),
        ("reading.end == 30;", "reading.end == 30"),
    ),
    "another language": (
        ROVER,
        ("predicate At { Place place; }", "predicate At(Place place);"),
        ("way.target == place;", "way->target == place;"),
        ("= new Arm(rover)", "= Arm(rover)"),
        ("goal(Arm.Sampling first);", "goal Arm.Sampling first;"),
        ("// A rover", "# A rover"),
    ),
    "brackets": (
        LAMP,
        ("    duration >= 1;\n}", "    duration >= 1;"),
        ("met_by(Switch.Press p)", "met_by(Press p)"),
        ("Lamp lamp = new Lamp();", "Lamp lamp = new Lamp(;"),
        ("fact(Lamp.Off dark);", "fact(Lamp.Off dark;"),
        ("predicate Press { }", "predicate Press;"),
    ),
    "methods": (
        ROBOT,
        ("a before b;", "a.before(b);"),
        ("a.place == from;", "a.place.equals(from);"),
        ("class Robot extends Timeline {", "class Robot(Timeline) {"),
        ("Robot::Going {", "rule Robot.Going {"),
        ("fact(Robot.At first);", "fact(Robot.At, first);"),
    ),
    "functions": (
        ROBOT,
        ("a before b;", "before(a, b);"),
        ("neq(from, to);", "notEqual(from, to);"),
        ("duration <= 5;", "dur <= 5;"),
        ("last.place == hall;", "last.location == hall;"),
        ('"lab", 1.5', "'lab', 1.5"),
    ),
    "C": (
        ROBOT,
        ("if (mode == Fast) {", "if mode == Fast {"),
        ("enum Mode { Slow, Fast }", "enum Mode { Slow; Fast; }"),
        ('Place lab = new Place("lab", 1.5);', 'Place lab("lab", 1.5);'),
        ("Robot robot = ", "const Robot robot = "),
        ("float x;", "double x;"),
    ),
    "left out": (
        LAMP,
        ("predicate Press { }", "predicate Press"),
        ("Lamp lamp = new", "lamp = new"),
        ("close();", "Close();"),
        ("goal(Lamp.On reading);", "goal(Lamp.On, reading);"),
        ("reading.start == 20;", "reading.start == 20"),
    ),
    "types": (
        ROVING,
        ('"lab", 1.5', '1.5, "lab"'),
        ("int LIMIT = 5;", "int LIMIT = 5.0;"),
        ("first.start == 0;", 'first.start == "0";'),
        ("if (mode == Fast)", "if (mode == fast)"),
        ("neq(from, to);", "neq(from);"),
    ),
    "declarations": (
        ROVING,
        ("enum Mode { Slow, Fast }", "enum Mode { Slow }"),
        ("    float x;\n", ""),
        ("int LIMIT = 5;\n", "", ""),
        ("Robot::Going {", "Robot::Going {", "int LIMIT;\nRobot::Going {"),
        ("Place from; Place to; Mode mode;", "Place from; Mode mode;", "Place from; Mode mode; Place to;"),
        ("    predicate At { Place place; }\n", "    predicate At { }\n"),
    ),
    "order": (
        ORDERED,
        (_USE, _USE.removeprefix(_LIMIT) + _LIMIT),
        ("Robot robot = new Robot();", "Robot robot = new robot();"),
        ("fact(Robot.At first);", "fact Robot.At first;"),
        ("first.start == 0;", "first.start(0);"),
        ("if (mode == Fast)", "if (mode == fast)"),
    ),
    "Python": (
        ROVING,
        ("if (mode == Fast) {", "if (mode == Fast): {"),
        ("} else {", "} else: {"),
        ("enum Mode { Slow, Fast }", "enum Mode = { Slow, Fast }"),
        ("a.place == from;", "a.place is from;"),
        ("predicate At { Place place; }", "predicate At(place: Place);"),
    ),
    "PDDL": (
        ROVING,
        ("met_by(object.Going way);", "met_by object.Going way;"),
        ("a before b;", "a.before b;"),
        ("goal(Robot.At last);", "(goal Robot.At last);"),
        ("duration <= LIMIT;", "duration =< LIMIT;"),
        (
            "predicate Going { Place from; Place to; Mode mode; }",
            "predicate Going(from - Place, to - Place, mode - Mode);",
        ),
    ),
    "words": (
        ROBOT,
        ("way.to == place;", "way.to is place;"),
        ('"hall", 9.0', '"hall" 9.0'),
        ("from, to);", "from to);"),
        ("class Place {", "Class Place {"),
        ("last.place == hall;", "last.plac == hall;"),
    ),
}

# Mistakes in models that nddlc was not made with, in a file among those that it includes.
UNSEEN: dict[str, list[tuple[str, ...]]] = {
    "bakery/baker.nddl": [
        ("contains(Oven.Heat heat);", "contains(Oven.Heat heat)"),
        ("loaf == Loaf.white", "loaf == Loaf.White"),
        ("trays == ceil(kilos / TRAY);", "trays == Math.ceil(kilos / TRAY);"),
        ("knead before prove;", "knead.before(prove);"),
        ("bake.start >= prove.end + 20;", "bake.start > = prove.end + 20;"),
        ("int LOOKS = 6;", "int LOOKS == 6;"),
        ("Oven oven = new Oven(External);", "Oven oven = Oven(External);"),
        ("use.quantity == FLOUR_SHARE", "use.amount == FLOUR_SHARE"),
    ],
    "tram/driver.nddl": [
        ("contains(Points.Switch set);", "contains(Points.switch set);"),
        ("set.to == to;", "set to == to;"),
        ("if (to == Stop.market) {", "if to == Stop.market {"),
        ("set before run;", "set < run;"),
        ("float TO_DEPOT = 6.5;", "float TO_DEPOT = 6,5;"),
        ("open.duration <= DOORS_MAX;", "duration(open) <= DOORS_MAX;"),
        ("new Leg(Internal);", "new Leg(internal);"),
        ('#include "tram.nddl"', '#include "trams.nddl"'),
    ],
    "ward/nurse.nddl": [
        ("class Care extends AgentTimeline {", "class Care AgentTimeline {"),
        ("dose == DOSE_PER_KG * weight;", "dose == DOSE_PER_KG x weight;"),
        ("} else {", "} otherwise {"),
        ("treat meets watch;", "treat meet watch;"),
        ("prepare.route == Route.drip;", 'prepare.route == "drip";'),
        ("any(Reservoir.consume use);", "any(Reservoir.consumes use);"),
    ],
    "cave/pilot.nddl": [
        ("light.start + 2 <= go.start;", "light.start + 2s <= go.start;"),
        ("contains(lamp.On light);", "contains(lamp.On);"),
        ("light meets off;", "meets(light, off);"),
        ("contains(Robot.Return back);", "contains(Return back);"),
        ("Battery::Low {", "Batery::Low {"),
        ("predicate Reach { int crumb;", "predicate Reach { integer crumb;"),
        ("duration <= FIX_TICKS; }", "duration <= FIX_TICKS }"),
    ],
    "glider/captain.nddl": [
        ("use.quantity == depth * METRE_COST", "use.quantity = depth * METRE_COST"),
        ("Task::Report {", "Task::Reprot {"),
        ("Modem modem = new Modem(External);", "Modem modem = new Modem(External)"),
        ("new Sky(Observe);", "new Sky(Observed);"),
        ("// Data go out while", "Data go out while"),
        ("contains(Hull.Climb climb);", "contains(Hull.Climb, climb);"),
    ],
}

IN_A_MISSION = [
    ('"skipper.nddl"', '"skiper.nddl"'),
    ("latency = 3", "latencey = 3"),
    ('internal = ["voyage"]', 'internal = ["voyages"]'),
    ('predicate = "Trip"', 'predicate = "Trp"'),
    ('way = "up"', 'way = "upp"'),
    ('mode = "intra"', 'mode = "intro"'),
    ("[parameters.WEED]", "[parameters.WED]"),
    ('external = ["barge", "lock"]', 'external = ["bargee", "lock"]'),
    ("laden = true", "ladden = true"),
]

SOLVER = """\
name = "survey"
[[filter]]
component = "HorizonFilter"
policy = "PossiblyContained"
[[manager]]
component = "ThreatManager"
[[manager]]
component = "OpenConditionManager"
default_priority = 3
[[manager.handler]]
component = "HSTSOpenConditionDecisionPoint"
choice = "mergeFirst"
order = ["early", "late"]
predicate = "Run"
guards = { n = 3 }
"""
IN_A_SOLVER = [
    ('name = "survey"', 'nmae = "survey"'),
    ("HorizonFilter", "HorizonFiltr"),
    ("PossiblyContained", "PossiblyContaind"),
    ("policy", "polcy"),
    ("ThreatManager", "ThreatManger"),
    ('component = "ThreatManager"', 'componnt = "ThreatManager"'),
    ("default_priority", "default_prority"),
    ("[[manager.handler]]", "[[manager.handlr]]"),
    ("HSTSOpenConditionDecisionPoint", "HSTSOpenConditionDecisonPoint"),
    ("choice", "chioce"),
    ("mergeFirst", "mergFirst"),
    ('"late"', '"latte"'),
    ("predicate", "predicat"),
    ("guards", "gaurds"),
]


def test_misspelt_words_of_a_mission_file_are_mended_by_quick_fixes_only(client: Any, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "tests" / "checker" / "unseen" / "canal", tmp_path / "canal")
    path = tmp_path / "canal" / "mission.toml"
    mend_each(client, path, path.read_text(), IN_A_MISSION)


def test_misspelt_words_of_a_solver_are_mended_by_quick_fixes_only(client: Any, tmp_path: Path) -> None:
    mend_each(client, tmp_path / "solver.toml", SOLVER, IN_A_SOLVER)


def mend_each(client: Any, path: Path, right: str, mistakes: list[tuple[str, str]]) -> None:
    """Make one mistake after the other in a right text: what is told first has the one fix that makes it right."""
    uri = path.as_uri()
    client.start(folder=path.parent)
    client.open(uri, right)
    for mistake in mistakes:
        text = broken(right, mistake)
        (told, *_) = client.change(uri, {"text": text})["diagnostics"]
        actions = client.ask(
            "textDocument/codeAction", textDocument={"uri": uri}, range=told["range"], context={"diagnostics": [told]}
        )
        assert [mended(text, each["edit"]["changes"][uri]) for each in actions] == [right], mistake


def test_all_misspelt_keys_of_a_mission_file_are_mended_at_once(client: Any, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "tests" / "checker" / "unseen" / "canal", tmp_path / "canal")
    path = tmp_path / "canal" / "mission.toml"
    right = path.read_text()
    text = broken(right, *(("final_tick", "final_tik"), ("\nexternal = ", "\nexternl = ")))
    uri = path.as_uri()
    client.start(folder=path.parent)
    client.open(uri, text)
    (action,) = client.ask(
        "textDocument/codeAction",
        textDocument={"uri": uri},
        range={"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 0}},
        context={"diagnostics": [], "only": ["source.fixAll"]},
    )
    edit = action.get("edit") or client.ask("codeAction/resolve", **action)["edit"]
    assert mended(text, edit["changes"][uri]) == right


@pytest.mark.parametrize("name", UNSEEN)
def test_mistakes_in_a_model_of_many_files_are_mended_by_quick_fixes_only(
    client: Any, tmp_path: Path, name: str
) -> None:
    folder = name.partition("/")[0]
    shutil.copytree(ROOT / "tests" / "checker" / "unseen" / folder, tmp_path / folder)
    path = tmp_path / name
    mend(client, path, path.read_text(), UNSEEN[name])


@pytest.mark.parametrize("name", MODELS)
def test_five_mistakes_are_mended_by_quick_fixes_only(client: Any, tmp_path: Path, name: str) -> None:
    right, *mistakes = MODELS[name]
    mend(client, tmp_path / "model.nddl", right, mistakes)


def mend(client: Any, path: Path, right: str, mistakes: list[tuple[str, ...]]) -> None:
    """Take the first fix of the first error, again and again, until the text is as it was."""
    text = broken(right, *mistakes)
    client.start(folder=path.parent)
    uri = path.as_uri()
    told = client.open(uri, text)["diagnostics"]
    fixes = 0
    while errors := [each for each in told if each["severity"] == ERROR]:
        fixes += 1
        assert fixes <= 2 * len(mistakes), errors
        # What cannot be mended yet, for it rests on another mistake, waits for that.
        found = (
            client.ask(
                "textDocument/codeAction",
                textDocument={"uri": uri},
                range=error["range"],
                context={"diagnostics": [error], "only": ["quickfix"]},
            )
            for error in errors
        )
        actions = next(filter(None, found), None)
        assert actions, errors[0]
        first = next((each for each in actions if each.get("isPreferred")), actions[0])
        text = mended(text, first["edit"]["changes"][uri])
        told = client.change(uri, {"text": text})["diagnostics"]
    assert text == broken(right, *mistakes, form=-1)
    assert fixes == sum(mistake[0] != mistake[1] for mistake in mistakes)
    assert client.leave() == 0


def mended(text: str, edits: list[Any]) -> str:
    """The text after an action; it stands in ASCII, so units are characters."""
    lines = text.split("\n")

    def offset(place: dict[str, int]) -> int:
        return sum(len(line) + 1 for line in lines[: place["line"]]) + place["character"]

    for edit in sorted(edits, key=lambda each: offset(each["range"]["start"]), reverse=True):
        begin, end = (offset(edit["range"][side]) for side in ("start", "end"))
        text = text[:begin] + edit["newText"] + text[end:]
    return text
