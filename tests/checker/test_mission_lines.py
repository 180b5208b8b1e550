"""Where no line of a model is wrong, the line of the mission file is named; goals stay as mandatory as they were."""

from pathlib import Path

import pytest

from checker.counterfactual.mission_lines import mission_lines
from checker.counterfactual.smallness import cost_of
from checker.counterfactual.usage import usage_of
from checker.mission import Mission, read_mission
from checker.mutation.kinds import EditKind
from checker.mutation.mission_edits import agent_with, mission_sites
from nddlc.main import run
from runtime.executive.outcome import Outcome, PropertyFate
from tests.checker.checked import faults_of

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
class Lock extends AgentTimeline {
  predicate Shut { }
  predicate Open { }
  predicate Warm { }
  Lock(Mode m) { super(m, "Shut"); }
}
Lock::Open { met_by(object.Warm w); duration == 8; }
Lock::Warm { starts_before_end(object.Open o); duration == 30; }
Lock lock = new Lock(Internal);
close();
"""
MISSION = """[mission]
name = "lock"
final_tick = 100
[[reactor]]
name = "keeper"
model = "lock.nddl"
latency = 4
lookahead = 90
internal = ["lock"]
[[goal]]
timeline = "lock"
predicate = "Open"
start = [10, 20]
mandatory = true
[check]
missions = 2
"""


def test_times_and_what_reactors_look_ahead_may_be_other_ones(tmp_path: Path) -> None:
    (tmp_path / "lock.nddl").write_text(MODEL, encoding="utf-8")
    (tmp_path / "mission.toml").write_text(MISSION, encoding="utf-8")
    mission, _ = read_mission(tmp_path / "mission.toml")
    assert mission is not None
    found = {site.text: site.edits[0] for sites in mission_sites(mission).values() for site in sites}
    assert {text: edit.new for text, edit in found.items()} == {
        "latency = 4": "1",
        "lookahead = 90": "100",
        "start = [10, 20]": "[0, 100]",
    }
    assert {edit.kind for edit in found.values()} == {EditKind.MISSION}
    agent = agent_with(mission, mission.agent, found["start = [10, 20]"])
    assert (agent.goals[0].start, agent.goals[0].mandatory) == ((0, 100), True)
    assert agent_with(mission, mission.agent, found["latency = 4"]).reactors[0].latency == 1


PLANNER = """#include "lock.nddl"
class Work extends AgentTimeline {
  predicate Wait { }
  predicate Pass { int gate; }
  Work(Mode m) { super(m, "Wait"); }
}
Work::Pass { contains(Lock.Open open); open.gate == gate; duration <= 60; }
Work work = new Work(Internal);
Lock lock = new Lock(External);
close();
"""
SHARED = """#include "TREX.nddl"
class Lock extends AgentTimeline {
  predicate Shut { }
  predicate Open { int gate; }
  Lock(Mode m) { super(m, "Shut"); }
}
"""
KEEPER = """#include "lock.nddl"
Lock::Open { duration == 8; }
Lock lock = new Lock(Internal);
close();
"""
TWO = """[mission]
name = "locks"
final_tick = 100
[[reactor]]
name = "pilot"
model = "pilot.nddl"
latency = 1
lookahead = 100
internal = ["work"]
external = ["lock"]
[[reactor]]
name = "keeper"
model = "keeper.nddl"
latency = 0
lookahead = 0
internal = ["lock"]
[[goal]]
timeline = "work"
predicate = "Pass"
start = [5, 20]
mandatory = true
parameters = { gate = 2 }
[check]
missions = 2
"""


def test_a_reactor_that_takes_no_requests_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = {"lock.nddl": SHARED, "pilot.nddl": PLANNER, "keeper.nddl": KEEPER, "mission.toml": TWO}
    (fault,) = faults_of(tmp_path, capsys, files)
    told = [(one["file"], one["text"], one["claim"]) for one in fault["causes"]["ranked"]]
    assert told[0] == ("mission.toml", "lookahead = 0", "mends")
    assert faults_of(tmp_path, capsys, files | {"mission.toml": TWO.replace("lookahead = 0", "lookahead = 1")}) == []


def test_what_a_property_promises_may_be_too_much(tmp_path: Path) -> None:
    (tmp_path / "lock.nddl").write_text(MODEL)
    path = tmp_path / "mission.toml"
    promise = '[[property]]\nname = "brief"\nkind = "always"\ntimeline = "lock"\npredicate = "Warm"\n'
    path.write_text(MISSION.replace("[check]", promise + 'where = "duration <= 20"\n[check]'))
    mission, _ = read_mission(path)
    assert mission is not None
    (site,) = mission_sites(mission)["property", 0]
    assert [edit.new for edit in site.edits] == [f'"duration <= {n}"' for n in (40, 10, 200, 2)]
    assert {edit.kind for edit in site.edits} == {EditKind.PROMISE}


def test_the_line_of_a_broken_promise_is_a_cause_though_models_can_be_changed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    promise = '[[property]]\nname = "brief"\nkind = "always"\ntimeline = "lock"\npredicate = "Open"\n'
    mission = TWO.replace("lookahead = 0", "lookahead = 1").replace(
        "[check]", promise + 'where = "duration <= 4"\n[check]'
    )
    files = {"lock.nddl": SHARED, "pilot.nddl": PLANNER, "keeper.nddl": KEEPER, "mission.toml": mission}
    (fault,) = faults_of(tmp_path, capsys, files)
    told = {(one["file"], one["text"]) for one in fault["causes"]["ranked"]}
    assert {("keeper.nddl", "duration == 8;"), ("mission.toml", 'where = "duration <= 4"')} <= told


def test_what_a_goal_asks_for_is_named_where_the_planner_found_no_place_for_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pilot = PLANNER.replace("duration <= 60;", "open.duration == gate; open.end == end; duration <= 60;")
    mission = TWO.replace("lookahead = 0", "lookahead = 1").replace("gate = 2", "gate = 500")
    files = {"lock.nddl": SHARED, "pilot.nddl": pilot, "mission.toml": mission}
    files["keeper.nddl"] = KEEPER.replace("duration == 8", "duration == gate")
    (fault,) = faults_of(tmp_path, capsys, files)
    told = [(one["file"], one["change"]["old"], one["change"]["new"]) for one in fault["causes"]["ranked"]]
    assert told[0] == ("mission.toml", "500", "50")


ARM = """#include "TREX.nddl"
class Arm extends AgentTimeline { predicate Rest { } predicate Move { } Arm(Mode m) { super(m, "Rest"); } }
class Step extends AgentTimeline { predicate Wait { } predicate Do { int n; } Step(Mode m) { super(m, "Wait"); } }
"""
THREE = {
    "arm.nddl": ARM,
    "boss.nddl": """#include "arm.nddl"
class Plan extends AgentTimeline { predicate Free { } predicate Job { int n; } Plan(Mode m) { super(m, "Free"); } }
Plan::Job { contains(Step.Do step); step.n == n; step.end == end; }
Plan plan = new Plan(Internal);
Step step = new Step(External);
close();
""",
    "hand.nddl": """#include "arm.nddl"
Step::Do { contains(Arm.Move move); move.end == end; }
Step step = new Step(Internal);
Arm arm = new Arm(External);
close();
""",
    "sim.nddl": """#include "arm.nddl"
Arm::Move { duration == 30; }
Arm arm = new Arm(Internal);
close();
""",
    "mission.toml": """[mission]
name = "arm"
final_tick = 100
[[reactor]]
name = "boss"
model = "boss.nddl"
latency = 1
lookahead = 100
internal = ["plan"]
external = ["step"]
[[reactor]]
name = "hand"
model = "hand.nddl"
latency = 1
lookahead = 100
internal = ["step"]
external = ["arm"]
[[reactor]]
name = "sim"
model = "sim.nddl"
latency = 0
lookahead = 1
internal = ["arm"]
[[goal]]
timeline = "plan"
predicate = "Job"
start = [4, 10]
mandatory = true
parameters = { n = 1 }
[[goal]]
timeline = "plan"
predicate = "Job"
start = [5, 20]
mandatory = true
parameters = { n = 2 }
[check]
missions = 2
""",
}


def test_a_goal_is_named_for_which_others_were_asked_for_too_soon(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (fault,) = faults_of(tmp_path, capsys, THREE)  # hand knows no goal, only until when it was asked for
    assert fault["code"] == "F10"
    told = {(one["text"], one["change"]["new"]) for one in fault["causes"]["ranked"] if one["change"] is not None}
    assert ("start = [5, 20]", "[5, 100]") in told


def test_the_story_tells_who_asked_for_it_and_by_when(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, text in THREE.items():
        (tmp_path / name).write_text(text)
    kept = ("--store", str(tmp_path / "runs.sqlite"), "--flights", "0")
    run(["check", str(tmp_path / "mission.toml"), *kept, "--workers", "1", "--output", str(tmp_path / "report")])
    capsys.readouterr()
    assert run(["explain", "latest", *kept]) == 0
    told = capsys.readouterr().out
    asked = told.index("boss requests Do(n=1) on step, to end by tick 20")
    assert asked < told.index("Step.Do#2.end <= 20 (as asked for)")  # hand gives that up, and goes on
    assert told.index("hand repairs its plan") < told.index("boss repairs its plan")  # which follows from it
    assert "start = [5, 20]" in told


def test_what_a_reactor_in_python_is_given_may_be_another_number(tmp_path: Path) -> None:
    (tmp_path / "lock.nddl").write_text(MODEL, encoding="utf-8")
    (tmp_path / "winch.py").write_text("class Winch: ...\n", encoding="utf-8")
    coded = '[[reactor]]\nname = "winch"\ncode = "winch.py:Winch"\n[reactor.settings]\nwire = 80.0\nside = "left"\n'
    (tmp_path / "mission.toml").write_text(coded + MISSION.replace("[mission]", "[mission]", 1), encoding="utf-8")
    mission, found = read_mission(tmp_path / "mission.toml")
    assert mission is not None, found
    (site,) = mission_sites(mission)["setting", 0]
    assert [one.new for one in site.edits] == ["160.0", "800.0", "40.0", "8.0"]
    changed = agent_with(mission, mission.agent, site.edits[0])
    assert dict(changed.coded[0].settings) == {"wire": 160.0, "side": "left"}


@pytest.mark.parametrize(("ticks", "longer"), [(4, ["8", "40"]), (30, ["60"]), (60, [])])
def test_what_is_promised_within_a_time_is_due_before_the_mission_ends(
    tmp_path: Path, ticks: int, longer: list[str]
) -> None:
    """Ten times 30 ticks of a mission of 100: a promise that nothing can break is none."""
    then = f'ticks = {ticks}\nthen = {{ timeline = "lock", predicate = "Open" }}\n'
    mission = promising(tmp_path, f'kind = "within"\ntimeline = "lock"\npredicate = "Warm"\n{then}')
    sites = mission_sites(mission)["property", 0]
    assert [edit.new for site in sites for edit in site.edits] == longer


@pytest.mark.parametrize(("broken", "due"), [(20, ["8", "40"]), (70, ["8"]), (97, [])])
def test_what_broke_a_promise_is_still_due_with_more_ticks(tmp_path: Path, broken: int, due: list[str]) -> None:
    then = 'ticks = 4\nthen = { timeline = "lock", predicate = "Open" }\n'
    mission = promising(tmp_path, f'kind = "within"\ntimeline = "lock"\npredicate = "Warm"\n{then}')
    fate = PropertyFate("soon", is_kept=False, tick=broken, margin=-1.0)
    outcome = Outcome(1, 100, 100, None, (), (), (), properties=(fate,))
    found = [one for one in mission_lines(mission, outcome) if "ticks" in one.site.text]
    assert [edit.new for one in found for edit in one.site.edits] == due


@pytest.mark.parametrize(
    ("level", "wider"), [("[0, 100]", ["[-inf, 100]", "[0, inf]"]), ("[10, inf]", ["[-inf, inf]"])]
)
def test_of_levels_that_are_promised_one_limit_is_left_out(tmp_path: Path, level: str, wider: list[str]) -> None:
    mission = promising(tmp_path, f'kind = "level"\nresource = "water"\nlevel = {level}\n')
    (site,) = mission_sites(mission)["property", 0]
    assert [edit.new for edit in site.edits] == wider


def promising(folder: Path, promise: str) -> Mission:
    """The mission with one property."""
    (folder / "lock.nddl").write_text(MODEL)
    path = folder / "mission.toml"
    path.write_text(MISSION.replace("[check]", f'[[property]]\nname = "soon"\n{promise}[check]'))
    mission, found = read_mission(path)
    assert mission is not None, found
    return mission


@pytest.mark.parametrize(
    ("starts", "odd"), [((5, 180, 160), {1, 2}), ((5, 180, 360), set()), ((5, 360, 180, 420), {1, 2})]
)
def test_a_goal_out_of_the_order_of_its_timeline_may_have_another_window(
    tmp_path: Path, starts: tuple[int, ...], odd: set[int]
) -> None:
    (tmp_path / "lock.nddl").write_text(MODEL, encoding="utf-8")
    head, goal = MISSION.partition("[[goal]]")[0], MISSION[MISSION.index("[[goal]]") : MISSION.index("[check]")]
    goals = "".join(goal.replace("[10, 20]", f"[{start}, 900]") for start in starts)
    (tmp_path / "mission.toml").write_text(head.replace("100", "900") + goals + "[check]\n", encoding="utf-8")
    mission, complaints = read_mission(tmp_path / "mission.toml")
    assert mission is not None, complaints
    found = mission_sites(mission)
    assert {at for (table, at), sites in found.items() if table == "goal" if any(one.agreeing for one in sites)} == odd
    usage = usage_of([])
    sites = [found["goal", at][0] for at in range(len(starts))]
    costs = [cost_of(site.edits[0], site, usage) for site in sites]
    assert all((costs[at] < max(costs)) == (at in odd) for at in range(len(starts))) or not odd
