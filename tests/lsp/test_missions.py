"""Mission files in the editor: what is wrong, what may be written, and the way into the model."""

import re
from pathlib import Path
from typing import Any

import pytest

from lsp.mission_texts import place_at
from tests.lsp.test_quick_fixes import mended

MODEL = """\
/// Seconds per hit.
float GPS_HIT_RATE = [0.1 4.0];
enum Level { low, high } class Gps extends Timeline { predicate Idle { } predicate Busy { int hits; Level level; } }
Gps gps = new Gps();
Gps::Busy { float rate; rate == sampledParameter(GPS_HIT_RATE); duration >= 3; }
"""
MISSION = """\
[mission]
name = "one"
final_tick = 60

[[reactor]]
name = "all"
model = "model.nddl"
lookahead = 60
internal = ["gps"]

[[goal]]
timeline = "gps"
predicate = "Busy"
start = [5, 10]
[goal.parameters]
hits = 3
level = "low"

[parameters.GPS_HIT_RATE]
range = [0.5, 1.0]
"""


@pytest.fixture
def opened(client: Any, tmp_path: Path) -> tuple[Any, str, str]:
    (tmp_path / "model.nddl").write_text(MODEL)
    (tmp_path / "mission.toml").write_text(MISSION)
    client.start(folder=tmp_path)
    uri = (tmp_path / "mission.toml").as_uri()
    assert client.open(uri, MISSION)["diagnostics"] == []
    return client, uri, (tmp_path / "model.nddl").as_uri()


def place_of(text: str, mark: str) -> tuple[int, int]:
    """The line and column behind `mark`."""
    before = text[: text.index(mark) + len(mark)]
    return before.count("\n"), len(before.rpartition("\n")[2])


@pytest.mark.parametrize(
    ("right", "wrong", "word"),
    [
        ('"Busy"', '"Bussy"', "Bussy"),
        ("final_tick", "finaltick", "finaltick"),
        ('internal = ["gps"]', 'internal = ["gqs"]', "gps"),
        ("hits = 3", "hitz = 3", "hitz"),
        ("GPS_HIT_RATE]", "GPS_RATE]", "GPS_RATE"),
        ("final_tick = 60", "final_tick = ", "final_tick"),
    ],
)
def test_what_is_wrong_is_told_while_typing(opened: Any, right: str, wrong: str, word: str) -> None:
    client, uri, _ = opened
    text = MISSION.replace(right, wrong)
    told = client.change(uri, {"text": text})["diagnostics"]
    assert told
    lines = text.split("\n")
    assert any(word in lines[each["range"]["start"]["line"]] for each in told)
    assert all(each["code"].startswith("NDDL7") for each in told)
    assert client.change(uri, {"text": MISSION})["diagnostics"] == []


@pytest.mark.parametrize(
    ("mark", "line"),
    [
        ('internal = ["g', 3),
        ('timeline = "g', 3),
        ('predicate = "Bu', 2),
        ("[goal.parameters]\nhi", 2),
        ("[parameters.GPS_HIT", 1),
    ],
)
def test_names_lead_into_the_model(opened: Any, mark: str, line: int) -> None:
    client, uri, model = opened
    found = client.ask_at("definition", uri, *place_of(MISSION, mark))
    assert (found["uri"], found["range"]["start"]["line"]) == (model, line)


def test_the_name_of_a_model_leads_to_it(opened: Any) -> None:
    client, uri, model = opened
    assert client.ask_at("definition", uri, *place_of(MISSION, 'model = "mod'))["uri"] == model
    assert client.ask_at("definition", uri, *place_of(MISSION, 'name = "o')) is None


def test_hover_tells_what_keys_and_names_mean(opened: Any) -> None:
    client, uri, _ = opened
    assert "Ticks it plans ahead" in client.hover(uri, *place_of(MISSION, "lookah"))
    assert "The agent must get this far" in client.hover(uri, *place_of(MISSION, "final_t"))
    assert "predicate Gps.Busy" in client.hover(uri, *place_of(MISSION, 'predicate = "Bu'))
    assert "Seconds per hit." in client.hover(uri, *place_of(MISSION, "[parameters.GPS_H"))


@pytest.mark.parametrize(
    ("right", "typed", "expected"),
    [
        ('predicate = "Busy"', 'predicate = "', {"Busy", "Idle"}),
        ('timeline = "gps"', 'timeline = "', {"gps"}),
        ('model = "model.nddl"', 'model = "', {"model.nddl"}),
        ("hits = 3", "h", {"hits"}),
        ('level = "low"', 'level = "', {"low", "high"}),
        ("[parameters.GPS_HIT_RATE]", "[parameters.", {"GPS_HIT_RATE"}),
        ("lookahead = 60", "la", {"latency", "lookahead", "internal", "solver"}),
        ("final_tick = 60", 'on_failure = "', {"abort_agent", "kill_reactor"}),
        ("[mission]", "[", {"mission", "check", "parameters", "reactor"}),
    ],
)
def test_what_may_be_written_is_offered(opened: Any, right: str, typed: str, expected: set[str]) -> None:
    client, uri, _ = opened
    text = MISSION.replace(right, typed)
    client.change(uri, {"text": text})
    begin = MISSION.index(right) + len(typed)
    line, column = text[:begin].count("\n"), len(text[:begin].rpartition("\n")[2])
    found = client.ask_at("completion", uri, line, column)
    items = found["items"] if isinstance(found, dict) else found
    assert expected <= {each["label"] for each in items}


def test_a_change_of_the_model_is_told_once_it_is_saved(opened: Any, tmp_path: Path) -> None:
    client, uri, _ = opened
    (tmp_path / "model.nddl").write_text(MODEL.replace("predicate Idle", "predicate Rest").replace("Busy", "Idle"))
    client.notify("workspace/didChangeWatchedFiles", changes=[])
    assert [each["code"] for each in client.complaints(uri)["diagnostics"]] != []
    client.notify("textDocument/didClose", textDocument={"uri": uri})
    assert client.complaints(uri)["diagnostics"] == []


def test_a_workspace_runs_nothing_by_being_opened(client: Any, tmp_path: Path) -> None:
    (tmp_path / "model.nddl").write_text(MODEL)
    (tmp_path / "evil.py").write_text(f"open({str(tmp_path / 'ran')!r}, 'w').close()\n")
    client.start(folder=tmp_path)
    text = MISSION + '[constraints]\nmodules = ["evil.py"]\n'
    assert client.open((tmp_path / "mission.toml").as_uri(), text)["diagnostics"] == []
    assert not (tmp_path / "ran").exists()


def test_another_toml_file_is_left_alone(client: Any, tmp_path: Path) -> None:
    client.start(folder=tmp_path)
    uri = (tmp_path / "Cargo.toml").as_uri()
    item = {"uri": uri, "languageId": "toml", "version": 1, "text": "[package\n"}
    client.notify("textDocument/didOpen", textDocument=item)
    assert client.open("untitled:a", "int a;")["diagnostics"] == []
    assert client.hover(uri, 0, 2) is None


@pytest.mark.parametrize("text", ["", "[", "a", "= ", '"', "[[", "x = [\n1,\n", '[a."b', "\n\n]", "a = '''\n"])
def test_a_place_is_found_in_any_text(text: str) -> None:
    for offset in range(len(text) + 1):
        place = place_at(text, offset)
        assert 0 <= place.begin <= place.finish <= len(text)


SHAPED = """\
# Two legs
# of a survey.
[mission]
name = "survey"

[[reactor]]
name = "planner"
model = "model.nddl"  # not "other.nddl"
internal = [
  "gps",  # [
]
[reactor.early]
a = 1
[[goal]]
timeline = "gps"
predicate = "Busy"
[goal.parameters]
hits = 3

# The end.
[constraints]
modules = ["own.py", "gone.py"]
"""


def test_the_shape_of_a_mission_file_is_shown(opened: Any, tmp_path: Path) -> None:
    client, uri, model = opened
    (tmp_path / "own.py").touch()
    client.change(uri, {"text": SHAPED.replace("\n", "\r\n")})
    about = {"textDocument": {"uri": uri}}

    def shown(symbols: list[Any]) -> list[Any]:
        return [
            (each["name"], place["start"]["line"], *place["end"].values(), shown(each.get("children", [])))
            for each in symbols
            for place in (each["range"],)
        ]

    assert shown(client.ask("textDocument/documentSymbol", **about)) == [
        ("mission survey", 2, 3, 15, []),
        ("reactor planner", 5, 12, 5, [("reactor.early", 11, 12, 5, [])]),
        ("goal gps.Busy", 13, 17, 8, [("goal.parameters", 16, 17, 8, [])]),
        ("constraints", 20, 21, 31, []),
    ]
    folds = [(each["startLine"], each["endLine"]) for each in client.ask("textDocument/foldingRange", **about)]
    assert folds == [(0, 1), (2, 3), (5, 10), (8, 10), (11, 12), (13, 15), (16, 17), (20, 21)]
    links = [(each["range"]["start"], each["target"]) for each in client.ask("textDocument/documentLink", **about)]
    own = (tmp_path / "own.py").as_uri()
    assert links == [({"line": 7, "character": 9}, model), ({"line": 21, "character": 12}, own)]


def test_lenses_offer_to_fly_missions(opened: Any) -> None:
    client, uri, _ = opened
    found = client.ask("textDocument/codeLens", textDocument={"uri": uri})
    shown = [(each["range"]["start"]["line"], each["command"]["title"]) for each in found]
    titles = ["run 100 missions", "run all missions", "explain last failure", "certify"]
    assert shown == [(0, title) for title in titles]
    assert found[0]["command"]["arguments"] == [uri, 100]
    # Of a reactor in Python nothing is proved.
    client.change(uri, {"text": '[mission]\n[[reactor]]\ncode = "helm.py:Helm"\n'})
    found = client.ask("textDocument/codeLens", textDocument={"uri": uri})
    assert [each["command"]["title"] for each in found] == titles[:3]


def test_the_configuration_of_a_solver_is_judged_too(client: Any, tmp_path: Path) -> None:
    client.start(folder=tmp_path)
    uri = (tmp_path / "solver.toml").as_uri()
    told = client.open(uri, "[[nonsense]]\nx = 3\n")["diagnostics"]
    assert told
    assert all(each["code"].startswith("NDDL") for each in told)


def test_a_configuration_is_judged_as_it_is_typed(client: Any, tmp_path: Path) -> None:
    client.start(folder=tmp_path)
    uri = (tmp_path / "nddlc.toml").as_uri()
    assert client.open(uri, "")["diagnostics"] == []
    told = client.change(uri, {"text": 'ignroe = ["NDDL501"]\n'})["diagnostics"]
    assert [each["code"] for each in told] == ["NDDL596"]
    assert client.open((tmp_path / "pyproject.toml").as_uri(), '[project]\nname = "x"\n')["diagnostics"] == []


def test_what_a_project_leaves_out_is_left_out_of_mission_files_too(client: Any, tmp_path: Path) -> None:
    (tmp_path / "nddlc.toml").write_text('ignore = ["NDDL758"]\n')
    client.start(folder=tmp_path)
    told = client.open((tmp_path / "solver.toml").as_uri(), "[nonsense]\nx = 3\n")["diagnostics"]
    assert "NDDL758" not in [each["code"] for each in told]


@pytest.mark.parametrize(
    ("mark", "name", "renamed"),
    [
        (
            "Gps gp",
            "receiver",
            ('internal = ["gps"]', 'timeline = "gps"', "Gps gps", 'path = "gps"', 'samples = "gps.Busy"'),
        ),
        ("predicate Bus", "Active", ("predicate Busy", "Gps::Busy", 'predicate = "Busy"', ".Busy")),
        ("int hit", "count", ("int hits", "hits = 3")),
        ("float GPS_HIT_RAT", "RATE", ("float GPS_HIT_RATE", "(GPS_HIT_RATE)", "[parameters.GPS_HIT_RATE]")),
    ],
)
def test_a_rename_reaches_mission_files(
    opened: tuple[Any, str, str], tmp_path: Path, mark: str, name: str, renamed: tuple[str, ...]
) -> None:
    client, uri, model = opened
    mission = MISSION + '\n[figures]\npath = "gps"\nsamples = "gps.Busy"\n'
    client.change(uri, {"text": mission})
    # One that is closed, beside one of another model in which the names are the same.
    (tmp_path / "other.toml").write_text(mission)
    (tmp_path / "apart").mkdir()
    (tmp_path / "apart" / "model.nddl").write_text(MODEL)
    (tmp_path / "apart" / "mission.toml").write_text(mission)
    client.open(model, MODEL)
    line, character = place_of(MODEL, mark)
    changes = client.ask_at("rename", model, line, character, newName=name)["changes"]
    assert set(changes) == {model, uri, uri.replace("mission.toml", "other.toml")}
    old = re.search(r"\w+$", renamed[0].strip('"]'))
    assert old is not None
    for each, text in (model, MODEL), (uri, mission):
        expected = text
        for part in renamed:
            expected = expected.replace(part, re.sub(rf"\b{old[0]}\b", name, part))
        assert mended(text, changes[each]) == expected
    # The same from the mission file.
    line, character = place_of(mission, next(part for part in renamed if part in mission).rstrip('"]= 3'))
    found = client.ask_at("references", uri, line, character, context={"includeDeclaration": True})
    assert len(found) == sum(map(len, changes.values()))
    assert client.ask_at("prepareRename", uri, line, character)["placeholder"] == old[0]
    assert client.ask_at("rename", uri, line, character, newName=name)["changes"] == changes


def test_a_closed_mission_file_is_read_again_once_it_has_changed(opened: tuple[Any, str, str], tmp_path: Path) -> None:
    client, _, model = opened
    client.open(model, MODEL)
    line, character = place_of(MODEL, "int hit")
    counts = []
    for text in (MISSION, MISSION.replace("hits", "hit"), MISSION):
        (tmp_path / "other.toml").write_text(text)
        found = client.ask_at("references", model, line, character, context={"includeDeclaration": True})
        counts.append(sum(place["uri"].endswith("other.toml") for place in found))
    assert counts == [1, 0, 1]


AGENT = """<?xml version="1.0"?>
<Agent name="one" finalTick="60">
  <EuropaReactor name="all" latency="0" lookahead="60" model="model.nddl"><Internal name="gps"/></EuropaReactor>
  <Goal on="gps" pred="Busy"><Variable name="start"><int min="5" max="10"/></Variable></Goal>
</Agent>
"""


def test_an_agent_file_is_told_of_as_a_mission_file_is(client: Any, tmp_path: Path) -> None:
    (tmp_path / "model.nddl").write_text(MODEL)
    client.start(folder=tmp_path)
    uri = (tmp_path / "agent.xml").as_uri()
    told = client.open(uri, AGENT.replace('on="gps" pred="Busy"', 'on="gps" pred="Bussy"'))["diagnostics"]
    assert [(each["code"], each["range"]["start"]["line"]) for each in told] == [("NDDL717", 3)]
    assert client.ask_at("hover", uri, 3, 10) is None
