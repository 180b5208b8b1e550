"""The turns of trials change with what trials have told; numbers are tried first in the way that demands less."""

from pathlib import Path

from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.turns import Turns
from checker.counterfactual.usage import usage_of
from checker.mission import read_mission
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.mission_edits import agent_with, mission_sites
from checker.mutation.variant import load_graph

SHARED = """#include "TREX.nddl"
enum Load { crate, barrel }
class Hoist extends AgentTimeline {
  predicate Still { }
  predicate Lift { float tons; int degrees; }
  Hoist(Mode m) { super(m, "Still"); }
}
"""
PLANNER = """#include "hoist.nddl"
int SHIFT_MAX = 90;
int GAP_MAX = 12;
int REST_LEAST = 5;
float TONS_PER_CRATE = 0.5;
class Work extends AgentTimeline {
  predicate Wait { }
  predicate Shift { Load load; float crates; }
  Work(Mode m) { super(m, "Wait"); }
}
Work::Shift {
  float mass;
  contains(Hoist.Lift lift);
  mass == crates * TONS_PER_CRATE;
  lift.tons == mass;
  lift.degrees == 40;
  lift.start <= start + GAP_MAX;
  end - lift.end >= REST_LEAST;
  duration <= SHIFT_MAX;
}
Work work = new Work(Internal);
Hoist hoist = new Hoist(External);
close();
"""
SIMULATOR = """#include "hoist.nddl"
float RATE = [1.0 2.0];
int COLD = 10;
int WARMING = 3;
float TICKS_PER_TON = 2.0;
Hoist::Lift {
  float rate; float span; float slow; int rise;
  rate == sampledParameter(RATE);
  mulEq(span, rate, tons);
  slow == span * TICKS_PER_TON;
  rise + COLD == degrees;
  duration == ceil(slow) + rise * WARMING;
}
Hoist hoist = new Hoist(Internal);
close();
"""
MISSION = """[mission]
name = "hoist"
final_tick = 200
[[reactor]]
name = "planner"
model = "planner.nddl"
latency = 1
lookahead = 200
internal = ["work"]
external = ["hoist"]
[[reactor]]
name = "simulator"
model = "simulator.nddl"
lookahead = 1
internal = ["hoist"]
[[goal]]
timeline = "work"
predicate = "Shift"
mandatory = true
parameters = { load = "crate", crates = 8.0 }
[[goal]]
timeline = "work"
predicate = "Shift"
at = 90
mandatory = true
parameters = { load = "barrel", crates = 6.0 }
[[property]]
name = "soon"
kind = "reached"
timeline = "hoist"
predicate = "Lift"
by = 80
[check]
missions = 2
"""


def sites(folder: Path) -> list[EditSite]:
    """The sites of both models."""
    for name, text in (("hoist", SHARED), ("planner", PLANNER), ("simulator", SIMULATOR)):
        (folder / f"{name}.nddl").write_text(text, encoding="utf-8")
    return [site for name in ("planner", "simulator") for site in sites_of(load_graph(folder / f"{name}.nddl", ()))]


def test_what_a_constant_has_to_be_is_followed_through_lines_and_reactors(tmp_path: Path) -> None:
    found = sites(tmp_path)
    usage = usage_of(found)
    ways = {}
    for site in found:
        for edit in site.edits:
            if edit.kind is EditKind.CONSTANT:
                ways[site.named or site.text] = usage.directions.of(edit, site)
    operators = [edit.new for site in found for edit in site.edits if edit.kind is EditKind.OPERATOR]
    assert sorted(operators) == ["*", "*", "*", "+", "+", "+"]
    assert ways == {
        "SHIFT_MAX": 1,
        "GAP_MAX": 1,
        "REST_LEAST": -1,
        "TONS_PER_CRATE": -1,
        "lift.degrees == 40;": -1,
        "RATE": 1,
        "COLD": 1,
        "WARMING": -1,
        "TICKS_PER_TON": -1,
    }


def candidate(text: str) -> Candidate:
    edits = tuple(SmallEdit(EditKind.CONSTANT, "a.nddl", begin, begin + 1, "5", "9", 1) for begin in (3, 8))
    return Candidate(EditSite("a.nddl", 1, 1, 1, "", (1, 1), text, edits), 0.0, Suspicion.TRACE)


def order(turns: Turns) -> list[str]:
    """What is left, in turn."""
    found = []
    while turns:
        _, one, edit = turns.pop()
        found.append(f"{one.site.text}{edit.begin}")
    return found


def test_lines_beside_one_that_helped_come_sooner_and_the_same_place_of_an_idle_one_later() -> None:
    one, other, far = candidate("one"), candidate("other"), candidate("far")
    beside = {one.site: (far.site,)}

    def queue() -> Turns:
        turns = Turns(lambda site: beside.get(site, ()))
        for at, each in ((0.5, one), (0.6, other), (0.9, far)):
            for edit in each.site.edits:
                turns.add(at, each, edit)
        return turns

    assert order(queue()) == ["one3", "one8", "other3", "other8", "far3", "far8"]
    turns = queue()
    turns.favour(one.site)
    assert order(turns) == ["far3", "far8", "one3", "one8", "other3", "other8"]
    turns = queue()
    turns.doubt(one.site, 3)
    turns.doubt(one.site, 3)
    assert order(turns) == ["one8", "other3", "other8", "far3", "far8", "one3"]


def test_goals_may_ask_for_what_others_ask_and_a_property_may_have_more_time(tmp_path: Path) -> None:
    sites(tmp_path)
    (tmp_path / "mission.toml").write_text(MISSION, encoding="utf-8")
    mission, found = read_mission(tmp_path / "mission.toml")
    assert mission is not None, found
    known = mission_sites(mission)
    asked = {site.text: [edit.new for edit in site.edits] for site in known["asked", 0]}
    assert asked == {'load = "crate"': ['"barrel"'], "crates = 8.0": ["6.0", "4.0", "0.8"]}
    (by,) = known["property", 0]
    assert [(edit.old, edit.new) for edit in by.edits] == [("80", "200")]
    assert agent_with(mission, mission.agent, by.edits[0]).properties[0].by == 200
    crates = next(site.edits[1] for site in known["asked", 0] if site.text.startswith("crates"))
    assert dict(agent_with(mission, mission.agent, crates).goals[0].parameters)["crates"] == 4.0


def test_a_line_of_which_many_changes_were_in_vain_lets_others_have_their_turn() -> None:
    one, other = candidate("one"), candidate("other")
    turns = Turns(lambda _: ())
    for at, each in ((0.5, one), (0.6, other)):
        for edit in each.site.edits:
            turns.add(at, each, edit)
    for _ in range(5):
        turns.tire(one.site)
    assert order(turns)[0] == "one3"
    turns = Turns(lambda _: ())
    for at, each in ((0.5, one), (0.6, other)):
        for edit in each.site.edits:
            turns.add(at, each, edit)
    for _ in range(7):
        turns.tire(one.site)
    assert order(turns) == ["other3", "other8", "one3", "one8"]


def test_a_comparison_the_other_way_round_is_not_doubted_with_its_place() -> None:
    edits = [SmallEdit(EditKind.COMPARISON, "a.nddl", 3, 4, "<", new, 1) for new in ("<=", ">")]
    line = Candidate(EditSite("a.nddl", 1, 1, 1, "", (1, 1), "a < b;", tuple(edits)), 0.0, Suspicion.TRACE)
    turns = Turns(lambda _: ())
    for edit in edits:
        turns.add(0.5, line, edit)
    turns.doubt(line.site, None)
    assert turns.pop()[2].new == ">"
