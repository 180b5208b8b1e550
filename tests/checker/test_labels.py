"""A number by which goals are told apart is no quantity: nothing is computed from it, and no line lacks it."""

from pathlib import Path

import pytest

from checker.counterfactual.search import sites_in
from checker.counterfactual.usage import usage_of
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.kinds import EditKind
from checker.mutation.labels import labels_of

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
class Oven extends AgentTimeline {
  predicate Off { }
  predicate Bake { int loaf; int degrees; }
  Oven(Mode m) { super(m, "Off"); }
}
class Shop extends AgentTimeline {
  predicate Shut { }
  predicate Order { int number; int weight; int heat; }
  Shop(Mode m) { super(m, "Shut"); }
}
Shop::Order { contains(Oven.Bake bake); bake.loaf == number; bake.degrees == heat; bake.duration <= weight; }
Oven::Bake { int time; time == 40; duration == time; }
Shop shop = new Shop(Internal);
Oven oven = new Oven(Internal);
close();
"""
GOAL = """[[goal]]
timeline = "shop"
predicate = "Order"
parameters = { number = %d, weight = %d, heat = %d }
"""
MISSION = """[mission]
name = "shop"
final_tick = 300
[[reactor]]
name = "baker"
model = "m.nddl"
internal = ["shop", "oven"]
[check]
missions = 1
"""


@pytest.mark.parametrize("numbers", [(1, 2, 3), (3, 1, 2), (1, 2), (1, 2, 4), (1, 2, 2), (2, 3), (1,)])
def test_what_goals_are_counted_by_is_never_a_term(numbers: tuple[int, int, int], tmp_path: Path) -> None:
    goals = "".join(GOAL % (number, 50 + k, 200) for k, number in enumerate(numbers))
    handed_on = "bake.loaf == number + 100;" if len(numbers) == 3 else "bake.loaf == number;"
    (tmp_path / "m.nddl").write_text(MODEL.replace("bake.loaf == number;", handed_on))
    (tmp_path / "mission.toml").write_text(MISSION.replace("[check]", goals + "[check]"))
    mission, found = read_mission(tmp_path / "mission.toml")
    assert mission is not None, found
    models = load_models(mission)
    sites = sites_in(models.agent)
    labels = labels_of(mission.agent.goals, sites)
    is_counted = sorted(numbers) in ([1, 2, 3], [1, 2])
    assert labels == ({("Order", "number"), ("Bake", "loaf")} if is_counted else frozenset())  # weights are compared
    (line,) = (one for one in sites if one.text == "time == 40;")
    added = {edit.new for edit in line.edits if edit.kind is EditKind.MISSING}
    assert ("40 * loaf" in added) is not is_counted
    assert "40 * degrees" in added
    (limit,) = (one for one in sites if one.text == "bake.degrees == heat;")
    name = next(edit for edit in limit.edits if (edit.kind, edit.old, edit.new) == (EditKind.NAME, "heat", "number"))
    usage = usage_of(sites, labels=labels)
    assert usage.fitness(name, limit) <= usage_of(sites).fitness(name, limit)
    (compared,) = (one for one in sites if one.text == "bake.duration <= weight;")
    name = next(edit for edit in compared.edits if edit.kind is EditKind.NAME and edit.new == "number")
    assert (usage.fitness(name, compared) < -2.0) is is_counted
