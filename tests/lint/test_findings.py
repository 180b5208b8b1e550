"""Each fixture marks its own findings; each page is right about its examples; the documentation is in step."""

import re
from pathlib import Path

import pytest

from checker.rulebook import PAGES as ALL_PAGES
from checker.rulebook import files
from nddl_lang.analysis import analyse_file, analyse_text
from nddl_lang.lint import codes
from nddl_lang.lint.linter import lint
from nddl_lang.lint.pages import PAGES
from nddl_lang.text.diagnostic import Code, Severity
from nddl_lang.text.page import RulePage
from tests.semantics.marked import marked, unmarked

ROOT = Path(__file__).resolve().parents[2]
RULES = ROOT / "docs" / "rules"
FIXTURES = Path(__file__).parent / "fixtures"
PATHS = sorted(FIXTURES.rglob("*.nddl"))
# Of settings, which are no text of a model: `test_configuration` and `test_trust` show them.
OF_SETTINGS = {"NDDL594", "NDDL595", "NDDL596", "NDDL597", "NDDL598", "NDDL599"}
# It needs a second file: `test_an_include_beside_the_file` shows it.
OF_FILES = {"NDDL573"}


CODES = [value for value in vars(codes).values() if isinstance(value, Code)]


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.relative_to(FIXTURES).with_suffix("").as_posix())
def test_a_fixture_draws_the_findings_that_it_marks(path: Path) -> None:
    expected = path.read_text(encoding="utf-8")
    text = unmarked(expected)
    assert marked(text, lint(analyse_text(path.name, text))) == expected


def test_every_code_is_given_once_and_has_a_page() -> None:
    assert sorted(code.id for code in CODES) == sorted({*PAGES, *OF_SETTINGS})


def test_every_code_has_a_fixture() -> None:
    marks = "\n".join(path.read_text(encoding="utf-8") for path in PATHS)
    assert [code for code in PAGES if f" {code} " not in marks and code not in OF_FILES] == []


@pytest.mark.parametrize("page", PAGES.values(), ids=PAGES.keys())
def test_the_examples_of_a_page_are_bad_and_good(page: RulePage, tmp_path: Path) -> None:
    (tmp_path / "vehicle.nddl").write_text("class Vehicle { }\n", encoding="utf-8")
    for name, text, expected in (("bad.nddl", page.bad, {page.code.id}), ("good.nddl", page.good, set[str]())):
        (tmp_path / name).write_text(text, encoding="utf-8")
        assert {each.code.id for each in lint(analyse_file(tmp_path / name))} == expected, name


def test_messages_speak_to_the_user() -> None:
    for page in PAGES.values():
        template = page.code.template
        assert not {"error", "invalid"} & set(template.lower().split()), template
        assert template[0].islower() or template[0] in "`{E", template
        assert not template.endswith("."), template


def test_findings_are_no_errors() -> None:
    assert [code for code, page in PAGES.items() if page.code.severity is Severity.ERROR] == []


def test_safe_fixes_of_fixtures_leave_one_finding_less_and_no_error() -> None:
    for path in PATHS:
        text = unmarked(path.read_text(encoding="utf-8"))
        findings = lint(analyse_text(path.name, text))
        for finding in findings:
            for fix in finding.fixes:
                mended = text
                for edit in sorted(fix.edits, key=lambda edit: -edit.span.begin):
                    mended = mended[: edit.span.begin] + edit.text + mended[edit.span.finish :]
                left = lint(analyse_text(path.name, mended))
                assert fix.safe <= (len(left) < len(findings)), (path.name, fix.title)
                before = [each for each in findings if each.severity is Severity.ERROR]
                assert fix.safe <= (not [each for each in left if each.severity is Severity.ERROR] or bool(before))


def test_the_documentation_is_in_step_with_the_pages() -> None:
    expected = dict(files())
    kept = {path.name: path.read_text(encoding="utf-8") for path in RULES.glob("*.md")}
    assert kept.pop("catalogue.md")
    assert kept == expected, "run `make rules`"


def test_the_catalogue_names_each_trap_once_and_only_codes_that_exist() -> None:
    text = (RULES / "catalogue.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (L\d\d) \| ([^|]*) \| ([^|]*) \|", text, re.MULTILINE)
    assert [row[0] for row in rows] == [f"L{number:02}" for number in range(1, 52)]
    named = set(re.findall(r"NDDL\d{3}", text))
    assert named - {*ALL_PAGES} == set()
    spans = re.findall(r"(NDDL\d{3}) to (NDDL\d{3})", text)
    assert [code for code in PAGES if code not in named and not any(a <= code <= b for a, b in spans)] == []


@pytest.mark.parametrize("path", sorted((ROOT / "models").rglob("*.nddl")), ids=lambda path: path.name)
def test_the_models_that_come_along_draw_no_warning(path: Path) -> None:
    heavy = (Severity.ERROR, Severity.WARNING)
    analysis = analyse_file(path)
    if not analysis.has_errors:  # of a part that leans on what its includers declare nothing can be said
        assert [each.message for each in lint(analysis) if each.severity in heavy] == []
