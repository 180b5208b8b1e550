"""Each fixture marks its own complaints: the place, the words, what helps, and where the other half is."""

from pathlib import Path

import pytest

from nddl_lang.analysis import analyse_text
from nddl_lang.semantics import codes
from nddl_lang.semantics.pages import PAGES
from nddl_lang.text.diagnostic import Code, Severity
from nddl_lang.text.page import RulePage
from tests.semantics.marked import marked, unmarked

FIXTURES = Path(__file__).parent / "fixtures"
PATHS = sorted(FIXTURES.rglob("*.nddl"))


CODES = [value for value in vars(codes).values() if isinstance(value, Code)]


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.relative_to(FIXTURES).with_suffix("").as_posix())
def test_a_fixture_draws_the_complaints_that_it_marks(path: Path) -> None:
    expected = path.read_text(encoding="utf-8")
    text = unmarked(expected)
    assert marked(text, analyse_text(path.name, text).diagnostics) == expected


def test_every_code_is_given_once_and_has_a_page() -> None:
    assert sorted(code.id for code in CODES) == list(PAGES)


def test_every_code_has_a_fixture() -> None:
    marks = "\n".join(path.read_text(encoding="utf-8") for path in PATHS)
    assert [code for code in PAGES if f" {code} " not in marks] == []


@pytest.mark.parametrize("page", PAGES.values(), ids=PAGES.keys())
def test_the_examples_of_a_page_are_bad_and_good(page: RulePage) -> None:
    bad = analyse_text("bad.nddl", page.bad).diagnostics
    assert {diagnostic.code for diagnostic in bad} == {page.code}
    assert analyse_text("good.nddl", page.good).diagnostics == ()


def test_messages_speak_to_the_user() -> None:
    for page in PAGES.values():
        template = page.code.template
        assert not {"error", "invalid"} & set(template.lower().split()), template
        assert template[0].islower() or template[0] in "`{", template
        assert not template.endswith("."), template


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


def test_what_europa_allows_without_harm_is_no_error() -> None:
    assert [code for code, page in PAGES.items() if page.code.severity is not Severity.ERROR] == [
        "NDDL222",
        "NDDL235",
        "NDDL334",
        "NDDL336",
    ]
