"""Messages that are wrong in form, order or length: each request is answered, and the session goes on.

`make editor-proof` sends 100,000 of them (`tests/lsp/hostile_proof.py`).
"""

import asyncio
import gc
import json
from concurrent.futures import Future
from pathlib import Path
from typing import Any

import pytest

from tests.lsp.hostile import framed
from tests.lsp.hostile_proof import attack

_INVALID, _NOT_BEGUN, _NO_JSON, _NO_METHOD = -32600, -32002, -32700, -32601
HOVER = {"jsonrpc": "2.0", "method": "textDocument/hover", "params": {}}


def code(said: list[dict[str, Any]], number: Any) -> int:
    (answer,) = [each for each in said if "method" not in each and each["id"] == number]
    return int(answer["error"]["code"])


def sent(wire: Any, *messages: Any) -> list[dict[str, Any]]:
    said: list[dict[str, Any]] = wire.send(*(json.dumps(each).encode() for each in messages))
    return said


def test_a_thousand_hostile_messages_leave_the_server_as_it_was(tmp_path: Path) -> None:
    assert attack(1000, 20, tmp_path) == []


@pytest.mark.parametrize("number", [5, "five", 10**400, -1, "\ud800"])
def test_a_question_before_the_session_begins_is_refused(wire: Any, number: Any) -> None:
    assert code(sent(wire, {**HOVER, "id": number}), number) == _NOT_BEGUN
    wire.start()
    assert (
        wire.ask("textDocument/hover", textDocument={"uri": "a"}, position={"line": 0, "character": 0})["result"]
        is None
    )


def test_an_edit_before_the_session_begins_is_passed_over(wire: Any) -> None:
    item = {"uri": "untitled:a", "languageId": "nddl", "version": 1, "text": "int"}
    assert wire.tell("textDocument/didOpen", textDocument=item) == []


def test_a_session_begins_once(wire: Any) -> None:
    wire.start()
    said = sent(wire, {"jsonrpc": "2.0", "id": 2, "method": "initialize", "params": {"capabilities": {}}})
    assert code(said, 2) == _INVALID


def test_a_question_after_the_end_is_refused(client: Any) -> None:
    client.start()
    client.ask("shutdown")
    for method in ("textDocument/hover", "shutdown", "initialize", "nonsense"):
        assert client.ask(method)["error"]["code"] == _INVALID
    client.send(method="exit")
    assert client.process.wait(60) == 0


@pytest.mark.parametrize(
    ("message", "number", "wanted"),
    [
        ({**HOVER, "id": 1.5}, None, _INVALID),
        ({**HOVER, "id": None}, None, _INVALID),
        ({**HOVER, "id": True}, None, _INVALID),
        ({**HOVER, "id": 3, "jsonrpc": "1.0"}, 3, _INVALID),
        ({**HOVER, "id": 3, "method": 7}, 3, _INVALID),
        ({**HOVER, "id": 3, "method": "textDocument/didOpen"}, 3, _INVALID),
        ({**HOVER, "id": 3, "method": "nonsense", "params": {"jsonrpc": "2.0"}}, 3, _NO_METHOD),
        ({"jsonrpc": "2.0", "id": 3}, 3, _INVALID),
        ([{**HOVER, "id": 3}, {**HOVER, "method": "exit"}], 3, _INVALID),
        ([], None, _INVALID),
        (1, None, _INVALID),
    ],
)
def test_what_is_no_message_of_the_protocol_is_told_so(wire: Any, message: Any, number: Any, wanted: int) -> None:
    wire.start()
    assert code(sent(wire, message), number) == wanted
    assert "error" not in wire.ask("workspace/symbol", query="")


@pytest.mark.parametrize("body", [b"", b"{", b"\xff", b"[" * 100_000, b"9" * 6000])
def test_what_is_no_json_is_told_so(wire: Any, body: bytes) -> None:
    wire.start()
    assert code(wire.send(body), None) == _NO_JSON


@pytest.mark.parametrize("wrong", [-30, -1, 1, 40, 10**11])
def test_a_wrong_length_costs_two_messages_at_most(client: Any, wrong: int) -> None:
    client.start()
    body = json.dumps({**HOVER, "id": 1000}).encode()
    client.send_raw(b"Content-Length: %d\r\n\r\n%b" % (len(body) + wrong, body))
    client.send_raw(framed(json.dumps({**HOVER, "id": 1001}).encode()))
    client.send_raw(framed(json.dumps({**HOVER, "id": 1002}).encode()))
    assert "error" in client.wait(lambda message: message.get("id") == 1002)
    assert client.leave() == 0


def test_what_failed_is_not_held(wire: Any) -> None:
    wire.start()
    gc.collect()
    gc.disable()
    try:
        for number in range(1000):
            sent(wire, {**HOVER, "id": number})
        assert gc.collect() < 10_000  # 41 objects of each that failed
    finally:
        gc.enable()


def test_what_a_notification_asked_for_is_not_held(wire: Any) -> None:
    wire.start()
    notebook = {"uri": "file:///a.ipynb", "notebookType": "jupyter", "version": 1, "metadata": {}, "cells": []}
    before = endings()
    for _ in range(20):
        wire.tell("$/setTrace", value="off")
        wire.tell("workspace/didChangeWorkspaceFolders", event={"added": [], "removed": []})
        wire.tell("workspace/didChangeWatchedFiles", changes=[])
        wire.tell("notebookDocument/didOpen", notebookDocument=notebook, cellTextDocuments=[])
        wire.tell("notebookDocument/didChange", notebookDocument={"uri": "file:///b", "version": 2}, change={})
    assert endings() == before


def endings() -> int:
    """How many futures there are, which hold how something ended."""
    gc.collect()
    return sum(isinstance(each, (Future, asyncio.Future)) for each in gc.get_objects())
