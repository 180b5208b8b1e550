"""A missing line is added behind the relation whose token it is about; a choice that no line guides is told."""

from itertools import islice
from pathlib import Path
from typing import Any

import pytest

from checker.counterfactual.smallness import delay_of
from checker.counterfactual.usage import usage_of
from checker.mutation.choice import mutants_of
from checker.mutation.edits import sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.successors import with_successors
from checker.mutation.variant import load_graph
from tests.checker.checked import faults_of

pytestmark = pytest.mark.once

SHARED = """#include "TREX.nddl"
enum Rock { soft, hard }
class Drill extends AgentTimeline {
  predicate Stowed { }
  predicate Bore { float depth; Rock rock; }
  Drill(Mode m) { super(m, "Stowed"); }
}
"""
CHIEF = """#include "shared.nddl"
class Site extends AgentTimeline {
  predicate Nothing { }
  predicate Core { float depth; float width; bool wet; }
  Site(Mode m) { super(m, "Nothing"); }
}
Site::Core {
  contains(Drill.Bore bore);
  bore.depth == depth;
  bore.rock == Rock.hard;
  bore.end == end;
}
Site site = new Site(Internal);
Drill drill = new Drill(External);
close();
"""
WORLD = """#include "shared.nddl"
Drill::Bore {
  float time;
  rock == Rock.hard;
  time == depth * 40.0;
  duration == ceil(time);
}
Drill drill = new Drill(Internal);
close();
"""
MISSION = """[mission]
name = "core"
final_tick = 100
[[reactor]]
name = "chief"
model = "chief.nddl"
latency = 1
lookahead = 80
internal = ["site"]
external = ["drill"]
[[reactor]]
name = "world"
model = "world.nddl"
latency = 0
lookahead = 1
internal = ["drill"]
[[goal]]
timeline = "site"
predicate = "Core"
mandatory = true
start = [5, 20]
[goal.parameters]
depth = 0.5
width = 0.1
wet = true
[check]
missions = 2
"""


def added(folder: Path, rule: str) -> dict[str, float | None]:
    """The lines that may be added to the rule of a core, each with when that is tried."""
    (folder / "shared.nddl").write_text(SHARED, encoding="utf-8")
    (folder / "m.nddl").write_text(rule, encoding="utf-8")
    sites = sites_of(load_graph(folder / "m.nddl", ()))
    usage = usage_of(sites)
    found = [(site, edit) for site in sites for edit in site.edits if edit.kind is EditKind.LINE]
    assert all(site.after(edit) == site.text + edit.new for site, edit in found)
    assert not [mutant for mutant in islice(mutants_of(sites, 1), 500) if mutant.edit.kind is EditKind.LINE]
    return {edit.new.strip(): delay_of(edit, site, usage) for site, edit in found}


def test_nothing_is_added_where_lines_speak_of_all(tmp_path: Path) -> None:
    assert added(tmp_path, CHIEF) == {}


def test_what_has_the_same_name_is_tried_first(tmp_path: Path) -> None:
    found = added(tmp_path, CHIEF.replace("  bore.depth == depth;\n", ""))
    assert list(found) == ["bore.depth == depth;", "bore.depth == width;"]
    assert found["bore.depth == depth;"] < found["bore.depth == width;"]  # type: ignore[operator]


def test_values_of_an_enumeration_are_tried(tmp_path: Path) -> None:
    found = added(tmp_path, CHIEF.replace("  bore.rock == Rock.hard;\n", ""))
    assert list(found) == ["bore.rock == Rock.soft;", "bore.rock == Rock.hard;"]


def test_an_end_is_tried_where_the_rule_says_nothing_of_its_own(tmp_path: Path) -> None:
    assert list(added(tmp_path, CHIEF.replace("  bore.end == end;\n", ""))) == ["bore.end == end;"]


def test_a_token_that_is_asked_for_anyhow_and_never_mentioned_is_one_that_another_meets(tmp_path: Path) -> None:
    with_end = CHIEF.replace("  bore.end == end;\n", "  bore.end == end;\n  any(Drill.Stowed off);\n")
    assert list(added(tmp_path, with_end)) == ["bore meets off;", "off meets bore;"]
    assert added(tmp_path, with_end.replace("off);", "off);\n  bore before off;")) == {}
    assert added(tmp_path, with_end.replace("any(Drill.Stowed", "any(Site.Nothing")) == {}


def test_what_only_waits_for_the_end_does_not_say_when_that_is(tmp_path: Path) -> None:
    gone = "  bore.end == end;\n"
    for line in ("any(Drill.Stowed off); off.start <= end + 3;", "any(Drill.Stowed off); end + 3 >= off.start;"):
        assert "bore.end == end;" in added(tmp_path, CHIEF.replace(gone, f"  {line}\n"))
    assert "bore.end == end;" not in added(
        tmp_path, CHIEF.replace(gone, "  any(Drill.Stowed off); end <= off.start + 3;\n")
    )


LIFT = """#include "TREX.nddl"
class Lift extends AgentTimeline {
  predicate Down { }
  predicate Rise { int floor; int top; }
  predicate Hold { int floor; }
  predicate Sink { int floor; }
  Lift(Mode m) { super(m, "Down"); }
}
Lift::Rise {
  duration == 3;
  if (floor < top) { meets(object.Rise next); next.floor == floor + 1; next.top == top; }
  else { meets(object.Hold top_floor); }
}
Lift::Hold { duration == 9; meets(object.Sink sink); }
Lift::Sink { duration == 5; meets(object.Down down); }
"""


def following(folder: Path, text: str) -> dict[str, list[str]]:
    """The lines of a model that have edits of what comes next, each with what it may be."""
    (folder / "lift.nddl").write_text(text, encoding="utf-8")
    sites = sites_of(load_graph(folder / "lift.nddl", ()))
    known = {edit for site in sites for edit in site.edits}
    more = {
        site.text: [site.after(edit) for edit in site.edits if edit not in known] for site in with_successors(sites)
    }
    return {line: texts for line, texts in more.items() if texts}


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (" meets(object.Sink sink);", "", {"duration == 9;": ["Sink", "Down", "Rise"]}),
        ("floor + 1", "floor", {"next.floor == floor;": ["next.floor == floor + 1;"]}),
        ("floor + 1", "floor + 2", {}),
    ],
)
def test_what_comes_next_is_tried_as_other_rules_of_the_class_say_it(
    old: str, new: str, expected: dict[str, list[str]], tmp_path: Path
) -> None:
    assert following(tmp_path, LIFT) == {}
    found = following(tmp_path, LIFT.replace(old, new))
    lines = {
        key: [f"{key} meets(object.{one} following);" if one.isalpha() else one for one in value]
        for key, value in expected.items()
    }
    assert {key: sorted(value) for key, value in found.items()} == {key: sorted(value) for key, value in lines.items()}


def faults(folder: Path, capsys: pytest.CaptureFixture[str], gone: str) -> list[dict[str, Any]]:
    files = {"shared.nddl": SHARED, "chief.nddl": CHIEF.replace(gone, ""), "world.nddl": WORLD}
    return faults_of(folder, capsys, files | {"mission.toml": MISSION})


def test_the_models_are_right_as_they_stand(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert faults(tmp_path, capsys, "   ") == []


@pytest.mark.parametrize("gone", ["bore.depth == depth;", "bore.rock == Rock.hard;"])
def test_the_line_that_is_gone_is_the_first_cause(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], gone: str
) -> None:
    (fault,) = faults(tmp_path, capsys, f"  {gone}\n")
    first = fault["causes"]["ranked"][0]
    assert (first["file"], first["text"], first["claim"]) == ("chief.nddl", "contains(Drill.Bore bore);", "mends")
    assert first["change"] == {"kind": "missing line", "old": "", "new": gone}
