"""Each fixture marks its own complaints: the place, the words, what helps and what mends."""

from pathlib import Path

import pytest

from nddl_lang.syntax import codes
from nddl_lang.syntax.dialect import Dialect, declared_dialect
from nddl_lang.syntax.nodes import BrokenStatement
from nddl_lang.syntax.parser import parse
from nddl_lang.syntax.recovery import Recovery
from nddl_lang.text.diagnostic import Code, Diagnostic
from nddl_lang.text.source import Source
from tests.syntax.marked import marked, unmarked

FIXTURES = Path(__file__).parent / "fixtures"
PATHS = sorted(FIXTURES.rglob("*.nddl"))
CODES = [value for value in vars(codes).values() if isinstance(value, Code)]
# What cannot be marked in a text, or is no matter of one text; other tests show these.
ELSEWHERE = {codes.NOT_TEXT, codes.TOO_DEEP, codes.TOO_LARGE, codes.COMMENT_AT_END, codes.BYTE_ORDER_MARK}


def complaints(text: str) -> tuple[Diagnostic, ...]:
    return parse(Source("fixture", text), declared_dialect(text) or Dialect.NDDLC).diagnostics


def read(path: Path) -> str:
    return path.read_bytes().decode("utf-8")


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.relative_to(FIXTURES).with_suffix("").as_posix())
def test_a_fixture_draws_the_complaints_that_it_marks(path: Path) -> None:
    expected = read(path)
    text = unmarked(expected)
    assert marked(text, complaints(text)) == expected


def test_every_code_has_a_fixture() -> None:
    marks = "\n".join(map(read, PATHS))
    missing = [code.id for code in CODES if f" {code.id} " not in marks]
    assert missing == sorted(code.id for code in CODES if code.kind == "include" or code in ELSEWHERE)


def test_every_code_is_given_once() -> None:
    ids = [code.id for code in CODES]
    assert ids == sorted(set(ids))


def test_messages_are_in_lower_case_and_blame_nobody() -> None:
    for code in CODES:
        template = code.template
        assert template[0] in "`{" or template[0].islower(), template
        assert "error" not in template and "invalid" not in template and not template.endswith("."), template


def test_a_comment_at_the_very_end_is_an_error_in_nddl3_only() -> None:
    text = "int a = 1;\n// the end"
    assert parse(Source("t", text)).diagnostics == ()
    (complaint,) = parse(Source("t", text), Dialect.NDDL3).diagnostics
    assert (complaint.code, complaint.span.line, complaint.fixes[0].edits[0].text) == (codes.COMMENT_AT_END, 2, "\n")


def test_a_byte_order_mark_is_an_error_in_nddl3_only() -> None:
    text = "\ufeffint a = 1;\n"
    assert parse(Source("t", text)).diagnostics == ()
    (complaint,) = parse(Source("t", text), Dialect.NDDL3).diagnostics
    assert (complaint.code, complaint.span.begin, complaint.span.finish) == (codes.BYTE_ORDER_MARK, 0, 1)


@pytest.mark.parametrize("number", ["0x1", "1e9in", "1..5", "0777", "1.5.2"])
def test_a_per_cent_of_what_is_no_number_is_no_share(number: str) -> None:
    assert not [each for each in complaints(f"int a = {number}% ;") if "per cent" in (each.help or "")]


def test_mends_that_lead_nowhere_come_to_an_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Recovery, "recover", lambda _, states, values, index: index)
    (statement,) = parse(Source("t", "int a = = 1;")).module.statements
    assert isinstance(statement, BrokenStatement)


def test_two_colons_before_what_is_no_name_end() -> None:
    assert complaints("eq(\n*\nnot\n;[\n\n object \n::close(); 1e9 {=< ||\n0x1 true constraint\nsuper( % class ")


def test_a_doubled_brace_that_is_no_part_of_what_is_never_closed_is_left_alone() -> None:
    # What begins below `u` is taken for a piece of its own, with its second `{`.
    assert codes.SUPERFLUOUS not in [each.code for each in complaints("p::l{\n u\np{{}}")]


@pytest.mark.parametrize(
    "text",
    [
        f"x == {'(' * 10_000}1{')' * 10_000};",
        f"x == {' + '.join(['1'] * 1_000)};",
        f"x == {'-' * 9_000}y;",
        f"x == {'[' * 300}1 2{']' * 300};",
        f"T::p {{ {'if (x) ' * 5_000}y; }}",
        f"T::p {'if (x) y; else ' * 5_000}z;",
        f"T::p {'{' * 1_000}",
    ],
)
def test_what_is_nested_too_deep_costs_one_message(text: str) -> None:
    (complaint,) = complaints(f"int a;\n{text}\n")
    assert (complaint.code, complaint.span.line) == (codes.TOO_DEEP, 2)


def test_what_is_nested_as_deep_as_allowed_is_understood() -> None:
    assert complaints(f"x == {'f(' * 190}1{')' * 190};") == ()
    assert complaints(f"x == {' + '.join(['1'] * 190)};") == ()
