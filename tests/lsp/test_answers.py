"""Completion, outline, mends and formatting; and the root of a part."""

from pathlib import Path

import pytest
from lsprotocol.types import DocumentSymbol, SymbolKind

from lsp.completion import completions
from lsp.documents import Documents
from lsp.links import page_of
from lsp.mending import formatting, mends
from lsp.open_text import DocumentContext
from lsp.roots import all_roots, files_below, root_of
from lsp.symbols import Outlines
from nddl_lang.syntax.incremental import common_ends

MODEL = """\
enum Mode { Internal, External }
class Part { int size; Part() { size = 1; } }
class Gps extends Timeline {
  Part part;
  predicate Idle { }
  predicate Active { int hits; Mode mode; }
  Gps() { part = new Part(); }
}
Gps gps = new Gps();
Gps::Active {
  float local;
  met_by(Idle earlier);
  HERE
}
"""


def view_of(text: str, uri: str = "untitled:a") -> tuple[Documents, DocumentContext]:
    documents = Documents()
    documents.open(uri, 1, text)
    view = documents.view(uri)
    assert view is not None
    return documents, view


def offered(typed: str) -> list[str]:
    """What is offered after `typed` inside the rule."""
    text = MODEL.replace("HERE", typed)
    _, view = view_of(text)
    at = MODEL.index("HERE") + len(typed)
    return [item.label for item in completions(view.snapshot.analysis, view.parse, at)]


@pytest.mark.parametrize(
    ("typed", "names"),
    [
        ("earlier.", ["state", "object", "duration", "start", "end"]),
        ("this.", ["hits", "mode", "state"]),
        ("object.", ["part", "Idle", "Active"]),
        ("object.part.", ["size"]),
        ("gps.part.si", ["size"]),
        ("meets(Gps.", ["Idle", "Active"]),
        ("mode == Mode.", ["Internal", "External"]),
        ("Gps::", ["Idle", "Active"]),
        (
            "ea",
            ["earlier", "local", "hits", "start", "Active", "gps", "Internal", "Gps", "int", "met_by", "addEq", "if"],
        ),
    ],
)
def test_what_may_follow_is_offered(typed: str, names: list[str]) -> None:
    found = offered(typed)
    assert [name for name in found if name in names] == names
    assert len(set(found)) == len(found)


@pytest.mark.parametrize("typed", ["hits.part.", "nothing.", "object.nothing.", "earlier.hits."])
def test_where_nothing_is_known_no_member_is_offered(typed: str) -> None:
    assert offered(typed) == []


def names(symbols: list[DocumentSymbol]) -> list[object]:
    return [(symbol.name, names(list(symbol.children))) if symbol.children else symbol.name for symbol in symbols]


def test_the_outline_has_members_inside_their_classes() -> None:
    _, view = view_of(MODEL.replace("HERE", "") + "goal(gps.Active first);\ntypedef int [0 3] Few;\nFew a, b;\n")
    symbols = Outlines().outline(view.parse, view.document.lines)
    assert names(symbols) == [
        ("Mode", ["Internal", "External"]),
        ("Part", ["size", "Part"]),
        ("Gps", ["part", "Idle", ("Active", ["hits", "mode"]), "Gps"]),
        "gps",
        "Gps::Active",
        "first",
        "Few",
        "a",
        "b",
    ]
    assert symbols[3].kind is SymbolKind.Object
    for symbol in symbols:
        inner, outer = symbol.selection_range, symbol.range
        assert (outer.start.line, outer.start.character) <= (inner.start.line, inner.start.character)
        assert (outer.end.line, outer.end.character) >= (inner.end.line, inner.end.character)


def test_a_fix_that_may_change_the_meaning_is_no_preferred_one() -> None:
    documents, view = view_of("class C { private int x; }\nint y = 3.0;\nint z = yy;\n")
    lines = view.document.lines
    actions = mends(view, lines.range(0, len(lines.text)), documents.conversion())
    assert [(action.title, action.is_preferred) for action in actions] == [
        ("remove `private`", True),
        ("write `3`", True),
        ("write `y` (check the meaning)", None),
    ]
    assert mends(view, lines.range(0, 3), documents.conversion()) == []


@pytest.mark.parametrize(
    "text", ["int  a;\r\n\r\n\r\nint b ;\r\n", "int a;\n", "", "class C{int x;}", "int a;  // é 🛰"]
)
def test_formatting_changes_only_what_has_to_change(text: str) -> None:
    _, view = view_of(text)
    lines = view.document.lines
    edits = formatting(view.parse, lines)
    for edit in edits:
        begin, finish = lines.offset(edit.range.start), lines.offset(edit.range.end)
        assert edit.range == lines.range(begin, finish)
        prefix, _ = common_ends(text[begin:finish], edit.new_text)
        assert prefix == 0 or text[begin] == "\r"
        text = text[:begin] + edit.new_text + text[finish:]
    _, again = view_of(text)
    assert formatting(again.parse, again.document.lines) == []


def test_the_root_of_a_part_is_found_over_several_files(tmp_path: Path) -> None:
    for name, text in {
        "main": '#include "middle.nddl"\n',
        "middle": ' #include "sub/part.nddl"\n',
        "ring": '#include "ring2.nddl"\n',
        "ring2": '#include "ring.nddl"\n',
    }.items():
        (tmp_path / f"{name}.nddl").write_text(text)
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "part.nddl").write_text("")
    assert root_of(tmp_path / "middle.nddl") == tmp_path / "main.nddl"
    assert root_of(tmp_path / "main.nddl") is None
    assert root_of(tmp_path / "ring.nddl") is None
    assert root_of(tmp_path / "nowhere" / "x.nddl") is None


def test_a_text_that_was_never_saved_lies_in_no_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Least of all in the one that the server was started in."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "main.nddl").write_text('#include "untitled:model"\n')
    assert all_roots("untitled:model", ()) == []
    assert all_roots(str(tmp_path / "untitled:model"), ()) == [tmp_path / "main.nddl"]


def test_folders_are_looked_through_up_to_a_limit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for number in range(12):
        (tmp_path / f"{number:02}").mkdir()
        (tmp_path / f"{number:02}" / "a.nddl").write_text("")
    assert len(list(files_below(tmp_path, ".nddl"))) == 12
    monkeypatch.setattr("lsp.roots._MOST_ENTRIES", 16)
    assert len(list(files_below(tmp_path, ".nddl"))) == 4


def test_a_code_without_a_page_has_no_link() -> None:
    assert page_of("NDDL000") is None
