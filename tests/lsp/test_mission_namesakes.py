"""Rename of what several models of a mission call alike: reactors know timelines, predicates and parameters by name."""

import re
import shutil
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from checker.models import examine
from nddl_lang.text.read import read_source
from tests.lsp.test_missions import place_of
from tests.lsp.test_quick_fixes import mended

UNSEEN = Path(__file__).resolve().parents[1] / "checker" / "unseen"
DECLARED = re.compile(r"^(?:\w+ (\w+)(?= = new)|    predicate (\w+)|(?:int|float) (\w+))", re.MULTILINE)
BOSS = """\
class Lamp extends Timeline { predicate Dark { } predicate Lit { int level; } }
float LIMIT = 3.0;
Lamp lamp = new Lamp();
goal(lamp.Lit once);
once.level == 3;
once.duration <= LIMIT;
"""
WORLD = """\
class Lamp extends Timeline { predicate Dark { } predicate Lit { int level; } }
float LIMIT = 9.0;
Lamp lamp = new Lamp();
Lamp::Lit { duration <= LIMIT; level <= 5; }
"""
MISSION = """\
[mission]
name = "two"
final_tick = 60

[[reactor]]
name = "boss"
model = "boss.nddl"
lookahead = 60
external = ["lamp"]

[[reactor]]
name = "world"
model = "world.nddl"
lookahead = 1
internal = ["lamp"]
"""


@pytest.mark.parametrize(
    ("mark", "counts"),
    [
        ("Lamp lam", {"boss.nddl": 2, "world.nddl": 1, "mission.toml": 2}),
        ("predicate Li", {"boss.nddl": 2, "world.nddl": 2}),
        ("int leve", {"boss.nddl": 2, "world.nddl": 2}),
        ("float LIMI", {"boss.nddl": 2}),
        ("class Lam", {"boss.nddl": 3}),
    ],
)
def test_a_rename_takes_along_what_a_mission_knows_by_the_same_name(
    client: Any, tmp_path: Path, mark: str, counts: dict[str, int]
) -> None:
    for name, text in ("boss.nddl", BOSS), ("world.nddl", WORLD), ("mission.toml", MISSION):
        (tmp_path / name).write_text(text)
    client.start(folder=tmp_path)
    uri = (tmp_path / "boss.nddl").as_uri()
    client.open(uri, BOSS)
    place = place_of(BOSS, mark)
    changes = client.ask_at("rename", uri, *place, newName="fresh")["changes"]
    assert {each.rpartition("/")[2]: len(edits) for each, edits in changes.items()} == counts
    found = client.ask_at("references", uri, *place, context={"includeDeclaration": True})
    assert Counter(each["uri"].rpartition("/")[2] for each in found) == counts


@pytest.mark.parametrize("name", ["tunnel", "hospital"])
def test_a_mission_of_many_models_is_as_sound_after_any_rename(client: Any, tmp_path: Path, name: str) -> None:
    folder = tmp_path / name
    shutil.copytree(UNSEEN / name, folder)
    mission = folder / "mission.toml"
    sound = Counter(each.code.id for each in examine(read_source(mission), folder))
    texts = {path.as_uri(): path.read_text() for path in sorted(folder.iterdir())}
    client.start(folder=folder)
    tried = 0
    for uri, text in texts.items():
        if not uri.endswith(".nddl"):
            continue
        client.open(uri, text)
        for found in DECLARED.finditer(text):
            end = found.end()
            line, character = text.count("\n", 0, end), end - text.rfind("\n", 0, end) - 2
            edit = client.ask_at("rename", uri, line, character, newName="zzFresh9")
            assert "changes" in edit, (found[0], edit)
            for each, edits in edit["changes"].items():
                Path(each.removeprefix("file://")).write_text(mended(texts[each], edits))
            assert Counter(each.code.id for each in examine(read_source(mission), folder)) == sound, found[0]
            for each in edit["changes"]:
                Path(each.removeprefix("file://")).write_text(texts[each])
            tried += 1
    assert tried > 20


def test_calls_are_followed_from_model_to_model(client: Any, tmp_path: Path) -> None:
    folder = tmp_path / "tunnel"
    shutil.copytree(UNSEEN / "tunnel", folder)
    client.start(folder=folder)
    uri = (folder / "rings.nddl").as_uri()
    text = (folder / "rings.nddl").read_text()
    client.open(uri, text)
    (item,) = client.ask_at("prepareCallHierarchy", uri, *place_of(text, "predicate Buil"))
    (call,) = client.ask("callHierarchy/incomingCalls", item=item)
    assert (call["from"]["name"], call["from"]["uri"]) == ("Section", (folder / "engineer.nddl").as_uri())
    asking = (folder / "engineer.nddl").read_text().split("\n")
    for each in call["fromRanges"]:  # in the file of the rule
        assert asking[each["start"]["line"]][each["start"]["character"] : each["end"]["character"]] == "Build"
    asked = client.ask("callHierarchy/outgoingCalls", item=item)
    assert [each["to"]["name"] for each in asked] == ["Push", "Loading", "Place", "Inject"]
    assert [each["fromRanges"] for each in asked] == [[]] * 4  # none of them in the file of the predicate
    (call,) = client.ask("callHierarchy/incomingCalls", item=asked[0]["to"])
    rule = (folder / "pilot.nddl").read_text().split("\n")[call["from"]["selectionRange"]["start"]["line"]]
    assert rule == "Ring::Build {"
    asked = client.ask("callHierarchy/outgoingCalls", item=call["from"])
    assert [len(each["fromRanges"]) for each in asked] == [1, 1, 1, 1]


def test_a_lens_counts_what_its_list_shows_in_all_models_and_missions(client: Any, tmp_path: Path) -> None:
    folder = tmp_path / "canal"
    shutil.copytree(UNSEEN / "canal", folder)
    client.start(folder=folder)
    uri = (folder / "canal.nddl").as_uri()
    client.open(uri, (folder / "canal.nddl").read_text())
    counted = []
    for lens in client.ask("textDocument/codeLens", textDocument={"uri": uri}):
        command = client.ask("codeLens/resolve", **lens)["command"]
        _, place = command["arguments"]
        asked = "implementation" if command["title"].endswith(("rule", "rules")) else "references"
        options = {"context": {"includeDeclaration": False}} if asked == "references" else {}
        found = client.ask_at(asked, uri, place["line"], place["character"], **options)
        assert int(command["title"].split()[0]) == len(found), command
        counted.append((place["line"], asked, len(found)))
    assert (28, "implementation", 1) in counted  # keeper.nddl has the rule on Lockage
    assert (28, "references", 2) in counted  # which skipper.nddl asks for
    assert (6, "references", 1) in counted  # Moored, the default of barges


def test_a_class_that_another_model_extends_is_found(client: Any, tmp_path: Path) -> None:
    (tmp_path / "base.nddl").write_text("class Lamp extends Timeline { predicate Lit { } }\n")
    for name in "Red", "Green":
        text = f'#include "base.nddl"\nclass {name} extends Lamp {{ }}\n{name} lamp = new {name}();\n'
        (tmp_path / f"{name}.nddl").write_text(text)
    client.start(folder=tmp_path)
    uri = (tmp_path / "Red.nddl").as_uri()
    client.open(uri, (tmp_path / "Red.nddl").read_text())
    (item,) = client.ask_at("prepareTypeHierarchy", uri, 1, 20)
    below = client.ask("typeHierarchy/subtypes", item=item)
    assert sorted(each["name"] for each in below) == ["Green", "Red"]
    found = client.ask_at("implementation", uri, 1, 20)
    assert sorted(each["uri"].rpartition("/")[2] for each in found) == ["Green.nddl", "Red.nddl"]
