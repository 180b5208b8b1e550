"""Where a store is too empty for a goal, the goals that fill it are doubted: how much they ask for, and when."""

from pathlib import Path
from typing import Any

import pytest

from checker.counterfactual.dependence import Dependence
from checker.counterfactual.mission_lines import mission_lines
from checker.counterfactual.search import sites_in
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.mission_edits import mission_sites
from compiler.program import DomainConstant
from runtime.executive.outcome import OpenGoal, Outcome
from tests.checker.checked import faults_of

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
class Shop extends AgentTimeline {
    predicate Shut { }
    predicate Sell { int amount; }
    Shop(Mode m) { super(m, "Shut"); }
}
class Ramp extends AgentTimeline {
    predicate Free { }
    predicate Deliver { int amount; }
    Ramp(Mode m) { super(m, "Free"); }
}
Reservoir sand = new Reservoir(5.0, 0.0, 40.0);
Shop::Sell {
    duration == 2;
    any(sand.consume out);
    out.time == start;
    out.quantity == amount;
}
Ramp::Deliver {
    duration == 2;
    any(sand.produce load);
    load.time == end;
    load.quantity == amount;
}
Shop shop = new Shop(Internal);
Ramp ramp = new Ramp(Internal);
close();
"""
MISSION = """[mission]
name = "shop"
final_tick = 60
[[reactor]]
name = "plan"
model = "plan.nddl"
latency = 1
lookahead = 60
internal = ["shop", "ramp"]
[check]
missions = 1
"""


def goal(timeline: str, predicate: str, amount: int, first: int, last: int) -> str:
    """One that must be achieved."""
    asked = f'timeline = "{timeline}"\npredicate = "{predicate}"\nparameters = {{ amount = {amount} }}'
    return f"[[goal]]\n{asked}\nmandatory = true\nstart = [{first}, {last}]\n"


def told(folder: Path, capsys: pytest.CaptureFixture[str], *goals: str) -> list[tuple[str, str]]:
    """The lines of the mission file that are causes, each with what is written for it."""
    files = {"plan.nddl": MODEL, "mission.toml": MISSION + "".join(goals)}
    found: Any = faults_of(folder, capsys, files)
    ranked = found[0]["causes"]["ranked"]
    return [(one["text"], one["change"]["new"]) for one in ranked if one["file"] == "mission.toml" and one["change"]]


def test_how_much_is_delivered_may_be_too_little(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deliveries = [goal("ramp", "Deliver", 1, 5, 10), goal("ramp", "Deliver", 12, 50, 55)]
    sales = [goal("shop", "Sell", 3, 2, 4), goal("shop", "Sell", 9, 30, 40), goal("shop", "Sell", 14, 56, 58)]
    assert ("amount = 1", "12") in told(tmp_path, capsys, *deliveries, *sales)


@pytest.mark.parametrize(("supplying", "doubted"), [(set(), []), ({"Deliver"}, ["[0, 60]", "[30, 55]"])])
def test_it_may_be_delivered_too_late(tmp_path: Path, supplying: set[str], doubted: list[str]) -> None:
    (tmp_path / "plan.nddl").write_text(MODEL)
    path = tmp_path / "mission.toml"
    path.write_text(MISSION + goal("ramp", "Deliver", 20, 45, 55) + goal("shop", "Sell", 12, 20, 30))
    mission, _ = read_mission(path)
    assert mission is not None
    lost = OpenGoal("shop", "Sell", (("amount", DomainConstant("int", "int", None, (12,))),))
    found = mission_lines(mission, Outcome(1, 60, 60, None, (), (), (lost,)), supplying)
    times = [one.site for one in found if one.site.text == "start = [45, 55]"]
    assert [edit.new for site in times for edit in site.edits] == doubted


def test_what_fills_a_resource_is_found_by_the_lines_that_use_it(tmp_path: Path) -> None:
    files = {"plan.nddl": MODEL, "mission.toml": MISSION}
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    mission, _ = read_mission(tmp_path / "mission.toml")
    assert mission is not None
    models = load_models(mission)
    graph = Dependence(list(models.programs.values()), sites_in(models.agent))
    assert graph.supplying({("sand", "produce")}) == {"Deliver"}
    assert graph.supplying({("sand", "consume")}) == {"Sell"}
    assert not graph.supplying(set())


def test_a_number_beyond_those_of_the_other_goals_is_the_less_likely(tmp_path: Path) -> None:
    (tmp_path / "plan.nddl").write_text(MODEL)
    path = tmp_path / "mission.toml"
    path.write_text(MISSION + "".join(goal("shop", "Sell", amount, 2, 50) for amount in (10, 20, 60)))
    mission, _ = read_mission(path)
    assert mission is not None
    (site,) = mission_sites(mission)["asked", 1]
    assert [edit.new for edit in site.edits] == ["10", "60", "2"]
    assert {new for _, new in site.unlike} == {"2"}
    (last,) = mission_sites(mission)["asked", 2]  # it lies beyond them itself
    assert not last.unlike
