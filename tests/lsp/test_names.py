"""References, rename, navigation and hierarchies, asked by a real client of a real server."""

from pathlib import Path
from typing import Any

import pytest

BASE = """\
enum Mode { Slow, Fast }
class Part { int size; Part(int s) { size = s; } }
class Vehicle extends Timeline {
  Part part;
  Vehicle() { part = new Part(3); }
  predicate Idle { }
  predicate Run { int speed; Mode mode; }
}
"""
MODEL = """\
#include "base.nddl"
class Glider extends Vehicle {
  predicate Run { int depth; }
}
int LIMIT = 5;
Glider glider = new Glider();
Vehicle::Run {
  speed <= LIMIT;
  mode == Fast;
  met_by(Idle before_it);
  before_it.duration >= 2;
}
Glider::Run {
  int speedy = 4;
  speed < speedy;
  object.part.size > 1;
}
goal(glider.Run first);
first.start.specify(3);
"""
OTHER = '#include "base.nddl"\nVehicle v = new Vehicle();\nVehicle::Run { meets(Idle); }\n'


@pytest.fixture
def opened(client: Any, tmp_path: Path) -> tuple[Any, str, str, str]:
    """A client that has opened a model; its URI, that of a part, and that of another model, which is closed."""
    for name, text in (("base", BASE), ("model", MODEL), ("other", OTHER)):
        (tmp_path / f"{name}.nddl").write_text(text)
    client.start(folder=tmp_path)
    uri, base, other = ((tmp_path / f"{name}.nddl").as_uri() for name in ("model", "base", "other"))
    assert [each["code"] for each in client.open(uri, MODEL)["diagnostics"] if each["severity"] == 1] == []
    return client, uri, base, other


def places(found: list[dict[str, Any]]) -> list[tuple[str, int, int]]:
    return [
        (each["uri"].rpartition("/")[2], each["range"]["start"]["line"], each["range"]["start"]["character"])
        for each in found
    ]


def test_references_reach_included_files_and_closed_models(opened: Any) -> None:
    client, uri, _, _ = opened
    found = client.ask_at("references", uri, 6, 9, context={"includeDeclaration": True})
    assert places(found) == [
        ("base.nddl", 6, 12),
        ("model.nddl", 2, 12),
        ("model.nddl", 6, 9),
        ("model.nddl", 12, 8),
        ("model.nddl", 17, 12),
        ("other.nddl", 2, 9),
    ]
    without = client.ask_at("references", uri, 6, 9, context={"includeDeclaration": False})
    assert places(without) == places(found)[2:]
    assert client.ask_at("references", uri, 10, 30, context={"includeDeclaration": True}) == []


def test_a_highlight_tells_reading_from_writing(opened: Any) -> None:
    client, uri, base, _ = opened
    found = client.ask_at("documentHighlight", uri, 7, 12)
    assert [(each["range"]["start"]["line"], each["kind"]) for each in found] == [(4, 3), (7, 2)]
    client.open(base, BASE)
    assert [each["kind"] for each in client.ask_at("documentHighlight", base, 1, 18)] == [3, 3]


def edited(text: str, edits: list[dict[str, Any]]) -> str:
    lines = text.split("\n")
    for edit in sorted(edits, key=lambda each: each["range"]["start"]["character"], reverse=True):
        start, end = edit["range"]["start"], edit["range"]["end"]
        line = lines[start["line"]]
        lines[start["line"]] = line[: start["character"]] + edit["newText"] + line[end["character"] :]
    return "\n".join(lines)


def test_a_rename_edits_all_files_of_all_models(opened: Any) -> None:
    client, uri, base, other = opened
    prepared = client.ask_at("prepareRename", uri, 12, 9)
    assert prepared["placeholder"] == "Run"
    changes = client.ask_at("rename", uri, 12, 9, newName="Sail")["changes"]
    assert set(changes) == {uri, base, other}
    assert edited(BASE, changes[base]) == BASE.replace("Run", "Sail")
    assert edited(MODEL, changes[uri]) == MODEL.replace("Run", "Sail")
    assert edited(OTHER, changes[other]) == OTHER.replace("Run", "Sail")


def test_a_rename_of_a_class_takes_its_constructors_along(opened: Any) -> None:
    client, uri, base, _ = opened
    changes = client.ask_at("rename", uri, 1, 22, newName="Craft")["changes"]
    assert edited(BASE, changes[base]) == BASE.replace("Vehicle", "Craft")
    assert edited(MODEL, changes[uri]) == MODEL.replace("Vehicle", "Craft")


@pytest.mark.parametrize(
    ("line", "character", "name", "old"),
    [
        (13, 6, "quick", "speedy"),
        (8, 10, "Quick", "Fast"),
        (15, 15, "length", "size"),
        (10, 4, "earlier", "before_it"),
        (18, 1, "last", "first"),
    ],
)
def test_a_rename_leaves_names_that_only_look_alike(
    opened: Any, line: int, character: int, name: str, old: str
) -> None:
    client, uri, base, _ = opened
    changes = client.ask_at("rename", uri, line, character, newName=name)["changes"]
    texts = {uri: MODEL, base: BASE}
    renamed = "".join(edited(texts[each], changes.get(each, [])) for each in (uri, base))
    assert renamed == (MODEL + BASE).replace(old, name)


@pytest.mark.parametrize(
    ("line", "character", "name", "reason"),
    [
        (13, 6, "speed", "something else is called `speed`"),
        (13, 6, "class", "a word of the language"),
        (13, 6, "4x", "no name"),
        (4, 5, "glider", "declared"),
        (9, 3, "x", "belongs to the language"),
        (7, 2, "start", "start"),
        (16, 0, "x", "no name"),
    ],
)
def test_a_rename_that_would_change_the_meaning_is_refused(
    opened: Any, line: int, character: int, name: str, reason: str
) -> None:
    client, uri, _, _ = opened
    answer = client.ask_at("rename", uri, line, character, newName=name)
    assert answer["error"]["code"] == -32803
    assert reason in answer["error"]["message"]
    # What was tried has left no trace.
    assert places(client.ask_at("references", uri, 13, 6, context={"includeDeclaration": True})) == [
        ("model.nddl", 13, 6),
        ("model.nddl", 14, 10),
    ]


def test_the_ways_to_what_a_name_means(opened: Any) -> None:
    client, uri, _, _ = opened
    assert places([client.ask_at("definition", uri, 17, 13)]) == [("model.nddl", 2, 12)]
    assert places([client.ask_at("declaration", uri, 17, 13)]) == [("base.nddl", 6, 12)]
    assert places([client.ask_at("typeDefinition", uri, 5, 8)]) == [("model.nddl", 1, 6)]
    assert places([client.ask_at("typeDefinition", uri, 8, 3)]) == [("base.nddl", 0, 5)]
    assert places([client.ask_at("typeDefinition", uri, 18, 2)]) == [("model.nddl", 2, 12)]
    rules = [("model.nddl", 6, 9), ("model.nddl", 12, 8), ("other.nddl", 2, 9)]
    assert places(client.ask_at("implementation", uri, 2, 13)) == rules
    assert places(client.ask_at("implementation", uri, 1, 22)) == [("model.nddl", 1, 6)]


def test_which_rule_asks_for_which_token(opened: Any) -> None:
    client, uri, base, other = opened
    (item,) = client.ask_at("prepareCallHierarchy", uri, 9, 10)
    assert (item["name"], item["detail"], item["uri"]) == ("Idle", "Vehicle", base)
    call, of_closed_model = client.ask("callHierarchy/incomingCalls", item=item)
    assert (of_closed_model["from"]["uri"], of_closed_model["from"]["name"]) == (other, "Run")
    assert (call["from"]["uri"], call["from"]["name"]) == (uri, "Run")
    assert [each["start"]["line"] for each in call["fromRanges"]] == [9]
    (call,) = client.ask("callHierarchy/outgoingCalls", item=call["from"])
    assert call["to"]["name"] == "Idle"
    assert client.ask("callHierarchy/outgoingCalls", item=item) == []


def test_which_class_extends_which(opened: Any) -> None:
    client, uri, _, _ = opened
    (item,) = client.ask_at("prepareTypeHierarchy", uri, 6, 2)
    assert item["name"] == "Vehicle"
    assert [each["name"] for each in client.ask("typeHierarchy/subtypes", item=item)] == ["Glider"]
    (item,) = client.ask("typeHierarchy/subtypes", item=item)
    assert [each["name"] for each in client.ask("typeHierarchy/supertypes", item=item)] == ["Vehicle"]


def test_symbols_of_the_workspace_are_found_by_their_letters(opened: Any) -> None:
    client, _, _, _ = opened
    found = [(each["name"], each.get("containerName")) for each in client.ask("workspace/symbol", query="Ru")]
    assert found == [("Run", "Vehicle")]
    names = [each["name"] for each in client.ask("workspace/symbol", query="spd")]
    assert names == ["speed", "speedy"]


def test_a_call_shows_its_arguments_while_it_is_typed(opened: Any) -> None:
    client, uri, _, _ = opened
    text = MODEL.replace("  speed < speedy;", "  addEq(speed, ")
    client.change(uri, {"text": text})
    shown = client.ask_at("signatureHelp", uri, 14, 15)
    (signature,) = shown["signatures"]
    assert signature["label"].startswith("addEq(")
    assert shown["activeParameter"] == 1
    client.change(uri, {"text": MODEL + "Part p = new Part("})
    shown = client.ask_at("signatureHelp", uri, 19, 18)
    assert [each["label"] for each in shown["signatures"]] == ["Part(int s)"]
    client.change(uri, {"text": MODEL})
    assert client.ask_at("signatureHelp", uri, 14, 3) is None


def completed(client: Any, uri: str, text: str, typed: str) -> list[str]:
    """What is offered behind `typed`, in order."""
    client.change(uri, {"text": text})
    line, character = text[: text.index(typed) + len(typed)].count("\n"), 0
    character = len((text[: text.index(typed)] + typed).rpartition("\n")[2])
    return [each["label"] for each in client.ask_at("completion", uri, line, character)["items"]]


def test_what_is_offered_fits_the_place(opened: Any) -> None:
    client, uri, _, _ = opened
    inside = MODEL.replace("  speed < speedy;", "  HERE\n")
    names = completed(client, uri, inside.replace("HERE", "met_by(I"), "met_by(I")
    assert names[:2] == ["Run", "Idle"] or names[:2] == ["Idle", "Run"]
    assert "addEq" not in names
    assert "met_by" not in names
    names = completed(client, uri, inside.replace("HERE", "mode == F"), "mode == F")
    assert {"Fast", "speed", "LIMIT"} <= set(names)
    assert "met_by" not in names
    names = completed(client, uri, inside.replace("HERE", "Part p = new P"), "new P")
    assert "Part" in names
    assert "Fast" not in names
    names = completed(client, uri, inside.replace("HERE", "// speed s"), "speed s")
    assert names == []
    names = completed(client, uri, MODEL + "class X extends V", "extends V")
    assert "Vehicle" in names
    assert "Fast" not in names


def test_a_chosen_item_is_described(opened: Any) -> None:
    client, uri, _, _ = opened
    found = client.ask_at("completion", uri, 7, 2)["items"]
    item = next(each for each in found if each["label"] == "met_by")
    assert "documentation" not in item
    shown = client.ask("completionItem/resolve", **item)
    assert "met_by" in shown["documentation"]["value"]


def test_rules_come_as_snippets_where_the_editor_can_show_them(start_client: Any) -> None:
    snippets = {"textDocument": {"completion": {"completionItem": {"snippetSupport": True}}}}
    for capabilities, expected in ((snippets, True), ({}, False)):
        client = start_client()
        client.start(capabilities=capabilities)
        client.open("untitled:a", "class C extends Timeline { predicate p { } }\n\n")
        found = client.ask_at("completion", "untitled:a", 1, 0)["items"]
        assert ("C::p" in [each["label"] for each in found]) is expected
        assert any(each.get("insertTextFormat") == 2 for each in found) is expected
        assert client.leave() == 0


def test_the_path_of_an_include_is_completed(opened: Any) -> None:
    client, uri, _, _ = opened
    client.change(uri, {"text": "#include \n" + MODEL})
    found = client.ask_at("completion", uri, 0, 9)["items"]
    assert [each["textEdit"]["newText"] for each in found] == ['"base.nddl"', '"other.nddl"']
    client.change(uri, {"text": '#include "ba\n' + MODEL})
    found = client.ask_at("completion", uri, 0, 12)["items"]
    assert [each["label"] for each in found] == ["base.nddl", "other.nddl"]
    place = {"start": {"line": 0, "character": 10}, "end": {"line": 0, "character": 12}}
    assert found[0]["textEdit"] == {"range": place, "newText": "base.nddl"}
