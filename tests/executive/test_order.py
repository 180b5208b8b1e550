"""Reactors of a mission file, and what a rule asks for, have their turns in the order in which they are written."""

from pathlib import Path

import pytest

from checker.flight import fly_programs
from checker.mission import read_mission
from checker.models import load_models
from runtime.executive.configuration import GoalConfiguration
from tests.executive.flying import fly, lines, planner, simulator
from tests.programs import programs_of

MODEL = """#include "TREX.nddl"
class Lamp extends AgentTimeline { predicate Off { } Lamp(Mode m) { super(m, "Off"); } }
Lamp lamp = new Lamp(Internal);
close();
"""
CODE = """from runtime.user.reactor import Now, Reactor


class Bell(Reactor):
    def tick(self, now: Now) -> None:
        if now.tick == 0:
            now.publish("bell", "Quiet")
"""
TABLES = {
    "lamp": '[[reactor]]\nname = "lamp"\nmodel = "lamp.nddl"\nlatency = 0\nlookahead = 1\ninternal = ["lamp"]\n',
    "bell": '[[reactor]]\nname = "bell"\ncode = "bell.py:Bell"\ninternal = ["bell"]\n',
}


@pytest.mark.parametrize("order", [("lamp", "bell"), ("bell", "lamp")])
def test_the_file_decides(tmp_path: Path, order: tuple[str, str]) -> None:
    (tmp_path / "lamp.nddl").write_text(MODEL, encoding="utf-8")
    (tmp_path / "bell.py").write_text(CODE, encoding="utf-8")
    text = '[mission]\nname = "order"\nfinal_tick = 5\n' + "".join(TABLES[name] for name in order)
    (tmp_path / "mission.toml").write_text(text, encoding="utf-8")
    mission, problems = read_mission(tmp_path / "mission.toml")
    assert mission is not None, problems
    agent = load_models(mission).agent
    outcome = fly_programs(agent, programs_of(agent), 1)
    assert tuple(dict.fromkeys(event.reactor for event in outcome.events if event.reactor)) == order


@pytest.mark.parametrize("guard", ["{0}", "if (n == 1) {{ {0} }}"])
def test_what_a_rule_asks_for_on_one_timeline_is_done_in_the_order_of_its_lines(guard: str) -> None:
    arm = "class Arm extends AgentTimeline { predicate Rest { } predicate Act { int n; } "
    arm += 'Arm(Mode m) { super(m, "Rest"); } } '
    task = "class Task extends AgentTimeline { predicate Idle { } predicate Do { int n; } "
    task += 'Task(Mode m) { super(m, "Idle"); } } '
    asked = [f"contains(Arm.Act a{k}); a{k}.n == n + {k};" for k in range(3)]
    rule = f"Task::Do {{ {asked[0]} {asked[1]} {guard.format(asked[2])} }} "
    outcome = fly(
        planner(
            "plan",
            arm + task + rule + "Task task = new Task(Internal); Arm arm = new Arm(External); close();",
            "task",
            "arm",
        ),
        simulator("arms", arm + "Arm::Act { duration == 3; } Arm arm = new Arm(Internal); close();", "arm"),
        until=30,
        goals=(GoalConfiguration("task", "Do", 0, True, (5, 5), None, None, (("n", 1),)),),
    )
    done = [line.partition("arm ")[2] for line in lines(outcome, "observation") if "Act" in line]
    assert done == ["Act(n=1)", "Act(n=2)", "Act(n=3)"]


def test_a_failing_user_comes_right_behind_its_owners_and_ends_the_tick_for_all_others() -> None:
    step = 'class {0} extends AgentTimeline {{ predicate A {{ }} predicate B {{ }} {0}(Mode m) {{ super(m, "A"); }} }} '
    turns = "{0}::A {{ duration == 5; meets(object.B b); }} {0} {1} = new {0}(Internal); close();"
    watch = f"{step.format('Src')} Src::B {{ start <= 3; }} Src src = new Src(Observe); close();"
    outcome = fly(
        planner("watch", watch, external="src"),
        simulator("other", step.format("Far") + turns.format("Far", "far"), "far"),
        simulator("owner", step.format("Src") + turns.format("Src", "src"), "src"),
    )
    assert lines(outcome, "observation", "abort") == [
        "0 observation owner src A",
        "0 observation other far A",
        "5 observation owner src B",
        "5 abort watch src F2: no Src.B can start at tick 5",
    ]
