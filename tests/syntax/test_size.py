"""A model of more lexemes than anybody can follow is one complaint, wherever they stand, and costs little."""

import random
from pathlib import Path

import pytest

from nddl_lang.analysis import analyse
from nddl_lang.formatter.format import format_text
from nddl_lang.lint.check import Checker
from nddl_lang.lint.configuration import read_configuration
from nddl_lang.lint.settings import Settings
from nddl_lang.syntax import codes
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import load_module_graph
from nddl_lang.syntax.incremental import Incremental
from nddl_lang.syntax.parser import parse
from nddl_lang.text.render import as_dict
from nddl_lang.text.source import Source

# Of 20 lexemes, each in another way.
TWENTY = {
    "statements": "int a;\n" * 5 + "int a = 1;",
    "a line": "int a; " * 6 + "a;",
    "one statement": "int a, b, c, d, e, f, g, h, i = 1;",
    "comments": "/* a */ // b\n" * 10,
    "signs": "@ a " * 10,
    "braces": "{}" * 10,
    "quotes": "'a' " * 20,
    "an include that is no file": '#include "b"\n' * 10,
    "a comment before a statement": "int a; // b\n" * 4 + "int b /* */;",
}


@pytest.mark.parametrize("text", TWENTY.values(), ids=TWENTY)
def test_each_lexeme_and_comment_counts(text: str) -> None:
    assert parse(Source("m", text), most=40).pieces  # what means nothing counts as itself and as a complaint
    for most in range(1, 20):
        found = parse(Source("m", text), most=most)
        assert [each.code for each in found.diagnostics] == [codes.TOO_LARGE]
        assert not found.pieces and not found.module.statements and found.size > most


def test_the_place_is_where_the_limit_is_passed() -> None:
    (told,) = parse(Source("m", "int a;\n" * 10), most=13).diagnostics
    assert (told.span.line, told.message) == (5, "here the model has more than 13 lexemes, and is not read")
    assert told.help == "`max-lexemes` in nddlc.toml allows up to 1000000"


def test_a_text_that_is_edited_is_too_large_when_a_cold_start_says_so() -> None:
    chance = random.Random(5)
    texts = [f"{each}\n" for each in TWENTY.values()]
    incremental = Incremental("m", most=70)
    seen = set()
    for _ in range(400):
        text = "".join(chance.choices(texts, k=chance.randrange(2, 6)))[chance.randrange(9) :]
        warm, cold = incremental.update(text), parse(Source("m", text), most=70)
        assert list(map(as_dict, warm.diagnostics)) == list(map(as_dict, cold.diagnostics))
        assert (len(warm.pieces), warm.size) == (len(cold.pieces), cold.size)
        seen.add(bool(warm.pieces))
    assert seen == {True, False}


def test_includes_count_together_and_the_include_that_is_too_much_is_named(tmp_path: Path) -> None:
    (tmp_path / "part.nddl").write_text("int a = b;\n" * 30, encoding="utf-8")
    (tmp_path / "more.nddl").write_text("int c = d;\n" * 30, encoding="utf-8")
    model = tmp_path / "m.nddl"
    model.write_text('#include "part.nddl"\n#include "more.nddl"\nFoo x;\n', encoding="utf-8")
    (told,) = analyse(load_module_graph(model, most=200)).diagnostics
    assert (told.code, told.span.source.name, told.span.line) == (codes.TOO_LARGE, str(model), 2)
    (told,) = analyse(load_module_graph(model, most=100)).diagnostics
    assert (told.code, told.span.source.name, told.span.line) == (codes.TOO_LARGE, str(tmp_path / "part.nddl"), 21)
    (note,) = told.notes
    assert note.span is not None and note.span.source.name == str(model)
    assert codes.TOO_LARGE not in {each.code for each in analyse(load_module_graph(model, most=400)).diagnostics}


def test_a_project_sets_its_own_limit(tmp_path: Path) -> None:
    path, model = tmp_path / "nddlc.toml", tmp_path / "m.nddl"
    path.write_text("max-lexemes = 9\n", encoding="utf-8")
    model.write_text("Foo a;\nBar b;\nBaz c;\nQux d;\n", encoding="utf-8")
    settings, complaints = read_configuration(path)
    assert (settings.most_lexemes, complaints) == (9, [])
    (told,) = Checker().check(model, settings)
    assert (told.code, told.span.line) == (codes.TOO_LARGE, 4)
    assert len(Checker().check(model, Settings())) == 4


@pytest.mark.parametrize("value", ["0", "-1", "1000001", "true", '"many"', "1.5"])
def test_a_limit_that_is_none_is_refused(value: str, tmp_path: Path) -> None:
    path = tmp_path / "nddlc.toml"
    path.write_text(f"max-lexemes = {value}\n", encoding="utf-8")
    settings, (told,) = read_configuration(path)
    assert settings.most_lexemes == Settings().most_lexemes
    assert "a whole number from 1 to 1000000" in told.message


def test_what_is_not_read_is_not_formatted() -> None:
    text = "int   a ;\n" * 10
    formatted = format_text(text, Dialect.NDDLC, "m", 9)
    assert formatted.text == text
    assert [each.code for each in formatted.diagnostics] == [codes.TOO_LARGE]
