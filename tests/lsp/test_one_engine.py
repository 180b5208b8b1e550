"""One engine behind both doors: what the server tells of a file equals `nddlc lint --format json`.

A sample by default; `make editor-proof` (NDDLC_EDITOR=all) takes every model and every mission file of the checkout.
A part of a model is shown as what it is there, so it is held to what the linter tells of that model.
"""

import json
import os
import shutil
from pathlib import Path
from typing import Any

import pytest
from lsprotocol.types import Position

from lsp.positions import Encoding, Lines
from lsp.roots import root_of
from nddl_lang.text.read import read_text
from nddlc.editor import make_editor_session
from nddlc.main import run
from tests.cli.slips_in_templates import SLIPS_IN_TEMPLATES

ROOT = Path(__file__).resolve().parents[2]
FILES = {
    ending: sorted(path for folder in ("models", "tests") for path in (ROOT / folder).rglob(f"*.{ending}"))
    for ending in ("nddl", "toml")
}
SHARES = 40
IS_ALL = os.environ.get("NDDLC_EDITOR") == "all"
WEIGHTS = {1: "error", 2: "warning", 3: "info", 4: "hint"}


class Texts:
    """The texts of files, and the offsets of places in them; each door counts lines in its own way."""

    def __init__(self) -> None:
        self._texts: dict[str, str] = {}

    def _text(self, file: str) -> str:
        if file not in self._texts:
            self._texts[file] = read_text(Path(file)) or ""
        return self._texts[file]

    def of_linter(self, file: str, line: int, column: int) -> int:
        """Where a line and a column are, which the linter counts from 1; only LF ends a line."""
        return sum(len(each) + 1 for each in self._text(file).split("\n")[: line - 1]) + column - 1

    def of_server(self, file: str, place: dict[str, int]) -> int:
        """Where a position is, as the protocol counts."""
        return Lines(self._text(file), Encoding.UTF32).offset(Position(**place))


def linted(path: Path, texts: Texts, capsys: Any) -> list[tuple[Any, ...]]:
    """What the command line says: file, begin, end, code, weight, text, and the notes that stand elsewhere."""
    assert run(["lint", str(path), "--format", "json", "--level", "hint", "--trust"]) in (0, 1)

    def span(each: Any) -> tuple[str, int, int]:
        file = str(Path(each["file"]).resolve())
        begin = texts.of_linter(file, each["line"], each["column"])
        return file, begin, texts.of_linter(file, each["end_line"], each["end_column"])

    found = []
    for each in json.loads(capsys.readouterr().out)["diagnostics"]:
        lines = [each["message"], *(f"note: {note['message']}" for note in each["notes"] if "file" not in note)]
        lines += [f"help: {each['help']}"] if each["help"] is not None else []
        notes = tuple((*span(note), note["message"]) for note in each["notes"] if "file" in note)
        found.append((*span(each), each["code"], each["severity"], "\n".join(lines), notes))
    return sorted(found)


def served(wire: Any, path: Path, texts: Texts, text: str) -> list[tuple[Any, ...]]:
    """What the server says when only this file is open."""

    def span(uri: str, place: Any) -> tuple[str, int, int]:
        file = str(Path(uri.removeprefix("file://")).resolve())
        return file, texts.of_server(file, place["start"]), texts.of_server(file, place["end"])

    wire.start(general={"positionEncodings": ["utf-32"]})
    item = {"uri": path.as_uri(), "languageId": "nddl", "version": 1, "text": text}
    found = []
    published = {}
    for message in [*wire.tell("textDocument/didOpen", textDocument=item), *wire.rest()]:
        assert message["method"] == "textDocument/publishDiagnostics", message
        published[message["params"]["uri"]] = message
    for message in published.values():
        for each in message["params"]["diagnostics"]:
            notes = tuple(
                (*span(note["location"]["uri"], note["location"]["range"]), note["message"])
                for note in each.get("relatedInformation", ())
            )
            place = span(message["params"]["uri"], each["range"])
            found.append((*place, each["code"], WEIGHTS[each["severity"]], each["message"], notes))
    return sorted(found)


@pytest.mark.parametrize("share", range(SHARES if IS_ALL else 2))
def test_the_server_tells_what_the_linter_tells(make_wire: Any, capsys: Any, share: int) -> None:
    compared = 0
    for path in FILES["nddl"][share::SHARES]:
        text = read_text(path)
        if text is not None:
            texts = Texts()
            assert served(make_wire(), path, texts, text) == linted(root_of(path) or path, texts, capsys), path
            compared += 1
    assert compared > 30


@pytest.mark.parametrize("share", range(10 if IS_ALL else 1))
def test_the_server_tells_of_a_mission_file_what_the_linter_tells(make_wire: Any, capsys: Any, share: int) -> None:
    """Of its models the server tells where these are open."""
    compared = 0
    for path in FILES["toml"][share::10]:
        session = make_editor_session(None, (), is_trusted=True)
        text = path.read_text()
        if session.missions.open(path.as_uri(), 1, text) is None or "solver" in path.name:
            continue
        texts = Texts()
        expected = [each for each in linted(path, texts, capsys) if each[0] == str(path)]
        assert served(make_wire(make_editor_session(None, (), is_trusted=True)), path, texts, text) == expected, path
        compared += 1
    assert compared > 5


@pytest.mark.parametrize("share", range(4))
def test_the_server_tells_of_a_mistake_what_the_linter_tells(
    make_wire: Any, capsys: Any, share: int, tmp_path: Path
) -> None:
    for number, mistake in enumerate(SLIPS_IN_TEMPLATES[share::4]):
        folder = tmp_path / str(number)
        shutil.copytree((ROOT / "models" / mistake.file).parent, folder)
        path = folder / Path(mistake.file).name
        text = path.read_text().replace(mistake.right, mistake.wrong)
        path.write_text(text)
        texts = Texts()
        wire = make_wire(make_editor_session(None, (), is_trusted=True))
        expected = linted(root_of(path) or path, texts, capsys)
        if path.suffix == ".toml":  # of its models the server tells where these are open
            expected = [each for each in expected if each[0] == str(path)]
        assert served(wire, path, texts, text) == expected, mistake
