"""A rule that lacks a declaration which another rule has, or which its members tell, gets it as help."""

import pytest

from nddl_lang.analysis import analyse_text

MODEL = """\
class Place { int miles; }
class Station extends Place { int light; }
class Quay extends Station { int depth; }
class Buoy { int depth; }
class Crane extends Timeline { predicate Hoist { int crates; int load; } predicate Drop { int crates; } }
class Boat extends Timeline {
    predicate Sail { int miles; }
    predicate Tow { int miles; }
    predicate Lift { int crates; }
}
Boat::Sail {
    if (miles > 3) {
        USE
    }
}
Boat::Tow {
    Buoy mark;
    mark.depth == miles;
    meets(object.Lift lift);
}
"""


@pytest.mark.parametrize(
    ("use", "title", "note"),
    [
        ("rock.light == miles; rock.miles >= 2;", "declare `Station rock;`", None),
        ("rock.depth == miles;", None, None),  # two classes have it
        ("mark.depth == miles;", "declare `Buoy mark;`", "another rule declares its own `mark` here"),
        ("hook.load == miles; hook before this; hook.crates == 3;", "ask for `contains(Crane.Hoist hook);`", None),
        ("hook.crates == miles;", None, None),  # two predicates have it
        ("lift.crates == miles;", None, "another rule asks for its own `lift` here; a rule sees no token of another"),
    ],
)
def test_a_name_without_declaration(use: str, title: str | None, note: str | None) -> None:
    (one,) = analyse_text("model.nddl", MODEL.replace("USE", use)).diagnostics
    assert one.span.line == 13
    assert [fix.title for fix in one.fixes] == ([title] if title else [])
    assert all(edit.span.line == 12 for fix in one.fixes for edit in fix.edits)
    assert [each.message for each in one.notes] == ([note] if note else [])


def test_an_unknown_type_is_told_where_it_stands_first() -> None:
    text = "class Boat {\n    Lamp lamp;\n    Boat(Lamp l) { lamp = l; }\n}\n"
    (one,) = analyse_text("model.nddl", text).diagnostics
    assert one.span.line == 2
