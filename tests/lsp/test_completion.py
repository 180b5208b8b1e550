"""What fits a place comes first, and what cannot stand there is not offered: asked of the server at `|`."""

import time
from typing import Any

import pytest

HEAD = """\
enum Speed { Slow, Fast }
class Engine extends Timeline { predicate Burn { Speed speed; } }
class Place { int depth; Place(int d) { depth = d; } }
class Pilot extends Timeline {
  Engine engine; Place home; int age;
  Pilot(Engine e, Place h) { engine = e; home = h; }
  predicate Idle { }
  predicate Go { Speed speed; Place where; float miles; }
}
int LIMIT = 5;
Place dock = new Place(3);
Engine engine = new Engine();
Pilot pilot = new Pilot(engine, dock);
"""
RULE = """\
Pilot::Go {
  met_by(Idle before_it);
  bool quick;
  any(object.Go g);
  %s
  int later;
}
int BELOW = 3;
"""


def offered(wire: Any, text: str) -> list[str]:
    """The labels in the order in which the editor shows them."""
    before, _, after = text.partition("|")
    wire.start()
    wire.open("untitled:a", before + after)
    position = {"line": before.count("\n"), "character": len(before.rpartition("\n")[2])}
    answer = wire.ask("textDocument/completion", textDocument={"uri": "untitled:a"}, position=position)["result"]
    return [each["label"] for each in sorted(answer["items"], key=lambda each: each["sortText"])]


@pytest.mark.parametrize(
    ("typed", "first"),
    [
        ("speed == |", {"speed", "Slow", "Fast"}),
        ("g.speed == |", {"speed", "Slow", "Fast"}),
        ("g.speed == S|", {"speed", "Slow", "Fast"}),
        ("Speed s = |", {"speed", "Slow", "Fast"}),
        ("where == |", {"where", "dock"}),
        ("quick == |", {"quick", "true", "false"}),
        ("where.depth <= |", {"LIMIT", "miles", "start", "end", "duration"}),
        ("duration <= 2 * |", {"LIMIT", "miles", "start", "end", "duration"}),
        ("eq(speed, |", {"speed", "Slow", "Fast"}),
        ("mulEq(miles, |", {"LIMIT", "miles", "start", "end", "duration"}),
        ("if (speed == |) { }", {"speed", "Slow", "Fast"}),
        ("if (quick) { speed == |; }", {"speed", "Slow", "Fast"}),
    ],
)
def test_values_of_the_type_that_is_expected_come_first(typed: str, first: set[str], wire: Any) -> None:
    names = offered(wire, HEAD + RULE % typed)
    assert first <= set(names[: len(first) + 6])
    others = {"Slow", "true", "dock", "LIMIT", "INACTIVE", "pilot"} - first
    assert others <= set(names)
    assert max(map(names.index, first)) < min(map(names.index, others))


@pytest.mark.parametrize(
    ("typed", "first"),
    [
        ("Place other = new Place(|", "LIMIT"),
        ("Pilot other = new Pilot(engine, |", "dock"),
        ("Pilot other = new Pilot(|", "engine"),
        ("Place other = |", "dock"),
        ("Speed other = |", "Slow"),
        ("Pilot other = new |", "Pilot"),
        ("Place other = new P|", "Place"),
    ],
)
def test_an_object_is_made_of_what_its_constructor_takes(typed: str, first: str, wire: Any) -> None:
    names = offered(wire, HEAD + typed)
    assert names[0] == first
    assert "other" not in names


@pytest.mark.parametrize(
    ("typed", "names"),
    [
        ("g before |", ["before_it", "g"]),
        ("g before [1 5] |", ["before_it", "g"]),
        ("before |", ["before_it", "g"]),
        ("met_by(object.|", ["engine", "Idle", "Go"]),
        ("met_by(pilot.|", ["engine", "Idle", "Go"]),
        ("met_by(Engine.|", ["Burn"]),
        ("met_by(where.|", []),
        ("met_by(g.|", ["object"]),
        ("met_by(object.Idle |", []),
        ("Speed |", []),
        ("where.|", ["depth"]),
        ("speed == where.|", ["depth"]),
    ],
)
def test_only_what_can_stand_there_is_offered(typed: str, names: list[str], wire: Any) -> None:
    assert offered(wire, HEAD + RULE % typed) == names


def test_a_token_is_asked_for_where_there_are_predicates(wire: Any) -> None:
    names = offered(wire, HEAD + RULE % "met_by(|")
    assert {"Idle", "Go", "object", "engine", "pilot", "Engine", "Pilot"} <= set(names)
    assert not {"dock", "where", "Place", "speed", "LIMIT", "Speed"} & set(names)


def test_what_is_declared_below_or_in_another_block_is_not_offered(wire: Any) -> None:
    names = offered(wire, HEAD + RULE % "if (quick) { int inner; } else { int mine; miles <= |; }")
    assert "mine" in names
    assert not {"inner", "later", "BELOW"} & set(names)
    names = offered(
        wire, "class A { int size; A(int s) { size = s; } predicate P { int n; } predicate Q { int m; m == | } }"
    )
    assert {"m", "size"} <= set(names)
    assert not {"n", "s"} & set(names)


@pytest.mark.parametrize(("typed", "is_there"), [("goal(pilot.Go a);\na.|", True), ("pilot.|", True), ("", False)])
def test_methods_are_offered_where_they_can_be_called(typed: str, is_there: bool, wire: Any) -> None:
    names = offered(wire, HEAD + typed if typed else HEAD + RULE % "g.|")
    assert (not {"activate", "constrain"}.isdisjoint(names)) is is_there


def test_an_include_is_of_a_file(wire: Any) -> None:
    assert offered(wire, "#include |\n" + HEAD) == []


def test_a_very_long_name_is_read_once(wire: Any) -> None:
    begun = time.process_time()
    offered(wire, HEAD + "x" * 100_000 + "|")
    assert time.process_time() - begun < 20  # minutes, if it is read from each of its letters on
