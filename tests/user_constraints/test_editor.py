"""In an editor, a project's own constraints are known like built-in ones."""

import sys
from pathlib import Path

import pytest

from lsp.completion import completions
from lsp.documents import Documents
from lsp.hover import hover_at
from lsp.open_text import DocumentContext
from lsp.project import ServerSettings
from nddl_lang.text.source import Source
from nddlc.editor import examine_for_editor, known_to_editor
from tests.user_constraints.own import TWICE, written

MODEL = "int x = [1 10];\nint y = [0 13];\ntwice(y, x);\n"


def opened(
    folder: Path, module: str, *, is_trusted: bool = False, more: str = ""
) -> tuple[DocumentContext, Documents, list[str]]:
    """A model in a project with a module, as the editor has it: also the codes of its complaints."""
    written(folder, module)
    (folder / "nddlc.toml").write_text('[constraints]\nmodules = ["own.py"]\n' + more, encoding="utf-8")
    path = folder / "model.nddl"
    path.write_text(MODEL, encoding="utf-8")
    documents = Documents(ServerSettings(is_trusted=is_trusted, know=known_to_editor))
    news = documents.open(path.as_uri(), 1, MODEL)
    view = documents.view(path.as_uri())
    assert view is not None
    return view, documents, [str(each.code) for publication in news for each in publication.diagnostics]


def test_hover_and_completion_show_them(tmp_path: Path) -> None:
    view, documents, codes = opened(tmp_path, TWICE)
    assert codes == []
    place = view.document.lines.position(MODEL.index("twice"))
    hover = hover_at(view, place, documents.conversion())
    assert hover is not None
    text = str(getattr(hover.contents, "value", ""))
    assert "twice(y, x)" in text
    assert "y is twice x." in text
    assert "Comes with a Python module of this project." in text
    assert "twice" in [item.label for item in completions(view.snapshot.analysis, view.parse, MODEL.index("twice"))]


ENDS = {
    "print('loading')\n1 / 0\n": "own.py:3: the module cannot be loaded: ZeroDivisionError: division by zero",
    "sum(range(10**12))\n": "own.py:2: the module did not come back within 20 s and was stopped",
    "import ctypes\nctypes.string_at(0)\n": "own.py:3: the module ended the process (signal SIGSEGV)",
}
LIMIT = "time_limit = 20\n"  # a busy machine takes long for the import above it


@pytest.mark.once
@pytest.mark.parametrize("module", ENDS)
def test_a_module_that_fails_leaves_the_editor_at_work(
    module: str, tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    if sys.platform != "linux" and "ZeroDivision" not in ENDS[module]:
        pytest.skip("black boxes are Linux only")
    monkeypatch.chdir(tmp_path)
    view, documents, codes = opened(tmp_path, module, is_trusted=True, more=LIMIT)
    assert codes == ["NDDL594"]
    (told,) = documents.complaints((tmp_path / "nddlc.toml").as_uri())
    assert told.message.startswith(f"the project's Python cannot be used: {ENDS[module]}")
    assert told.range.start.line == 1
    assert hover_at(view, view.document.lines.position(MODEL.index("y")), documents.conversion()) is not None
    assert capfd.readouterr().out == ""  # where editor and server talk


def test_a_mission_whose_module_fails_says_so_in_the_editor(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    written(tmp_path, TWICE)
    written(tmp_path, "1 / 0\n", "other.py")
    (tmp_path / "m.nddl").write_text("class B extends Timeline { predicate p { } }\nB b = new B();\nclose();\n")
    reactor = '[[reactor]]\nname = "r"\nmodel = "m.nddl"\nlatency = 1\nlookahead = 5\ninternal = ["b"]\n'
    modules = f'[constraints]\nmodules = ["own.py", "other.py"]\n{LIMIT}'
    text = f'[mission]\nname = "m"\nfinal_tick = 20\ntick = 1.0\n{modules}{reactor}'
    found = [
        (each.code.id, each.span.line, each.span.text)
        for each in examine_for_editor(Source(str(tmp_path / "mission.toml"), text), tmp_path, is_trusted=True)
    ]
    assert found == [("NDDL594", 6, '"other.py"')]
