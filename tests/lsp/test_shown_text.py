"""What the editor shows of a text is kept over an edit where the edit leaves it, and is right everywhere."""

import random

from lsprotocol.types import Diagnostic

from lsp.documents import Documents

URI = "untitled:model"
UNIT = "class {0} extends Timeline {{ predicate p {{ int load; }} }}\n{0} {0}_ = new {0}();\n"
MODEL = "".join(UNIT.format(name) for name in ("A", "B", "C", "D")) + "close();\nA::p { int unused; meets(p q); }\n"
PIECES = ["x", "\n", "\r\n", "\r", "\n\n", " ", "é", "int ", "// nothing\n", "}", "𝄞"]


def shown(documents: Documents, version: int, text: str) -> tuple[Diagnostic, ...]:
    news = documents.change(URI, version, [(None, text)])
    return next(tuple(each.diagnostics) for each in news if each.uri == URI)


def test_random_edits_show_what_a_new_session_shows() -> None:
    chance = random.Random(4)
    documents, text = Documents(), MODEL
    documents.open(URI, 1, text)
    for version in range(2, 45):
        at = chance.randrange(len(text))
        text = text[:at] + chance.choice(["", *PIECES]) + text[at + chance.choice([0, 0, 1, 3]) :]
        fresh = Documents().open(URI, version, text)
        assert shown(documents, version, text) == tuple(fresh[0].diagnostics), text
        if chance.random() < 0.4:
            text = MODEL


def test_what_an_edit_leaves_in_its_place_is_not_converted_again() -> None:
    documents = Documents()
    documents.open(URI, 1, MODEL)
    before = shown(documents, 2, MODEL.replace("p q", "p qq"))
    assert len(before) > 3
    assert len(shown(documents, 3, MODEL.replace("p q);", "p q"))) == 1  # an error takes the findings back
    after = shown(documents, 4, MODEL.replace("p q", "p qqq"))
    anew = [each for each in after if not any(each is old for old in before)]
    assert len(after) == len(before) > len(anew)
    assert {each.range.start.line for each in anew} == {MODEL.count("\n") - 1}  # the rule that was edited
