"""What is no TOML is told at its place, with what was probably meant."""

import tomllib

import pytest

from nddl_lang.lint.codes import NOT_TOML
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Source
from nddl_lang.text.toml_slips import not_toml
from nddl_lang.text.values import toml_value


def told(text: str) -> Diagnostic:
    with pytest.raises(tomllib.TOMLDecodeError) as problem:
        toml_value(text)
    return not_toml(NOT_TOML, Source("mission.toml", text), str(problem.value))


def mended(text: str, complaint: Diagnostic) -> str:
    (edit,) = complaint.fixes[0].edits
    return text[: edit.span.begin] + edit.text + text[edit.span.finish :]


@pytest.mark.parametrize(
    ("text", "line", "meant"),
    [
        ("[m]\nmodel = planner.nddl\n", 2, {"m": {"model": "planner.nddl"}}),
        ("mandatory = True\n", 1, {"mandatory": True}),
        ("mandatory = no # why\n", 1, {"mandatory": False}),
        ("seed == 5\n", 1, {"seed": 5}),
        ("seed = = 5\n", 1, {"seed": 5}),
        ("rate = .5\n", 1, {"rate": 0.5}),
        ("rate = 5.\n", 1, {"rate": 5.0}),
        ('a = 1\nname: "x"\n', 2, {"a": 1, "name": "x"}),
        ("seed = 5;\n", 1, {"seed": 5}),
        ("// what it is\nseed = 1\n", 1, {"seed": 1}),
        ("seed = 1 // why\n", 1, {"seed": 1}),
        ("-- what it is\nseed = 1\n", 1, {"seed": 1}),
        ("start = [5; 60]\n", 1, {"start": [5, 60]}),
        ("a = [1, 2\nb = 3\n", 1, {"a": [1, 2], "b": 3}),
        ("a = [1, 2\n\n[m]\nb = [3]\n", 1, {"a": [1, 2], "m": {"b": [3]}}),
        ("b = [3]\na = [1, 2", 2, {"b": [3], "a": [1, 2]}),
        ("[goal]\na = 1\n[[goal]]\na = 2\n", 1, {"goal": [{"a": 1}, {"a": 2}]}),
        ("[[goal]]\na = 1\n\n  [goal]\na = 2\n", 4, {"goal": [{"a": 1}, {"a": 2}]}),
    ],
)
def test_the_fix_writes_what_was_meant(text: str, line: int, meant: object) -> None:
    complaint = told(text)
    assert complaint.span.line == line
    assert complaint.help
    assert toml_value(mended(text, complaint)) == meant


@pytest.mark.parametrize(
    ("text", "line", "help_"),
    [
        ("start = 5, 60\n", 1, "a list stands in brackets: `[5, 60]`"),
        ("start = (5, 60)\n", 1, "a list stands in brackets: `[5, 60]`"),
        ("seed = 05\n", 1, "a number does not begin with 0"),
        ("seed =\n", 1, "the key has no value"),
        ("seed = None\n", 1, "what has no value is left out"),
        ("seed\n", 1, "a line is a header, as `[mission]`, or a key with its value, as `seed = 1`"),
        ('name = "a\nb = 2\n', 1, "the quotes of a text close in its line"),
        ('data = "C:\\data"\n', 1, "a `\\` is written `\\\\`; paths take `/` everywhere"),
        ("[mission\nseed = 1\n", 1, "a header is closed by `]`, or `]]` if `[[` opened it"),
        ("a = [1\n2]\n", 2, "values of a list stand between commas"),
        ("[m]\na = 1\n[m]\nb = 2\n", 3, "a table is written once, with all its keys"),
        ("a = 1\na = 2\n", 2, "a key is written once"),
    ],
)
def test_what_helps_is_said(text: str, line: int, help_: str) -> None:
    complaint = told(text)
    assert (complaint.span.line, complaint.help, complaint.fixes) == (line, help_, ())


def test_a_text_too_deep_is_told_at_its_begin() -> None:
    assert told("a = " + 5000 * "[" + 5000 * "]" + "\n").span.line == 1
