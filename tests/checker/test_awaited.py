"""What a plan waits for in vain leads into the rule that should have brought it about."""

from pathlib import Path

import pytest

from checker.counterfactual.smallness import cost_of
from checker.counterfactual.usage import usage_of
from checker.mutation.edits import sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.variant import load_graph
from tests.checker.checked import faults_of

pytestmark = pytest.mark.once

SHARED = """#include "TREX.nddl"
class Horn extends AgentTimeline {
  predicate Still { }
  predicate Blow { }
  Horn(Mode m) { super(m, "Still"); }
}
class Fog extends AgentTimeline {
  predicate Clear { }
  predicate Thick { }
  Fog(Mode m) { super(m, "Clear"); }
}
"""
WATCH = """#include "shared.nddl"
int WATCH_MAX = 80;
int BLOW_MAX = 20;
class Watch extends AgentTimeline {
  predicate Rest { }
  predicate Keep { int bells; }
  Watch(Mode m) { super(m, "Rest"); }
}
Watch::Keep {
  contains(Horn.Blow blow);
  blow contained_by [0 inf] [0 inf] (Fog.Thick fog);
  blow.end == end;
  blow.duration <= BLOW_MAX;
  bells <= 12;
  duration <= WATCH_MAX;
}
Watch watch = new Watch(Internal);
Horn horn = new Horn(External);
Fog fog = new Fog(Observe);
close();
"""
SHIP = """#include "shared.nddl"
float LENGTH = [5.0 9.0];
Horn::Blow {
  float length;
  length == sampledParameter(LENGTH);
  duration == ceil(length);
}
Horn horn = new Horn(Internal);
close();
"""
SEA = """#include "shared.nddl"
int CLEAR = [30 50];
Fog::Clear {
  int clear;
  clear == sampledParameter(CLEAR);
  duration == clear;
  meets(object.Thick t);
}
Fog::Thick { duration == 40; meets(object.Clear c); }
Fog fog = new Fog(Internal);
close();
"""
MISSION = """[mission]
name = "watch"
final_tick = 300
[[reactor]]
name = "watch"
model = "watch.nddl"
latency = 1
lookahead = 300
internal = ["watch"]
external = ["horn", "fog"]
[[reactor]]
name = "ship"
model = "ship.nddl"
latency = 0
lookahead = 1
internal = ["horn"]
[[reactor]]
name = "sea"
model = "sea.nddl"
latency = 0
lookahead = 1
internal = ["fog"]
[[goal]]
timeline = "watch"
predicate = "Keep"
start = [5, 20]
mandatory = true
[goal.parameters]
bells = 4
[[goal]]
timeline = "watch"
predicate = "Keep"
start = [150, 170]
mandatory = true
[goal.parameters]
bells = 8
[check]
missions = 10
"""


FILES = {"shared.nddl": SHARED, "watch.nddl": WATCH, "ship.nddl": SHIP, "sea.nddl": SEA, "mission.toml": MISSION}
WRONG = FILES | {"sea.nddl": SEA.replace("meets(object.Thick t)", "any(object.Thick t)")}


def test_the_models_are_right_as_they_stand(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert faults_of(tmp_path, capsys, FILES) == []


def test_the_rule_is_named_that_should_have_brought_about_what_is_waited_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (fault,) = faults_of(tmp_path, capsys, WRONG)
    first = fault["causes"]["ranked"][0]
    assert (first["file"], first["claim"]) == ("sea.nddl", "mends")
    assert first["text"] == "any(object.Thick t);"


def test_beside_a_token_of_its_own_timeline_a_relation_is_meant_that_can_hold_there(tmp_path: Path) -> None:
    for name, text in WRONG.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    sites = sites_of(load_graph(tmp_path / "sea.nddl", ())) + sites_of(load_graph(tmp_path / "watch.nddl", ()))
    (site,) = (one for one in sites if one.text == "any(object.Thick t);")
    costs = {one.new: cost_of(one, site, usage_of(sites)) for one in site.edits if one.kind is EditKind.RELATION}
    assert costs["meets"] < costs["contains"]
