"""An edit leads to the same analysis as reading the text anew, at the cost of what it touches."""

import random
from pathlib import Path

from nddl_lang.analysis import Analyser, Analysis, analyse
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import LoadedModules, load_module_graph
from nddl_lang.syntax.incremental import Incremental
from nddl_lang.syntax.parser import Parse
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Source

MODEL = """\
enum Color { red, green, blue }
typedef int [0 100] Percent;
class Bulb { int watts; Bulb(int w) { watts = w; } }
class Lamp extends Timeline {
  Bulb bulb;
  Lamp(int w) { bulb = new Bulb(w); }
  predicate dark { }
  predicate lit { Color color; Percent level; }
}
class Spot extends Lamp { int angle; Spot(int a) { super(40); angle = a; } predicate lit { int turn; } }
Percent LEAST = 10;
Lamp::lit {
  met_by(dark d);
  if (color == red) { level <= 50; Lamp other; any(other.dark e); e before d; } else { level >= LEAST; }
}
Lamp::dark { duration >= 2; meets(object.lit l); l.level == LEAST + 5; }
Spot::lit { turn <= object.angle; }
Lamp lamp = new Lamp(60);
Spot spot = new Spot(30);
close();
goal(lamp.lit g);
rejectable(spot.lit h);
g.color = red;
g.level = [20 80];
h.turn == 15;
g before h;
g.activate();
"""
PIECES = [
    "int ",
    "x",
    ";",
    "}",
    "{",
    "red",
    "Lamp",
    "lit",
    " = 3",
    "g.",
    "3000",
    "close();",
    "new ",
    "//",
    '"',
    "(",
    "\n",
]


class Editor:
    """A text under edit, with what is kept from one analysis to the next."""

    def __init__(self) -> None:
        self.incremental = Incremental("model.nddl")
        self.analyser = Analyser()

    def update(self, text: str) -> Analysis:
        """The analysis of the text as it is now."""
        return self.analyser.analyse(loaded(text, self.parse))

    def parse(self, path: Path, source: Source, dialect: Dialect, is_in_class: bool) -> Parse:
        """The parse of the text, from what is kept."""
        assert (path.name, dialect, is_in_class) == ("model.nddl", Dialect.NDDLC, False)
        return self.incremental.update(source.text)


def loaded(text: str, parse_text: object = None) -> LoadedModules:
    """The text as it is read for an analysis."""
    source = Source("model.nddl", text)
    return load_module_graph(source, parse_text=parse_text)  # type: ignore[arg-type]


def notes(diagnostic: Diagnostic) -> list[object]:
    """What the notes of a diagnostic say, and where they point."""
    return [(note.message, note.span and note.span.begin) for note in diagnostic.notes]


def picture(analysis: Analysis) -> list[object]:
    """What of an analysis must not depend on how it came about."""
    complaints = [
        (each.code.id, each.span.begin, each.span.finish, each.message, each.help, notes(each), each.fixes[:1] != ())
        for each in analysis.diagnostics
    ]
    tables = analysis.tables
    names = sorted((path.span.begin, type(found).__name__) for path, found in tables.references.items())  # type: ignore[attr-defined]
    types = sorted((node.span.begin, node.span.finish, type_.name) for node, type_ in tables.types.items())  # type: ignore[attr-defined]
    schema = analysis.schema
    return [complaints, names, types, list(schema.classes), list(schema.globals), list(schema.goals), len(schema.rules)]


def test_random_edits_lead_to_the_analysis_of_the_new_text() -> None:
    chance = random.Random(6)
    for _ in range(12):
        editor, text = Editor(), MODEL
        editor.update(text)
        for _ in range(25):
            at = chance.randrange(len(text))
            text = text[:at] + chance.choice(["", *PIECES]) + text[at + chance.choice([0, 0, 1, 4]) :]
            assert picture(editor.update(text)) == picture(analyse(loaded(text))), text
            if chance.random() < 0.4:
                text = MODEL


def test_an_edit_in_a_rule_checks_that_rule_only() -> None:
    editor = Editor()
    before = editor.update(MODEL)
    after = editor.update(MODEL.replace("level <= 50", "level <= 5"))
    anew = {node for node, tables in after.by_statement.items() if tables is not before.by_statement.get(node)}
    assert anew == set(after.statements) - set(before.statements)
    assert len(anew) == 1


def test_an_edit_in_a_class_reaches_the_rules_that_use_it() -> None:
    editor = Editor()
    assert editor.update(MODEL).diagnostics == ()
    found = editor.update(MODEL.replace("Percent level; }", "Percent depth; }")).diagnostics
    assert {each.span.text for each in found} == {"level"}
    assert editor.update(MODEL).diagnostics == ()


def test_texts_in_another_order_are_analysed_as_if_read_anew() -> None:
    texts = {"one.nddl": "int a = 1;\nfloat shared = 1.0;\n", "two.nddl": "int b = 2;\nint shared = 2;\n"}
    kept = {name: Incremental(name) for name in ("model.nddl", *texts)}
    analyser = Analyser()

    def parse(path: Path, source: Source, dialect: Dialect, is_in_class: bool) -> Parse:
        return kept[path.name].update(source.text)

    def read(text: str, parse_text: object = None) -> LoadedModules:
        source = Source("model.nddl", text)
        open_text = lambda path: texts.get(str(path))  # noqa: E731
        return load_module_graph(source, open_text=open_text, parse_text=parse_text)  # type: ignore[arg-type]

    uses = "class C { int n; C(int m) { n = m; } }\nC c = new C(shared);\nint d = b;\n"
    one, two = '#include "one.nddl"\n', '#include "two.nddl"\n'
    for text in (one + two + uses, two + one + uses, one + uses, uses + two, one + two + uses, uses, two + uses + one):
        assert picture(analyser.analyse(read(text, parse))) == picture(analyse(read(text))), text
