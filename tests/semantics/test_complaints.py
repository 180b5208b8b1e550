"""Each fixture marks its own complaints: the place, the words, what helps, and where the other half is."""

import pkgutil
from importlib import import_module
from pathlib import Path

import pytest

import nddl_lang.semantics
from nddl_lang.analysis import analyse_text
from nddl_lang.text.diagnostic import Code, Severity
from tests.semantics.marked import marked, unmarked

FIXTURES = Path(__file__).parent / "fixtures"
PATHS = sorted(FIXTURES.rglob("*.nddl"))


def codes() -> dict[str, Code]:
    """All codes of the passes, by id."""
    found: dict[str, Code] = {}
    for module in pkgutil.iter_modules(nddl_lang.semantics.__path__):
        for value in vars(import_module(f"nddl_lang.semantics.{module.name}")).values():
            if isinstance(value, Code):
                assert found.setdefault(value.id, value) is value, f"{value.id} is given twice"
    return found


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.relative_to(FIXTURES).with_suffix("").as_posix())
def test_a_fixture_draws_the_complaints_that_it_marks(path: Path) -> None:
    expected = path.read_text(encoding="utf-8")
    text = unmarked(expected)
    assert marked(text, analyse_text(path.name, text).diagnostics) == expected


def test_every_code_has_a_fixture() -> None:
    marks = "\n".join(path.read_text(encoding="utf-8") for path in PATHS)
    assert [code for code in sorted(codes()) if f" {code} " not in marks] == []


def test_messages_speak_to_the_user() -> None:
    for code in codes().values():
        words = code.template.lower().split()
        assert "error" not in words, code
        assert "invalid" not in words, code
        assert code.template[0].islower() or code.template[0] in "`{", code
        assert not code.template.endswith("."), code


def test_fixes_of_fixtures_leave_one_complaint_less() -> None:
    for path in PATHS:
        text = unmarked(path.read_text(encoding="utf-8"))
        diagnostics = analyse_text(path.name, text).diagnostics
        for diagnostic in diagnostics:
            for fix in diagnostic.fixes:
                mended = text
                for edit in sorted(fix.edits, key=lambda edit: -edit.span.begin):
                    mended = mended[: edit.span.begin] + edit.text + mended[edit.span.finish :]
                left = analyse_text(path.name, mended).diagnostics
                assert fix.safe <= (len(left) < len(diagnostics)), (path.name, fix.title)


def test_only_doubtful_declarations_are_warnings() -> None:
    assert [code.id for code in codes().values() if code.severity is not Severity.ERROR] == ["NDDL222"]
