"""The first answer comes from a table, before the rest is loaded: it is what a session would answer by itself."""

import json
import subprocess
import sys
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import Any

import pytest

from lsp.greeting import begin
from tests.lsp.profiles import PROFILES

SUPPORTS: tuple[Any, ...] = (
    {},
    {"prepareSupport": True},
    {"prepareSupport": False},
    {"prepareSupport": None},
    {"other": 1},
)
ENCODINGS: tuple[Any, ...] = (
    None,
    [],
    ["utf-8"],
    ["utf-32", "utf-8"],
    ["ebcdic"],
    ["ebcdic", "utf-16"],
    ["utf-7", "utf-8"],
)
MADE = [
    {"general": {"positionEncodings": encodings}, "textDocument": {"rename": support}}
    for encodings, support in product(ENCODINGS, SUPPORTS)
]
FILES = dict.fromkeys(("didCreate", "willCreate", "didRename", "willRename", "didDelete", "willDelete"), True)
PLAIN = [
    {},
    {"general": None, "textDocument": None},
    {"textDocument": {"rename": None}},
    {"workspace": {"fileOperations": FILES}},
    {"notebookDocument": {"synchronization": {"dynamicRegistration": True}}},
]


class Said:
    """An editor that has said something, and keeps what it is answered."""

    has_headers = True

    def __init__(self, *bodies: bytes) -> None:
        self._bodies = bodies
        self.answers: list[Any] = []

    def messages(self) -> Iterator[bytes]:
        yield from self._bodies

    def write(self, content: bytes) -> None:
        head, _, body = content.partition(b"\r\n\r\n")
        assert head == b"Content-Length: %d" % len(body)
        self.answers.append(json.loads(body))

    def close(self) -> None: ...


def first(number: Any = 1, **params: Any) -> bytes:
    return json.dumps({"jsonrpc": "2.0", "id": number, "method": "initialize", "params": params}).encode()


@pytest.mark.parametrize("capabilities", [*PROFILES.values(), *PLAIN, *MADE])
def test_the_first_answer_is_that_of_a_session(make_wire: Any, capabilities: Any) -> None:
    body = first(processId=None, rootUri=None, capabilities=capabilities)
    editor = Said(body)
    assert begin(editor) is not None
    assert editor.answers == make_wire().send(body)


@pytest.mark.parametrize(
    "body",
    [
        b"{",
        b"[1]",
        first(None, capabilities={}),
        first(True, capabilities={}),
        first(),
        first(capabilities=[]),
        first(capabilities={}).replace(b"initialize", b"initialized"),
        first(capabilities={}).replace(b"2.0", b"1.0"),
    ],
)
def test_what_does_not_begin_a_session_is_left_to_it(body: bytes) -> None:
    editor = Said(body, b"next")
    begun = begin(editor)
    assert begun is not None
    assert (begun.greeting, begun.first, list(begun.rest), editor.answers) == (None, body, [b"next"], [])


def test_an_editor_that_says_nothing_has_not_begun() -> None:
    assert begin(Said()) is None


def test_capabilities_that_make_no_sense_are_passed_over(client: Any) -> None:
    """What the answer was chosen by still counts; the rest is told of in the log."""
    odd = {"general": {"positionEncodings": ["utf-32"]}, "textDocument": {"hover": 7, "completion": [3]}}
    answer = client.ask("initialize", processId="x", rootUri=3, capabilities=odd, initializationOptions={})
    assert answer["capabilities"]["positionEncoding"] == "utf-32"
    told = client.wait(lambda message: message.get("method") == "window/logMessage")
    assert "JsonRpcInvalidParams" in told["params"]["message"]
    client.notify("initialized")
    (complaint,) = client.open("untitled:one", 'string s = "🛰"; int x = y;\n')["diagnostics"]
    assert complaint["range"]["start"]["character"] == 24
    assert client.leave() == 0


def test_a_capability_that_makes_no_sense_costs_no_other(client: Any, tmp_path: Path) -> None:
    """The odd ones are left out at any depth, and what stands beside them still counts."""
    able = {
        "general": {"positionEncodings": 8},
        "workspace": [3],
        "textDocument": {
            "hover": {"contentFormat": ["plaintext"], "dynamicRegistration": 1},
            "codeAction": {"codeActionLiteralSupport": {}, "resolveSupport": {"properties": ["edit"]}},
            "completion": {"completionItem": {"snippetSupport": True, "tagSupport": 3}, "contextSupport": "yes"},
            "rename": {"prepareSupport": "yes"},
        },
    }
    folders = [{"uri": tmp_path.as_uri(), "name": "folder"}]
    client.ask("initialize", processId="x", rootUri=3, capabilities=able, workspaceFolders=folders, clientInfo=7)
    client.notify("initialized")
    client.open("untitled:one", "class C extends Timeline { predicate p { } }\nint x = 3;\n\n")
    found = client.ask_at("completion", "untitled:one", 2, 0)["items"]
    assert any(each.get("insertTextFormat") == 2 for each in found)
    shown = client.ask_at("hover", "untitled:one", 1, 4)["contents"]
    assert shown["kind"] == "plaintext"
    assert client.leave() == 0


def test_the_first_answer_waits_for_nothing_that_is_slow_to_load() -> None:
    wanted = "import sys, nddlc.lsp; print(sorted({each.partition('.')[0] for each in sys.modules}))"
    told = subprocess.run([sys.executable, "-c", wanted], capture_output=True, text=True, check=True).stdout
    assert not {"pygls", "lsprotocol", "attrs", "lark", "numpy", "asyncio"} & set(eval(told))
