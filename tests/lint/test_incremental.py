"""An edit leads to the same findings as linting the text anew."""

import random

from nddl_lang.analysis import Analyser, analyse
from nddl_lang.lint.linter import Linter, lint
from nddl_lang.syntax.incremental import Incremental
from nddl_lang.text.diagnostic import Diagnostic
from tests.semantics.test_incremental import loaded

MODEL = """\
enum Color { red, green, blue }
int LEAST = 3;
int MOST = 5;
float RATE = [0.1 4.0];
class Lamp extends Timeline {
  int watts;
  predicate dark { }
  predicate lit { Color color; int level = [0 10]; bool warm; }
}
class Spot extends Lamp { }
Lamp::lit {
  int twice, unused;
  float drawn;
  drawn == sampledParameter(RATE);
  level <= drawn;
  meets(Lamp.dark d);
  met_by(dark e);
  if (level == 12) { d before e; }
  if (twice == LEAST) { color == red; } else if (color == green) { duration == 0; }
}
Spot::lit { contains(dark d); d.duration >= 7; duration <= MOST; }
Lamp lamp = new Lamp();
close();
goal(lamp.lit g);
g.level = 3; // nddlc: ignore NDDL554
"""
CHANGES = [
    ("level = [0 10]", "level = [0 20]"),
    ("LEAST = 3", "LEAST = 4"),
    ("MOST = 5", "MOST = 9"),
    ("d before e", "e before d"),
    ("[0.1 4.0]", "2.0"),
    ("goal(lamp.lit g)", "goal(lamp.dark g)"),
    ("int twice, unused", "int twice"),
    ("bool warm; ", ""),
    ("green, blue", "green"),
    ("class Spot extends Lamp { }", "class Spot extends Lamp { int kind; }"),
    ("duration <= MOST", "duration <= LEAST + MOST"),
    ("close();\n", ""),
    ("close();", "close(); // nddlc: ignore-file NDDL5"),
]


class Editor:
    """A text under edit, with what is kept from one lint to the next."""

    def __init__(self) -> None:
        self.incremental = Incremental("model.nddl")
        self.analyser = Analyser()
        self.linter = Linter()

    def update(self, text: str) -> tuple[Diagnostic, ...]:
        """What is found in the text as it is now."""
        parse = self.incremental.update(text)
        return self.linter.lint(self.analyser.analyse(loaded(text, lambda *_: parse)))


def picture(found: tuple[Diagnostic, ...]) -> list[object]:
    """What of findings must not depend on how they came about."""
    return [
        (each.code.id, each.span.begin, each.span.finish, each.message, [note.message for note in each.notes])
        for each in found
    ]


def test_edits_lead_to_the_findings_of_the_new_text() -> None:
    chance = random.Random(3)
    editor, text = Editor(), MODEL
    for _ in range(150):
        before, after = chance.choice(CHANGES)
        text = text.replace(before, after, 1) if before in text else text.replace(after, before, 1)
        if chance.random() < 0.3:
            at = text.index("\n", chance.randrange(len(text) - 40)) + 1
            text = text[:at] + chance.choice(["\n", "// a remark\n", "int "]) + text[at:]
        assert picture(editor.update(text)) == picture(lint(analyse(loaded(text)))), text
        if chance.random() < 0.2:
            text = MODEL


def test_what_an_edit_leaves_alone_is_not_linted_again() -> None:
    editor = Editor()
    editor.update(MODEL)
    kept = dict(editor.linter.known)
    editor.update(MODEL.replace("d before e", "e before d"))
    assert len(set(editor.linter.known) - set(kept)) == 1
