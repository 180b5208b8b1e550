"""Sessions as Visual Studio Code, Neovim and Emacs begin them: each answer is what the specification says it is."""

from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types
from lsprotocol.converters import get_converter

from tests.lsp.profiles import PROFILES

MODEL = """\
#include "part.nddl"
int LIMIT = 5;
Gps gps = new Gps();
Gps::Busy {
  load <= LIMIT;
  met_by(Idle before_it);
}
goal(gps.Busy one);
int wrong = 3.0;
class Other extends Timeline { predicate p { } }
"""
PART = "class Gps extends Timeline { predicate Idle { } predicate Busy { int load; } }\n"
POSITION = {"line": 5, "character": 10}
RANGE = {"start": {"line": 0, "character": 0}, "end": {"line": 8, "character": 16}}
QUESTIONS: list[tuple[str, dict[str, Any]]] = [
    ("hover", {"position": POSITION}),
    ("definition", {"position": POSITION}),
    ("declaration", {"position": POSITION}),
    ("typeDefinition", {"position": {"line": 2, "character": 5}}),
    ("implementation", {"position": {"line": 3, "character": 6}}),
    ("references", {"position": POSITION, "context": {"includeDeclaration": True}}),
    ("documentHighlight", {"position": POSITION}),
    ("prepareRename", {"position": POSITION}),
    ("rename", {"position": POSITION, "newName": "Calm"}),
    ("completion", {"position": {"line": 4, "character": 3}}),
    ("signatureHelp", {"position": {"line": 2, "character": 18}}),
    ("documentSymbol", {}),
    ("foldingRange", {}),
    ("selectionRange", {"positions": [POSITION]}),
    ("documentLink", {}),
    ("inlayHint", {"range": RANGE}),
    ("codeLens", {}),
    ("codeAction", {"range": RANGE, "context": {"diagnostics": []}}),
    ("formatting", {"options": {"tabSize": 2, "insertSpaces": True}}),
    ("rangeFormatting", {"range": RANGE, "options": {"tabSize": 2, "insertSpaces": True}}),
    ("onTypeFormatting", {"position": POSITION, "ch": ";", "options": {"tabSize": 2, "insertSpaces": True}}),
    ("semanticTokens/full", {}),
    ("semanticTokens/full/delta", {"previousResultId": "1"}),
    ("semanticTokens/range", {"range": RANGE}),
    ("diagnostic", {}),
    ("prepareCallHierarchy", {"position": POSITION}),
    ("prepareTypeHierarchy", {"position": {"line": 2, "character": 1}}),
]


@pytest.mark.parametrize("name", PROFILES)
def test_each_answer_is_as_the_specification_says(make_wire: Any, tmp_path: Path, name: str) -> None:
    (tmp_path / "part.nddl").write_text(PART)
    uri = (tmp_path / "model.nddl").as_uri()
    converter = get_converter()
    wire = make_wire()
    answer = wire.ask("initialize", processId=None, rootUri=tmp_path.as_uri(), capabilities=PROFILES[name], trace="off")
    offered = converter.structure(answer, types.InitializeResponse).result.capabilities
    wire.tell("initialized")
    item = {"uri": uri, "languageId": "nddl", "version": 1, "text": MODEL}
    said = wire.tell("textDocument/didOpen", textDocument=item)
    pushed = [each["params"] for each in said if each["method"] == "textDocument/publishDiagnostics"]
    # Who asks for diagnostics gets none unasked.
    assert bool(pushed) is (name != "vscode")
    for each in pushed:
        converter.structure(each, types.PublishDiagnosticsParams)
    assert offered.position_encoding == {"emacs": "utf-32"}.get(name, "utf-16")
    for method, params in QUESTIONS:
        answer = wire.ask(f"textDocument/{method}", textDocument={"uri": uri}, **params)
        assert "error" not in answer, (method, answer)
        kind = types.METHOD_TO_TYPES[f"textDocument/{method}"][1]
        assert kind is not None
        result: Any = converter.structure(answer, kind).result
        assert result or method in ("formatting", "rangeFormatting", "onTypeFormatting", "signatureHelp"), method
