"""Sessions as recorded clients begin them (VS Code, Neovim, Emacs): nothing that the protocol forbids comes back."""

import asyncio
import sys
import warnings
from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types
from lsprotocol.converters import get_converter
from pytest_lsp import LanguageClient, LspSpecificationWarning, client_capabilities, make_test_lsp_client

from tests.lsp.test_profiles import MODEL, PART, QUESTIONS

ROOT = Path(__file__).resolve().parents[2]
CLIENTS = ("visual-studio-code", "neovim@v0.6", "neovim@v0.7", "neovim@v0.9", "neovim", "emacs")
SECONDS = 60


async def session(name: str, folder: Path) -> dict[str, Any]:
    """Ask all that can be asked; the answers by their methods."""
    client = make_test_lsp_client()
    await client.start_io(sys.executable, "-m", "nddlc.main", "lsp", cwd=ROOT)
    try:
        return await asyncio.wait_for(talk(client, name, folder), SECONDS)
    finally:
        await client.stop()  # type: ignore[no-untyped-call]


async def talk(client: LanguageClient, name: str, folder: Path) -> dict[str, Any]:
    uri = (folder / "model.nddl").as_uri()
    folders = [types.WorkspaceFolder(folder.as_uri(), "folder")]
    begin = types.InitializeParams(client_capabilities(name), root_uri=folder.as_uri(), workspace_folders=folders)
    await client.initialize_session(begin)
    text = begin.capabilities.text_document
    is_pushed = text is not None and text.diagnostic is None  # who asks for diagnostics gets none unasked
    client.text_document_did_open(types.DidOpenTextDocumentParams(types.TextDocumentItem(uri, "nddl", 1, MODEL)))
    answers: dict[str, Any] = {}
    if is_pushed:
        await client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        answers["diagnostics"] = client.diagnostics[uri]
    converter = get_converter()
    for method, params in QUESTIONS:
        kind: Any = types.METHOD_TO_TYPES[f"textDocument/{method}"][2]
        asked = converter.structure({"textDocument": {"uri": uri}, **params}, kind)
        protocol: Any = client.protocol
        answers[method] = await protocol.send_request_async(f"textDocument/{method}", asked)
    items = answers["completion"].items
    answers["resolved"] = [await client.completion_item_resolve_async(item) for item in items]
    edit = types.TextDocumentContentChangeWholeDocument("int a = 3;\n")
    document = types.VersionedTextDocumentIdentifier(2, uri)
    client.text_document_did_change(types.DidChangeTextDocumentParams(document, [edit]))
    if is_pushed:
        await client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
    assert not [each for each in client.log_messages if each.type is types.MessageType.Error]
    await client.shutdown_session()
    return answers


@pytest.mark.parametrize("name", CLIENTS)
def test_a_recorded_client_gets_only_what_it_can_bear(name: str, tmp_path: Path) -> None:
    (tmp_path / "part.nddl").write_text(PART)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", LspSpecificationWarning)
        answers = asyncio.run(session(name, tmp_path))
    assert [str(each.message) for each in caught if issubclass(each.category, LspSpecificationWarning)] == []
    assert [method for method, answer in answers.items() if not answer] == []


def test_an_editor_that_shows_no_markdown_gets_plain_text(make_wire: Any, tmp_path: Path) -> None:
    plain = {"contentFormat": ["plaintext"]}
    none: dict[str, Any] = {}
    wire = make_wire()
    wire.start(
        textDocument={
            "hover": plain,
            "completion": {"completionItem": none},
            "signatureHelp": {"signatureInformation": none},
        }
    )
    (tmp_path / "part.nddl").write_text(PART)
    uri = (tmp_path / "model.nddl").as_uri()
    wire.open(uri, MODEL.replace("met_by(Idle before_it)", "leq(load, LIMIT)"))
    document = {"uri": uri}
    found = wire.ask("textDocument/hover", textDocument=document, position={"line": 4, "character": 3})["result"]
    assert found["contents"]["kind"] == "plaintext"
    assert "load" in found["contents"]["value"]
    assert "`" not in found["contents"]["value"]
    items = wire.ask("textDocument/completion", textDocument=document, position={"line": 4, "character": 3})["result"]
    leq = next(each for each in items["items"] if each["label"] == "leq")
    assert isinstance(wire.ask("completionItem/resolve", **leq)["result"]["documentation"], str)
    found = wire.ask("textDocument/signatureHelp", textDocument=document, position={"line": 5, "character": 7})
    assert all(isinstance(each["documentation"], str) for each in found["result"]["signatures"])
