"""One engine behind both doors: what the server tells of a model equals `nddlc lint --format json`.

A sample by default; `make editor-proof` (NDDLC_EDITOR=all) takes every model of the checkout.
"""

import json
import os
from pathlib import Path
from typing import Any

import pytest

from lsp.roots import root_of
from nddl_lang.text.read import read_text
from nddlc.main import run

ROOT = Path(__file__).resolve().parents[2]
MODELS = sorted(path for folder in ("models", "tests") for path in (ROOT / folder).rglob("*.nddl"))
SHARES = 40
IS_ALL = os.environ.get("NDDLC_EDITOR") == "all"
WEIGHTS = {1: "error", 2: "warning", 3: "info", 4: "hint"}


def linted(path: Path, capsys: Any) -> list[tuple[Any, ...]]:
    """What the command line says, place by place."""
    assert run(["lint", str(path), "--format", "json", "--level", "hint"]) in (0, 1)
    return sorted(
        (
            each["file"],
            each["line"],
            each["column"],
            each["end_line"],
            each["end_column"],
            each["code"],
            each["severity"],
        )
        for each in json.loads(capsys.readouterr().out)["diagnostics"]
    )


def served(wire: Any, path: Path, text: str) -> list[tuple[Any, ...]]:
    """What the server says when only this text is open."""
    wire.start(general={"positionEncodings": ["utf-32"]})
    item = {"uri": path.as_uri(), "languageId": "nddl", "version": 1, "text": text}
    found = []
    for message in wire.tell("textDocument/didOpen", textDocument=item):
        for each in message["params"].get("diagnostics", ()):
            start, end = each["range"]["start"], each["range"]["end"]
            place = (start["line"] + 1, start["character"] + 1, end["line"] + 1, end["character"] + 1)
            file = message["params"]["uri"].removeprefix("file://")
            found.append((file, *place, each["code"], WEIGHTS[each["severity"]]))
    return sorted(found)


@pytest.mark.parametrize("share", range(SHARES if IS_ALL else 2))
def test_the_server_tells_what_the_linter_tells(make_wire: Any, capsys: Any, share: int) -> None:
    compared = 0
    for path in MODELS[share::SHARES]:
        text = read_text(path)
        # The server shows a part as part of its model; lines that end in a lone CR are counted otherwise there.
        if text is None or root_of(path) is not None or "\r" in text.replace("\r\n", ""):
            continue
        assert served(make_wire(), path, text) == linted(path, capsys), path
        compared += 1
    assert compared > 10
