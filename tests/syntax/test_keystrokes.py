"""Whatever is typed, pasted, joined or moved: the incremental parse equals a cold one after each step.

NDDLC_FUZZ sets how many scripts of edits are tried, in four parts.
"""

import os
import random
from collections.abc import Callable, Iterator

import pytest

from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.incremental import Incremental
from nddl_lang.syntax.parser import Parse, parse
from nddl_lang.text.source import Source
from tests.syntax.corpus import SNIPPETS, texts

SCRIPTS = int(os.environ.get("NDDLC_FUZZ", "800"))
LONGEST = 600
PIECES = [*SNIPPETS, "#", "# foo", '#inclde "a.nddl"', "else", "'abc'", "/* a */", "\n}\n", "int a", "+ inf", "-inff"]


def picture(parsed: Parse) -> list[object]:
    """Everything of a parse that must not depend on how the text came about."""
    return [
        [(one.code.id, one.message, one.help, one.span.begin, one.span.finish) for one in parsed.diagnostics],
        [(type(one).__name__, one.span.begin, one.span.finish) for one in parsed.module.statements],
        [(span.begin, span.finish) for span in parsed.comments],
        [(piece.anchor.offset, piece.length, piece.kinds, piece.texts, piece.docs) for piece in parsed.pieces],
    ]


def typed(chance: random.Random, text: str) -> Iterator[str]:
    """Something typed letter by letter, and some of it deleted again."""
    added = "".join(chance.choice(PIECES) for _ in range(chance.randrange(1, 4)))
    at = chance.randrange(len(text) + 1)
    for end in [*range(1, len(added) + 1), *range(len(added), chance.randrange(len(added) + 1), -1)]:
        yield text[:at] + added[:end] + text[at:]


def pasted(chance: random.Random, text: str) -> Iterator[str]:
    """Stretches replaced or deleted."""
    for _ in range(chance.randrange(1, 8)):
        at = chance.randrange(len(text) + 1)
        end = at + int(chance.expovariate(0.1))
        text = text[:at] + chance.choice(["", *PIECES]) + text[end:]
        yield text


def joined(chance: random.Random, text: str) -> Iterator[str]:
    """Lines joined and split."""
    for _ in range(chance.randrange(1, 6)):
        ends = [at for at, sign in enumerate(text) if sign == "\n"]
        if ends and chance.random() < 0.6:
            at = chance.choice(ends)
            text = text[:at] + text[at + 1 :]
        else:
            at = chance.randrange(len(text) + 1)
            text = f"{text[:at]}\n{text[at:]}"
        yield text


def moved(chance: random.Random, text: str) -> Iterator[str]:
    """Stretches cut and pasted elsewhere."""
    for _ in range(chance.randrange(1, 5)):
        at = chance.randrange(len(text) + 1)
        stretch = text[at : at + chance.randrange(60)]
        text = text[:at] + text[at + len(stretch) :]
        at = chance.randrange(len(text) + 1)
        text = text[:at] + stretch + text[at:]
        yield text


@pytest.mark.parametrize("script", [typed, pasted, joined, moved])
def test_every_edit_leads_to_the_parse_of_the_new_text(script: Callable[[random.Random, str], Iterator[str]]) -> None:
    for seed in range(SCRIPTS // 4):
        chance = random.Random(seed)
        dialect = chance.choice(list(Dialect))
        text = chance.choice(texts())
        begin = chance.randrange(max(1, len(text) - LONGEST // 2))
        text = chance.choice(["", text[begin : begin + chance.randrange(LONGEST)]])
        incremental = Incremental("t", dialect)
        incremental.update(text)
        for step in script(chance, text):
            assert picture(incremental.update(step)) == picture(parse(Source("t", step), dialect)), (seed, step)


def test_an_include_typed_letter_by_letter_leaves_no_complaint() -> None:
    incremental = Incremental("t")
    line = '#include "a.nddl"'
    for end in range(1, len(line) + 1):
        parsed = incremental.update(line[:end] + "\nint a;\n")
    assert parsed.diagnostics == ()


def test_an_else_behind_a_comment_that_is_closed_later_belongs_to_its_if() -> None:
    incremental = Incremental("t")
    incremental.update("T::p if (a) b;\n/* c\nelse d;\n")
    after = incremental.update("T::p if (a) b;\n/* c */\nelse d;\n")
    assert [type(statement).__name__ for statement in after.module.statements] == ["RuleDecl"]
