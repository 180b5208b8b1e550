"""Whatever a text holds, it parses to a tree and complaints, and no character is dropped.

NDDLC_FUZZ sets how many mutations are tried: `NDDLC_FUZZ=1000000 pytest tests/syntax/test_mutations.py`.
"""

import os
import random
import re
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nddl_lang.formatter.format import format_text
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.incremental import Incremental
from nddl_lang.syntax.parser import Parse, parse
from nddl_lang.syntax.walk import descendants, same_tree
from nddl_lang.text.diagnostic import Severity
from nddl_lang.text.read import decode
from nddl_lang.text.render import as_dict, render
from nddl_lang.text.source import Source
from tests.syntax.corpus import SNIPPETS, edited, mutated, texts

PARTS = 4  # that may run side by side
MUTATIONS = int(os.environ.get("NDDLC_FUZZ", "400"))
DIALECTS = list(Dialect)

TRIVIA = re.compile(r"(?:[ \t\r\n\f]++|//[^\n]*+|/\*.*?\*/)*", re.DOTALL)

anything = st.one_of(
    st.text(),
    st.lists(st.sampled_from([*SNIPPETS, "a", "b", "int", "in", "1"]), max_size=40).map(" ".join),
    st.lists(st.sampled_from([*SNIPPETS, "a", "b", "int", "in", "1"]), max_size=40).map("".join),
)


def check(text: str, dialect: Dialect) -> Parse:
    """Everything that holds for every text."""
    parsed = parse(Source("t", text), dialect)
    check_tiling(parsed)
    for diagnostic in parsed.diagnostics:
        assert 0 <= diagnostic.span.begin <= diagnostic.span.finish <= len(text)
        assert render(diagnostic) and as_dict(diagnostic)
    formatted = format_text(text, dialect).text
    again = parse(Source("t", formatted), dialect)
    assert same_tree(parsed.module, again.module)
    assert format_text(formatted, dialect).text == formatted
    return parsed


def check_tiling(parsed: Parse) -> None:
    """Every character stands in a lexeme, in a comment, or in a complaint, and pieces are not out of order."""
    text = parsed.source.text
    at = 0
    for piece in parsed.pieces:
        assert piece.anchor.offset == at and piece.length > 0
        is_clean = all(diagnostic.severity is not Severity.ERROR for diagnostic in piece.diagnostics)
        seen = at + (1 if at == 0 and text.startswith("\ufeff") else 0)
        for start, end in zip(piece.starts, piece.ends, strict=True):
            gap = TRIVIA.fullmatch(text, seen, at + start)
            assert gap is not None or not is_clean
            seen = at + end
        at += piece.length
        assert not is_clean or TRIVIA.fullmatch(text, seen, at)
        if is_clean:
            assert not any(
                type(node).__name__ == "BrokenStatement" for one in piece.statements for node in descendants(one)
            )
    assert at == len(text)


@given(anything, st.sampled_from(DIALECTS))
def test_any_text_parses(text: str, dialect: Dialect) -> None:
    check(text, dialect)


@given(st.binary(), st.sampled_from(DIALECTS))
def test_any_bytes_parse(content: bytes, dialect: Dialect) -> None:
    check(decode(content), dialect)


def test_every_text_of_the_repository_keeps_what_holds() -> None:
    for number, text in enumerate(texts()):
        check(text, DIALECTS[number % 2])


@pytest.mark.parametrize("text", ["class T { }\nT::}z;\n    b;\n}\n"])
def test_texts_that_once_broke_the_parser(text: str) -> None:
    check(text, Dialect.NDDLC)


@pytest.mark.parametrize("part", range(PARTS))
def test_mutations_keep_what_holds(part: int) -> None:
    for seed in range(part, MUTATIONS, PARTS):
        chance = random.Random(seed)
        text = mutated(chance)
        start = time.process_time()
        try:
            check(text, chance.choice(DIALECTS))
        except BaseException:
            print(f"seed {seed}: {text!r}")
            raise
        # A second for parsing twice and formatting twice 1000 lines leaves room for a slow machine.
        assert time.process_time() - start < 1 + text.count("\n") / 250, seed


def test_an_edited_text_parses_as_a_new_one() -> None:
    for seed in range(MUTATIONS // 20):
        chance = random.Random(seed)
        dialect = chance.choice(DIALECTS)
        incremental = Incremental("t", dialect)
        text = "\n".join(chance.sample(texts(), 3))
        for step in range(20):
            assert view(incremental.update(text)) == view(parse(Source("t", text), dialect)), (seed, step)
            text = edited(text, chance)


def view(parsed: Parse) -> object:
    """All of a parse that can be compared."""
    nodes = [
        (type(node).__name__, node.span.begin, node.span.finish)
        for statement in parsed.module.statements
        for node in descendants(statement)
    ]
    return list(map(as_dict, parsed.diagnostics)), nodes, [(one.begin, one.finish) for one in parsed.comments]
