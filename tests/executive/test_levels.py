"""Levels of reservoirs in executed time: what was taken stays taken, whatever a repair forgets."""

from pathlib import Path

import pytest

from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import pinned
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.outcome import EventKind, RepairStage
from runtime.solver.configuration.configuration import FlawManager, default_configuration
from tests.executive.flying import flown, fly, lines, planner, simulator

HERE = Path(__file__).parent / "levels"
ARM = 'class Arm extends AgentTimeline { predicate Rest { } predicate Act { } Arm(Mode m) { super(m, "Rest"); } } '
USER = """
class Task extends AgentTimeline { predicate Idle { } predicate Do { } Task(Mode m) { super(m, "Idle"); } }
class Side extends AgentTimeline { predicate Calm { } predicate Run { } Side(Mode m) { super(m, "Calm"); } }
class More extends AgentTimeline { predicate Still { } predicate Go { } More(Mode m) { super(m, "Still"); } }
Task::Do {
    equals(Arm.Act a);
    any(store.consume use);
    use.time == start;
    use.quantity == 5.0;
    any(store.produce gain);
    gain.time == end;
    gain.quantity == 5.0;
}
Side::Run { duration >= 4; duration <= 20; any(store.consume use); use.time == end; use.quantity == 5.0; }
More::Go { duration == 5; any(store.consume use); use.time == start; use.quantity == 5.0; }
Task task = new Task(Internal);
Side side = new Side(Internal);
More more = new More(Internal);
Arm arm = new Arm(External);
close();
"""


def test_a_repair_that_forgets_the_past_keeps_what_was_consumed() -> None:
    """70 units less 40 less 24 are below the limit of 10: the second visit is not flown on with 46 units left.

    It is judged, too: a level out of bounds in what was executed is an error of the tool.
    """
    mission, found = read_mission(HERE / "mission.toml")
    assert mission is not None, found
    models = load_models(mission)
    outcome = pinned(models)(models.agent)(1406981920)
    repairs = [event.stage for event in outcome.events if event.kind is EventKind.RELAX and event.reactor == "pilot"]
    assert RepairStage.FORGET_PAST in repairs
    assert outcome.abort is not None and (outcome.abort.code, outcome.abort.tick) == ("F4", 817)


def flying_with_a_store(
    length: int, store: str, *goals: GoalConfiguration, text: str = USER, more: str = ""
) -> list[str]:
    """What a planner of three timelines with one store tells, whose task lasts as long as a simulator lets it."""
    usual = default_configuration()
    ordering = usual.__class__(usual.name, usual.filters, (*usual.managers, FlawManager("ResourceThreatManager")))
    world = f"{ARM} {more} Arm::Act {{ duration == {length}; }} Arm arm = new Arm(Internal);"
    world += " Src src = new Src(Internal); close();" if more else " close();"
    owner = simulator("sim", world, "arm src" if more else "arm")
    model = f"Reservoir store = new Reservoir({store}); {ARM} {more} {text}"
    user = planner("user", model, "task side more", "arm src" if more else "arm")
    mission = flown(owner, user, until=60, goals=goals, solver=ordering)
    assert mission.report.holds
    return lines(mission.outcome, "relax", "reject", "observation", "abort")


def goal(timeline: str, predicate: str, start: int, recall: int | None = None) -> GoalConfiguration:
    """A goal that begins at one tick."""
    return GoalConfiguration(timeline, predicate, start=(start, start), recall=recall)


def test_a_repair_leaves_charged_what_a_running_token_will_give_back() -> None:
    """The second task cannot begin at 9; what the first gives back at its end is enough for the run, as before."""
    goals = (goal("task", "Do", 5), goal("task", "Do", 9), goal("side", "Run", 11))
    told = flying_with_a_store(8, "5.0, 0.0, 5.0", *goals)
    assert "11 observation user side Run" in told
    assert not any(line.startswith("9 reject user side") for line in told)


def test_a_repair_takes_back_the_order_in_which_uses_were_put() -> None:
    """Room for a goal asked that the task end before the run does; the goal was taken back, and the task goes on."""
    goals = (goal("task", "Do", 5), goal("side", "Run", 6), goal("more", "Go", 20, recall=10))
    told = flying_with_a_store(40, "10.0, 0.0, 10.0", *goals)
    assert [line.split(":")[0] for line in told if "relax" in line] == ["26 relax user keeping the past"]
    assert told[-3:] == [
        "26 observation user side Calm",
        "45 observation sim arm Rest",
        "45 observation user task Idle",
    ]


def test_what_is_given_back_and_taken_is_put_back_as_a_whole() -> None:
    """What the go looks for never comes: the past is forgotten, but for 5 less 5 and 5 given back, less 5 again."""
    source = 'class Src extends AgentTimeline { predicate A { } predicate B { } Src(Mode m) { super(m, "A"); } }'
    seen = "More::Go { any(Src.B seen); start <= seen.start; seen.start <= start + 15; } Src src = new Src(Observe);"
    goals = (goal("side", "Run", 2), goal("task", "Do", 5), goal("more", "Go", 24))
    text = USER.replace(
        "More::Go { duration == 5; any(store.consume use); use.time == start; use.quantity == 5.0; }", ""
    )
    told = flying_with_a_store(
        8,
        "5.0, 0.0, 5.0",
        *goals,
        text=text.replace("close();", f"{seen} More::Go {{ duration == 5; }} close();"),
        more=source,
    )
    repairs = ["39 relax user keeping the past", "39 relax user forgetting the past"]
    assert [line.split(":")[0] for line in told[-2:]] == repairs  # and no abort


@pytest.mark.parametrize("body", ["GAIN starts(Side.Run r);", "starts(Side.Run r); GAIN"])
def test_what_must_begin_now_is_not_ruled_out_by_a_level_that_its_children_relieve(body: str) -> None:
    gain = "any(store.produce gain); gain.time == start; gain.quantity == 2.0;"
    source = 'class Src extends AgentTimeline { predicate A { } predicate B { } Src(Mode m) { super(m, "A"); } }'
    user = f"""
Reservoir store = new Reservoir(2.0, 0.0, 3.0);
class Task extends AgentTimeline {{ predicate Idle {{ }} predicate Halt {{ }} Task(Mode m) {{ super(m, "Idle"); }} }}
class Side extends AgentTimeline {{ predicate Calm {{ }} predicate Run {{ }} Side(Mode m) {{ super(m, "Calm"); }} }}
Src::B {{ equals(Task.Halt h); }}
Task::Halt {{ {body.replace("GAIN", gain)} }}
Side::Run {{ any(store.consume use); use.time == start; use.quantity == 2.0; }}
Task task = new Task(Internal);
Side side = new Side(Internal);
Src src = new Src(Observe);
close();
"""
    world = f"{source} Src::A {{ duration == 5; meets(object.B next); }} Src src = new Src(Internal); close();"
    outcome = fly(simulator("sim", world, "src"), planner("plan", source + user, "task side", "src"))
    assert lines(outcome, "relax", "observation")[-2:] == [
        "5 observation plan task Halt",
        "5 observation plan side Run",
    ]


def test_a_command_is_not_ruled_out_by_a_level_that_its_child_relieves() -> None:
    """Also where the child has its place only once the command has: that is planned after the level was looked at."""
    world = f"""
Reservoir store = new Reservoir(0.0, 0.0, 1.0);
{ARM}
class Lamp extends AgentTimeline {{ predicate Off {{ }} predicate On {{ }} Lamp(Mode m) {{ super(m, "Off"); }} }}
Arm::Act {{ duration == 3; any(store.consume use); use.time == start; use.quantity == 1.0; starts(Lamp.On lit); }}
Lamp::On {{ any(store.produce gain); gain.time == start; gain.quantity == 1.0; duration <= 3; }}
Arm arm = new Arm(Internal);
Lamp lamp = new Lamp(Internal);
close();
"""
    outcome = fly(simulator("sim", world, "arm lamp"), goals=(goal("arm", "Act", 5),))
    assert lines(outcome, "reject", "observation")[2:4] == ["5 observation sim arm Act", "5 observation sim lamp On"]
