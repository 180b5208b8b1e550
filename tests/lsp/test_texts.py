"""Tokens, folds, hints, links, lenses, actions, formatting and pulled diagnostics, asked over the wire."""

from pathlib import Path
from typing import Any

import pytest

MODEL = """\
#include "base.nddl"
// Two lines
// of remarks.
typedef int [0 10] Percent;
int LIMIT = 5;
class Gps extends Timeline {
  predicate Idle { }
  predicate Busy { Percent load; }
}
Gps gps = new Gps();
Gps::Busy {
  load <= LIMIT;
  met_by(Idle before_it);
  if (load > 3) {
    duration >= 7;
  }
}
"""
BASE = "class Part { int size; Part(int s) { size = s; } }\n"


@pytest.fixture
def opened(client: Any, tmp_path: Path) -> tuple[Any, str]:
    (tmp_path / "base.nddl").write_text(BASE)
    (tmp_path / "model.nddl").write_text(MODEL)
    resolving = {"textDocument": {"codeAction": {"resolveSupport": {"properties": ["edit"]}}}}
    client.start(folder=tmp_path, capabilities=resolving)
    uri = (tmp_path / "model.nddl").as_uri()
    client.open(uri, MODEL)
    return client, uri


def unpacked(data: list[int], capabilities: Any, text: str) -> list[tuple[str, str, list[str]]]:
    """The words of the text with their types and modifiers."""
    legend = capabilities["semanticTokensProvider"]["legend"]
    lines = text.split("\n")
    found = []
    line = column = 0
    for at in range(0, len(data), 5):
        down, right, length, type_, modifiers = data[at : at + 5]
        line, column = line + down, right + (0 if down else column)
        names = [name for bit, name in enumerate(legend["tokenModifiers"]) if modifiers >> bit & 1]
        found.append((lines[line][column : column + length], legend["tokenTypes"][type_], names))
    return found


def test_each_word_has_its_colour_also_after_an_edit(client: Any) -> None:
    capabilities = client.start()
    uri = "untitled:a"
    client.open(uri, MODEL)
    document = {"uri": uri}
    full = client.ask("textDocument/semanticTokens/full", textDocument=document)
    words = unpacked(full["data"], capabilities, MODEL)
    assert ("// Two lines", "comment", []) in words
    assert ("Percent", "type", ["declaration"]) in words
    assert ("load", "parameter", ["declaration"]) in words
    assert ("load", "parameter", []) in words
    assert ("LIMIT", "variable", ["static"]) in words
    assert ("met_by", "operator", ["defaultLibrary"]) in words
    assert ("before_it", "event", ["declaration"]) in words
    assert ("duration", "property", ["defaultLibrary"]) in words
    assert ("Busy", "method", []) in words
    place = {"start": {"line": 11, "character": 2}, "end": {"line": 11, "character": 6}}
    client.change(uri, {"range": place, "text": "1 + load"})
    delta = client.ask(
        "textDocument/semanticTokens/full/delta", textDocument=document, previousResultId=full["resultId"]
    )
    (edit,) = delta["edits"]
    assert len(edit["data"]) < 40
    data = full["data"]
    data[edit["start"] : edit["start"] + edit["deleteCount"]] = edit["data"]
    assert data == client.ask("textDocument/semanticTokens/full", textDocument=document)["data"]
    part = client.ask(
        "textDocument/semanticTokens/range",
        textDocument=document,
        range={"start": {"line": 9, "character": 0}, "end": {"line": 10, "character": 0}},
    )
    words = unpacked(part["data"], capabilities, MODEL)
    assert [word for word, _, _ in words] == ["Gps", "gps", "new", "Gps"]
    assert client.leave() == 0


def test_blocks_fold_and_selections_grow(opened: Any) -> None:
    client, uri = opened
    document = {"uri": uri}
    found = client.ask("textDocument/foldingRange", textDocument=document)
    folds = [(each["startLine"], each["endLine"], each.get("kind")) for each in found]
    assert folds == [(1, 2, "comment"), (5, 7, None), (10, 15, None), (13, 14, None)]
    (chain,) = client.ask(
        "textDocument/selectionRange", textDocument=document, positions=[{"line": 14, "character": 17}]
    )
    texts = []
    lines = MODEL.split("\n")
    while chain is not None:
        start, end = chain["range"]["start"], chain["range"]["end"]
        texts.append(
            lines[start["line"]][start["character"] : end["character"]]
            if start["line"] == end["line"]
            else (start["line"], end["line"])
        )
        chain = chain.get("parent")
    assert texts[:3] == ["7", "duration >= 7", "duration >= 7;"]
    assert texts[-1] == (0, 17)
    assert texts[-2] == (10, 16)


def test_what_is_unsaid_is_hinted_unless_it_is_not_wanted(opened: Any) -> None:
    client, uri = opened
    document = {"uri": uri}
    whole = {"start": {"line": 0, "character": 0}, "end": {"line": 99, "character": 0}}
    found = client.ask("textDocument/inlayHint", textDocument=document, range=whole)
    hints = {(each["position"]["line"], each["label"]) for each in found}
    assert hints == {
        (7, "∈ [0 10]"),
        (11, "= 5"),
        (12, "// before_it.end == start"),
    }
    client.notify("workspace/didChangeConfiguration", settings={"nddlc": {"inlayHints": {"constants": False}}})
    found = client.ask("textDocument/inlayHint", textDocument=document, range=whole)
    assert (11, "= 5") not in {(each["position"]["line"], each["label"]) for each in found}
    assert (7, "∈ [0 10]") in {(each["position"]["line"], each["label"]) for each in found}


def test_an_include_is_a_link(opened: Any) -> None:
    client, uri = opened
    (link,) = client.ask("textDocument/documentLink", textDocument={"uri": uri})
    assert link["target"] == uri.replace("model", "base")
    assert link["range"] == {"start": {"line": 0, "character": 10}, "end": {"line": 0, "character": 19}}


def test_lenses_count_references_and_rules(opened: Any) -> None:
    client, uri = opened
    found = client.ask("textDocument/codeLens", textDocument={"uri": uri})
    found = [client.ask("codeLens/resolve", **each) for each in found]
    titles = [(each["range"]["start"]["line"], each["command"]["title"]) for each in found]
    assert titles == [
        (5, "3 references"),
        (6, "1 reference"),
        (6, "0 rules"),
        (7, "1 reference"),
        (7, "1 rule"),
    ]
    assert found[0]["command"]["arguments"] == [uri, {"line": 5, "character": 6}]


def actions(client: Any, uri: str, line: int, character: int, *only: str) -> dict[str, Any]:
    place = {"line": line, "character": character}
    context = {"diagnostics": [], **({"only": list(only)} if only else {})}
    found = client.ask(
        "textDocument/codeAction", textDocument={"uri": uri}, range={"start": place, "end": place}, context=context
    )
    return {each["title"]: each for each in found}


def applied(text: str, edits: list[dict[str, Any]]) -> str:
    starts = [0]
    for line in text.split("\n"):
        starts.append(starts[-1] + len(line) + 1)
    stretches = [
        (
            starts[each["range"]["start"]["line"]] + each["range"]["start"]["character"],
            starts[each["range"]["end"]["line"]] + each["range"]["end"]["character"],
            each["newText"],
        )
        for each in edits
    ]
    for begin, finish, new in sorted(stretches, reverse=True):
        text = text[:begin] + new + text[finish:]
    return text


def test_a_number_becomes_a_constant_or_a_parameter(opened: Any) -> None:
    client, uri = opened
    found = actions(client, uri, 14, 17, "refactor")
    assert set(found) == {"make `7` a constant", "make `7` a sampled parameter"}
    text = applied(MODEL, found["make `7` a constant"]["edit"]["changes"][uri])
    assert text == MODEL.replace("Gps::Busy", "int CONSTANT = 7;\nGps::Busy").replace(">= 7", ">= CONSTANT")
    told = client.change(uri, {"text": text})["diagnostics"]
    assert [each["code"] for each in told if each["severity"] == 1] == []
    text = applied(MODEL, found["make `7` a sampled parameter"]["edit"]["changes"][uri])
    assert "int PARAMETER = [7 7];\n" in text
    told = client.change(uri, {"text": text})["diagnostics"]
    assert [each["code"] for each in told if each["severity"] == 1] == []


def test_what_is_missing_is_added(opened: Any) -> None:
    client, uri = opened
    rule = actions(client, uri, 6, 13, "refactor")["add a rule on `Gps::Idle`"]
    text = applied(MODEL, rule["edit"]["changes"][uri])
    assert "}\n\nGps::Idle {\n}\nGps gps" in text
    client.change(uri, {"text": MODEL.replace("met_by(Idle", "met_by(Asleep")})
    added = actions(client, uri, 12, 11, "quickfix")["add `predicate Asleep` to class `Gps`"]
    text = applied(MODEL, added["edit"]["changes"][uri])
    assert "  predicate Asleep { }\n}\nGps gps" in text
    text = MODEL.replace('#include "base.nddl"\n', "") + "Part part = new Part(3);\n"
    client.change(uri, {"text": text})
    line = text.count("\n") - 1
    added = actions(client, uri, line, 1, "quickfix")['include "base.nddl", which declares `Part`']
    text = applied(text, added["edit"]["changes"][uri])
    assert text.count('#include "base.nddl"\n') == 1
    assert [each["code"] for each in client.change(uri, {"text": text})["diagnostics"] if each["severity"] == 1] == []


def test_an_include_is_offered_once(opened: Any, tmp_path: Path) -> None:
    client, uri = opened
    (tmp_path / "base.nddl").write_text(BASE + "enum Mode { Slow, Fast }\n")
    text = MODEL.replace('#include "base.nddl"\n', "") + "Part part = new Part(3);\nMode mode = Slow;\n"
    (error, *_) = client.change(uri, {"text": text})["diagnostics"]
    assert "which is not included" in error["message"]
    titles = actions(client, uri, error["range"]["start"]["line"], error["range"]["start"]["character"], "quickfix")
    assert [each for each in titles if "include" in each] == ['add `#include "base.nddl"` (check the meaning)']


MISTAKES = """\
class C { private int x; C() { x = 1; } }
int y = 3.0;
class Timeline { }
C c = new C();
"""


def test_all_that_is_safe_is_mended_at_once(opened: Any) -> None:
    client, uri = opened
    assert len(client.change(uri, {"text": MISTAKES})["diagnostics"]) >= 2
    action = actions(client, uri, 0, 0, "source.fixAll")["mend all that can be mended safely"]
    assert "edit" not in action
    edit = client.ask("codeAction/resolve", **action)["edit"]
    text = applied(MISTAKES, edit["changes"][uri])
    assert "private" not in text
    assert "3.0" not in text
    told = client.change(uri, {"text": text})["diagnostics"]
    assert [each for each in told if each["severity"] == 1] == []
    assert actions(client, uri, 0, 0, "source.fixAll") == {}


def test_a_range_or_what_was_just_typed_is_formatted(opened: Any) -> None:
    client, uri = opened
    text = "int  a;\nint  b;\nclass C   {\nint x;\n}\n"
    client.change(uri, {"text": text})
    options = {"tabSize": 2, "insertSpaces": True}
    edits = client.ask(
        "textDocument/rangeFormatting",
        textDocument={"uri": uri},
        range={"start": {"line": 1, "character": 0}, "end": {"line": 1, "character": 3}},
        options=options,
    )
    assert applied(text, edits) == text.replace("int  b", "int b")
    edits = client.ask_at("onTypeFormatting", uri, 4, 1, ch="}", options=options)
    assert applied(text, edits) == text.replace("class C   {\nint x", "class C {\n    int x")


def test_diagnostics_are_pulled_by_editors_that_ask(client: Any, tmp_path: Path) -> None:
    (tmp_path / "base.nddl").write_text(BASE.replace("int size", "intt size"))
    client.start(folder=tmp_path, capabilities={"textDocument": {"diagnostic": {}}})
    uri, base = (tmp_path / "model.nddl").as_uri(), (tmp_path / "base.nddl").as_uri()
    item = {"uri": uri, "languageId": "nddl", "version": 1, "text": MODEL}
    client.notify("textDocument/didOpen", textDocument=item)
    report = client.ask("textDocument/diagnostic", textDocument={"uri": uri})
    assert (report["kind"], report["items"]) == ("full", [])
    again = client.ask("textDocument/diagnostic", textDocument={"uri": uri}, previousResultId=report["resultId"])
    assert again["kind"] == "unchanged"
    whole = client.ask("workspace/diagnostic", previousResultIds=[])
    (wrong,) = [each for each in whole["items"] if each["uri"] == base]
    assert "intt" in wrong["items"][0]["message"]
    known = [{"uri": base, "value": wrong["resultId"]}]
    whole = client.ask("workspace/diagnostic", previousResultIds=known)
    assert [each["kind"] for each in whole["items"] if each["uri"] == base] == ["unchanged"]
    change = {"text": MODEL.replace("LIMIT = 5", "LIMITS = 5")}
    client.notify("textDocument/didChange", textDocument={"uri": uri, "version": 2}, contentChanges=[change])
    report = client.ask("textDocument/diagnostic", textDocument={"uri": uri})
    assert "LIMITS" in "".join(each["message"] for each in report["items"])
    client.send(id=99, method="shutdown")
    # Nothing was pushed in all that time.
    seen: list[str] = []

    def is_answer(message: dict[str, Any]) -> bool:
        seen.append(str(message.get("method")))
        return message.get("id") == 99

    client.wait(is_answer)
    assert "textDocument/publishDiagnostics" not in seen
