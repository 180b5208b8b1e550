"""Rename every name of every model: what is wrong, and the words of the texts, stay the same up to the name.

A sample by default; `make renames` (NDDLC_RENAMES=all) takes all models and all names.
"""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from lsp.documents import Documents
from lsp.occurrences import Occurrence, Symbol
from lsp.open_text import DocumentContext
from lsp.references import everywhere
from lsp.rename import RenameError, rename
from nddl_lang.analysis import Analyser
from nddl_lang.lint.linter import Linter
from nddl_lang.syntax.includes import load_module_graph
from nddl_lang.text.diagnostic import Severity
from nddl_lang.text.read import read_text
from nddl_lang.text.source import Source

ROOT = Path(__file__).resolve().parents[2]
MODELS = sorted([*ROOT.joinpath("models").rglob("*.nddl"), *ROOT.joinpath("tests/conformance").rglob("*.nddl")])
IS_ALL = os.environ.get("NDDLC_RENAMES") == "all"
SHARES = 40  # of the models that are left out otherwise
FRESH = "zzFresh9"

# Code, file and line of each complaint with its message; the words of each text.
Picture = tuple[list[tuple[str, str, int, str]], list[list[str]]]


def picture(root: str, texts: dict[str, str], old: str) -> Picture:
    """What a model looks like read from the beginning, `FRESH` written as `old`."""

    def text_of(path: Path) -> str | None:
        key = os.path.realpath(path)
        return texts[key] if key in texts else read_text(path)

    analysis = Analyser().analyse(load_module_graph(Source(root, text_of(Path(root)) or ""), open_text=text_of))
    found = [
        (each.code.id, each.span.source.name, each.span.line, _plain(each.message, old))
        for each in Linter().lint(analysis)
    ]
    words = [
        [old if word == FRESH else word for word in piece.texts]
        for parse in analysis.loaded.parses
        for piece in parse.pieces
    ]
    return found, words


def _plain(message: str, old: str) -> str:
    return message.replace(FRESH, old).replace(" an `", " a `")


def first_in(view: DocumentContext, symbol: Symbol) -> Occurrence | None:
    """Where the text itself names the symbol first."""
    return next((each for each in view.snapshot.names.of(symbol) if each.span.source is view.parse.source), None)


def chosen(view: DocumentContext, number: int) -> Iterator[Symbol]:
    """All symbols, or of a sample two of each model."""
    symbols = [symbol for symbol in view.snapshot.names.all if first_in(view, symbol) is not None]
    yield from (
        symbols if IS_ALL or not symbols else {symbols[number % len(symbols)], symbols[number * 7 % len(symbols)]}
    )


def carried_out(documents: Documents, view: DocumentContext, symbol: Symbol) -> int:
    """Rename one symbol and compare; the number of places."""
    projects = [project.key for project in everywhere(documents, view.snapshot, symbol).projects]
    try:
        changes = rename(documents, view.snapshot, symbol, everywhere(documents, view.snapshot, symbol), FRESH)
    except RenameError as refusal:
        # What the language brings along keeps its name, and so does what a mistake leaves in doubt.
        has_errors = any(each.severity is Severity.ERROR for each in view.snapshot.diagnostics)
        assert has_errors or "language" in str(refusal) or "library" in str(refusal)
        return 0
    texts: dict[str, str] = {}
    for change in sorted(changes, key=lambda each: each.place, reverse=True):
        key, begin, finish = change.place
        text = texts.get(key) or Path(key).read_bytes().decode()
        assert text[begin:finish] == symbol.name
        texts[key] = text[:begin] + FRESH + text[finish:]
    for project in projects:
        before, after = picture(project, {}, symbol.name), picture(project, texts, symbol.name)
        assert after[1] == before[1]
        # One of two tokens or locals of one name has another now: what was said of their being called the same is gone.
        assert [each for each in before[0] if each not in after[0] and each[0] not in ("NDDL510", "NDDL514")] == []
        assert [each for each in after[0] if each not in before[0]] == []
    return len(changes)


@pytest.mark.parametrize("share", range(SHARES if IS_ALL else 4))
def test_a_rename_changes_nothing_but_the_name(share: int) -> None:
    places = 0
    for number, path in list(enumerate(MODELS))[share::SHARES]:
        text = read_text(path)
        if text is None or "\0" in text:
            continue
        documents = Documents()
        uri = path.as_uri()
        documents.open(uri, 1, text)
        view = documents.view(uri)
        assert view is not None
        for name, owner in [(each.name, each.type) for each in chosen(view, number)]:
            view = documents.view(uri)
            assert view is not None
            symbol = next(
                each
                for each in view.snapshot.names.all
                if (each.name, each.type) == (name, owner) and first_in(view, each) is not None
            )
            places += carried_out(documents, view, symbol)
    assert places > 0
