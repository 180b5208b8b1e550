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
