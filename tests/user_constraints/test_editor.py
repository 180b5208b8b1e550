"""In an editor, a project's own constraints are known like built-in ones."""

from pathlib import Path

import pytest

from lsp.completion import completions
from lsp.documents import Documents
from lsp.hover import hover_at
from lsp.open_text import DocumentContext
from lsp.project import ServerSettings
from nddlc.editor import known_to_editor
from tests.user_constraints.own import TWICE, written

MODEL = "int x = [1 10];\nint y = [0 13];\ntwice(y, x);\n"


def opened(folder: Path, module: str, *, is_trusted: bool = False) -> tuple[DocumentContext, Documents, list[str]]:
    """A model in a project with a module, as the editor has it: also the codes of its complaints."""
    written(folder, module)
    (folder / "nddlc.toml").write_text('[constraints]\nmodules = ["own.py"]\n', encoding="utf-8")
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


def test_a_module_that_fails_leaves_the_editor_at_work(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    _, _, codes = opened(tmp_path, "print('loading')\n1 / 0\n", is_trusted=True)
    assert codes == ["NDDL598"]
    told = capfd.readouterr()
    assert told.out == ""  # where editor and server talk
    assert "own.py:3: the module cannot be loaded: ZeroDivisionError" in told.err
