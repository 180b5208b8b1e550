"""The style, shown on texts; its promises, kept by all texts of the repository."""

from pathlib import Path

import pytest

from nddl_lang.formatter.format import format_text
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.parser import parse
from nddl_lang.syntax.walk import same_tree
from nddl_lang.text.source import Source

FIXTURES = Path(__file__).parent / "fixtures"
NAMES = sorted(path.name.removesuffix(".before.nddl") for path in FIXTURES.glob("*.before.nddl"))


@pytest.mark.parametrize("name", NAMES)
def test_a_text_comes_out_in_the_style(name: str) -> None:
    before = (FIXTURES / f"{name}.before.nddl").read_text(encoding="utf-8")
    after = (FIXTURES / f"{name}.after.nddl").read_text(encoding="utf-8")
    assert format_text(before).text == after
    assert format_text(after).text == after


def tree_after(text: str) -> str:
    """The formatted text, which has the same tree and is in the style already."""
    formatted = format_text(text).text
    assert same_tree(parse(Source("t", text)).module, parse(Source("t", formatted)).module)
    assert format_text(formatted).text == formatted
    return formatted


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("", ""),
        ("\n\n", ""),
        ("// alone", "// alone\n"),
        ("\ufeffint  a;", "\ufeffint a;\n"),
        ("\n\ufeff", "\n\ufeff\n"),
        ("int  a;\r\nint  b;\r\n", "int a;\r\nint b;\r\n"),
        ("int a;\n\n\n\nint b;\n", "int a;\n\nint b;\n"),
        ("class A {\n\n  int a;\n\n\n  int b;\n\n}\n", "class A {\n    int a;\n\n    int b;\n}\n"),
        ('string s="a\r\n  b";', 'string s = "a\r\n  b";\r\n'),
        ("x == - 1;", "x == - 1;\n"),
        ("x == a - -1;", "x == a - -1;\n"),
        ("int a = [-1 -x];", "int a = [-1 -x];\n"),
        ("T::p ;", "T::p;\n"),
        ("T::p { ; }", "T::p { }\n"),
        ("T::p { /* c */ }", "T::p {  /* c */\n}\n"),
        ("T::p {\n  if (a) { b; } // why\n  else { c; }\n}", None),
        ("T::p { if (a)\n // b\n c; }", "T::p {\n    if (a)\n        // b\n        c;\n}\n"),
        ("class A { };\n;\nint a;", "class A { }\nint a;\n"),
        ("/// doc\n;\nint a;", "/// doc\n;\nint a;\n"),
        ("int a; /// not doc\nint b;", "int a;  /// not doc\nint b;\n"),
        ("int a; int b;\n  int c;", "int a; int b;\nint c;\n"),
        ("int a; class A { } int b;", "int a;\nclass A { }\nint b;\n"),
        ("x == {1} - 2;", "x == {1} - 2;\n"),
    ],
)
def test_a_small_text(before: str, after: str | None) -> None:
    formatted = tree_after(before)
    assert after is None or formatted == after


def test_statements_that_share_a_line_part_when_it_is_too_long() -> None:
    statement = "a_rather_long_name == another_rather_long_name;"
    assert tree_after(" ".join([statement] * 3)) == f"{statement} {statement}\n{statement}\n"


def test_a_block_on_one_line_opens_when_it_is_too_long() -> None:
    short = "T::p { a_rather_long_name == another_name; b == 3; }\n"
    assert tree_after(short) == short
    long = "T::p { a_rather_long_name == another_name; a_rather_long_name == another_name; b == 3; cccccccccccc; }\n"
    assert tree_after(long).startswith("T::p {\n    a_rather_long_name == another_name; a_rather")


def test_what_is_no_portable_text_is_formatted_in_nddl3_too() -> None:
    assert format_text("x == a-1;\nint  b=1+2;", Dialect.NDDL3).text == "x == a - 1;\nint b = 1 + 2;\n"


def test_complaints_come_with_the_text() -> None:
    formatted = format_text("int = 3;\nint   a;\n")
    assert formatted.text == "int = 3;\nint a;\n"
    assert [complaint.code.id for complaint in formatted.diagnostics] == ["NDDL110"]
