"""A diagnostic is shown with its text, as people read it and as programs do."""

import textwrap

import pytest

from nddl_lang.text.diagnostic import Code, Edit, Fix, Note, Severity
from nddl_lang.text.render import apply_edits, as_dict, render
from nddl_lang.text.source import Anchor, Source, Span

UNKNOWN = Code("NDDL201", Severity.ERROR, "name", "nothing named `{name}` is in scope")
UNUSED = Code("NDDL501", Severity.WARNING, "lint", "`{name}` is never used")


def place(text: str, what: str, name: str = "m.nddl") -> Span:
    """Where `what` stands in `text`."""
    start = text.index(what)
    return Span(Anchor(Source(name, text)), start, start + len(what))


def page(text: str) -> str:
    return textwrap.dedent(text).lstrip("\n")


def test_a_diagnostic_points_at_its_text() -> None:
    span = place("int a;\nLamp l = new Lmap();\n", "Lmap")
    assert render(UNKNOWN.at(span, name="Lmap", help="did you mean `Lamp`?")) == page("""
        error[NDDL201]: nothing named `Lmap` is in scope
         --> m.nddl:2:14
          |
        2 | Lamp l = new Lmap();
          |              ^^^^
          |
          = help: did you mean `Lamp`?
        """)


def test_notes_show_the_other_half() -> None:
    text = "int a;\n" * 9 + "int b;\n"
    notes = (Note("declared here", place(text, "a")), Note("names are global"))
    assert render(UNUSED.at(place(text, "b"), name="b", notes=notes)) == page("""
        warning[NDDL501]: `b` is never used
          --> m.nddl:10:5
           |
        10 | int b;
           |     ^
           |
           = note: names are global
        note: declared here
          --> m.nddl:1:5
           |
         1 | int a;
           |     -
        """)


def test_a_fix_shows_the_lines_before_and_after() -> None:
    text = "T::p {\n    x = 3;\n}\n"
    fix = Fix("write `==`", (Edit(place(text, "="), "=="),))
    assert render(UNUSED.at(place(text, "x = 3;"), name="x", fixes=(fix,))) == page("""
        warning[NDDL501]: `x` is never used
         --> m.nddl:2:5
          |
        2 |     x = 3;
          |     ^^^^^^
        help: write `==`
          |
        2 -     x = 3;
        2 +     x == 3;
        """)


def test_a_fix_may_take_lines_away_or_add_some() -> None:
    text = "int a;\nint b;\nint c;\n"
    gone = Fix("remove it", (Edit(place(text, "int b;\n"), ""),), safe=False)
    shown = render(UNUSED.at(place(text, "b"), name="b", fixes=(gone,)))
    assert "help: remove it (check the meaning)\n  |\n2 - int b;\n" in shown
    more = Fix("split it", (Edit(place(text, "b"), "b;\nint d"),))
    assert "2 - int b;\n2 + int b;\n3 + int d;\n" in render(UNUSED.at(place(text, "b"), name="b", fixes=(more,)))


def test_wide_letters_and_tabs_keep_the_carets_in_place() -> None:
    text = '\tstring s = "漢字e\u0301"; int q;\n'
    assert render(UNUSED.at(place(text, "q"), name="q")) == page("""
        warning[NDDL501]: `q` is never used
         --> m.nddl:1:25
          |
        1 |     string s = "漢字e\u0301"; int q;
          |                             ^
        """)


def test_an_empty_stretch_gets_one_caret() -> None:
    text = "int a = 1\n"
    span = Span(Anchor(Source("m.nddl", text)), 9, 9)
    assert render(UNUSED.at(span, name="a")).endswith("1 | int a = 1\n  |          ^\n")


def test_a_stretch_of_several_lines_is_framed() -> None:
    text = "T::p {\n    if (x) {\n        y;\n    }\n}\n"
    assert render(UNUSED.at(place(text, text[11:-3]), name="x")) == page("""
        warning[NDDL501]: `x` is never used
         --> m.nddl:2:5
          |
        2 |       if (x) {
          |  _____^
        3 | |         y;
        4 | |     }
          | |_____^
        """)


def test_a_long_stretch_shows_its_ends() -> None:
    text = "class A {\n" + "    int x;\n" * 20 + "}\n"
    shown = render(UNUSED.at(place(text, text.rstrip()), name="A"))
    assert shown.splitlines()[3:] == [
        " 1 |   class A {",
        "   |  _^",
        " 2 | |     int x;",
        "...",
        "21 | |     int x;",
        "22 | | }",
        "   | |_^",
    ]


def test_a_line_too_long_is_shown_around_the_place() -> None:
    text = "x" * 500 + " here " + "y" * 500
    line, carets = render(UNUSED.at(place(text, "here"), name="x")).splitlines()[3:5]
    assert len(line) < 200
    assert line[carets.index("^") :].startswith("here")


@pytest.mark.parametrize("letter", ["x", "é"])
@pytest.mark.parametrize("before", [0, 139, 9_999, 19_930, 20_000, 29_999, 30_000, 10**6])
def test_a_line_without_an_end_is_shown_like_a_long_one(letter: str, before: int) -> None:
    shown = render(UNKNOWN.at(place(letter * before + "NAME" + letter * 10**5, "NAME"), name="NAME"))
    line, carets = shown.splitlines()[3:5]
    assert line[carets.index("^") : carets.index("^") + 5] == "NAME" + letter
    assert carets.count("^") == 4 and line.endswith("...") and len(line) < 160


def test_what_cannot_be_printed_is_replaced() -> None:
    text = "a \x1b[31m b\n"
    shown = render(UNUSED.at(place(text, "b"), name="b"))
    assert "\x1b" not in shown
    assert shown.endswith("1 | a \ufffd[31m b\n  |         ^\n")


def test_colours_add_nothing_but_colours() -> None:
    text = "T::p {\n    x = 3;\n}\n"
    fix = Fix("write `==`", (Edit(place(text, "="), "=="),))
    notes = (Note("here", place(text, "T")), Note("there"))
    complaint = UNUSED.at(place(text, "x"), name="x", fixes=(fix,), notes=notes, help="look")
    painted = render(complaint, colour=True)
    assert "\x1b[1;33m" in painted
    for escape in ("\x1b[0m", "\x1b[1m", "\x1b[1;34m", "\x1b[32m", "\x1b[31m", "\x1b[1;33m"):
        painted = painted.replace(escape, "")
    assert painted == render(complaint)


def test_a_program_reads_places_and_mends() -> None:
    text = "int a;\nint b;\n"
    fix = Fix("remove it", (Edit(place(text, "int b;\n"), ""),), safe=False)
    notes = (Note("see", place(text, "a")), Note("so"))
    assert as_dict(UNUSED.at(place(text, "b"), name="b", fixes=(fix,), notes=notes, help="remove it")) == {
        "code": "NDDL501",
        "severity": "warning",
        "kind": "lint",
        "message": "`b` is never used",
        "file": "m.nddl",
        "line": 2,
        "column": 5,
        "end_line": 2,
        "end_column": 6,
        "help": "remove it",
        "notes": [
            {"message": "see", "file": "m.nddl", "line": 1, "column": 5, "end_line": 1, "end_column": 6},
            {"message": "so"},
        ],
        "fixes": [
            {
                "title": "remove it",
                "safe": False,
                "edits": [
                    {"file": "m.nddl", "line": 2, "column": 1, "end_line": 3, "end_column": 1, "text": ""},
                ],
            }
        ],
    }


@pytest.mark.parametrize(
    ("edits", "result"),
    [
        ([(0, 1, "X")], "Xbcd"),
        ([(4, 4, "!")], "abcd!"),
        ([(2, 3, ""), (0, 0, "(")], "(abd"),
        ([(0, 2, "X"), (1, 3, "Y")], "Xcd"),
        ([], "abcd"),
    ],
)
def test_edits_are_applied_in_order_and_never_overlap(edits: list[tuple[int, int, str]], result: str) -> None:
    anchor = Anchor(Source("t", "abcd"))
    assert apply_edits("abcd", [Edit(Span(anchor, start, end), text) for start, end, text in edits]) == result
