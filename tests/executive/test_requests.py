"""What becomes of requests that owners refuse, give up or take up again."""

from dataclasses import replace

import pytest

from runtime.executive.configuration import GoalConfiguration, ParameterConfiguration
from runtime.executive.outcome import EventKind
from runtime.solver.configuration.configuration import Configuration, FlawHandler, Match, default_configuration
from tests.executive.flying import Flyer, flown, fly, history, lines, open_goals, planner, simulator

ARM = (
    'class Arm extends AgentTimeline { predicate Rest { } predicate Act { int n; } Arm(Mode m) { super(m, "Rest"); } }'
)
TASK = (
    'class Task extends AgentTimeline { predicate Idle { } predicate Do { int n; } Task(Mode m) { super(m, "Idle"); } }'
)
JOB = 'class Job extends AgentTimeline { predicate Free { } predicate Make { } Job(Mode m) { super(m, "Free"); } }'


def task(rules: str, start: str = "") -> Flyer:
    """A planner over the arm."""
    text = f"{ARM}{TASK}{rules} Task task = new Task(Internal); Arm arm = new Arm(External); close(); {start}"
    return planner("plan", text, "task", "arm", latency=1)


def test_what_its_owner_rejected_is_missed_with_its_own_code() -> None:
    # The arm rests for 30 ticks, and what runs needs it by tick 10.
    rules = "Task::Do { duration >= 20; any(Arm.Act a); start + 2 <= a.start; a.start <= start + 5; }"
    stuck = planner("arm", f"{ARM} Arm::Rest {{ duration >= 30; }} Arm arm = new Arm(Internal); close();", "arm")
    goals = (GoalConfiguration("task", "Do", start=(5, 5), parameters=(("n", 1),)),)
    outcome = fly(task(rules), stuck, until=40, goals=goals)
    assert outcome.abort is not None and outcome.abort.code == "F6"
    rejected = [n for n, event in enumerate(outcome.events) if event.kind is EventKind.REJECT]
    assert rejected[0] in outcome.events[outcome.abort.event].causes


@pytest.mark.parametrize("lookahead", [1, 20])
def test_what_is_asked_for_is_taken_back_where_another_comes_in_front(lookahead: int) -> None:
    # The arm is busy until 12, the first task has asked for it, and the second, which comes then, must be over before.
    order = "if (object == task2) { any(task.Do t); t.n == 3; end <= t.start; }"
    rules = f"Task::Do {{ equals(Arm.Act a); a.n == n; {order} }}"
    lines_of_plan = "Task task = new Task(Internal); Task task2 = new Task(Internal); Arm arm = new Arm(External);"
    user = planner("plan", f"{ARM}{TASK}{lines_of_plan}{rules} close();", "task task2", "arm", latency=1)
    text = f"{ARM} Arm::Act {{ duration == n; }} Arm arm = new Arm(Internal); close();"
    goals = (
        GoalConfiguration("arm", "Act", start=(2, 2), parameters=(("n", 10),)),
        GoalConfiguration("task", "Do", at=4, start=(5, 40), parameters=(("n", 3),)),
        GoalConfiguration("task2", "Do", at=6, start=(7, 30), parameters=(("n", 4),)),
    )
    found = planner("owner", text, "arm", lookahead=lookahead)
    flight = flown(user, found, until=40, goals=goals, solver=merging("Task.Do"))
    assert flight.report.holds
    assert lines(flight.outcome, "recall") == ["6 recall plan arm Act(n=3)"]
    acts = ["2 Act(n=10)", "12 Act(n=4)", "16 Rest", "17 Act(n=3)"]
    assert history(flight.outcome, "arm") == ["0 Rest", *acts, "20 Rest"]


def merging(predicate: str) -> Configuration:
    """A table by which what tasks ask for of a predicate must be one that is there already."""
    match = Match(predicate=predicate, parent_predicate=predicate)
    handler = FlawHandler("HSTSOpenConditionDecisionPoint", match, choice="mergeOnly")
    table = default_configuration()
    named = {each.component: each for each in table.managers}
    named["OpenConditionManager"] = replace(named["OpenConditionManager"], handlers=(handler,))
    return replace(table, managers=tuple(named.values()))


def test_a_rejected_goal_comes_back_when_there_is_room() -> None:
    # Two tasks of eight ticks do not fit into the time for both, until the first turns out to be shorter.
    text = f"{TASK} Task::Do {{ duration >= 3; duration <= 8; n == n; }} Task task = new Task(Internal); close();"
    first = GoalConfiguration("task", "Do", start=(2, 2), end=(10, 10), parameters=(("n", 1),))
    second = GoalConfiguration("task", "Do", start=(4, 9), mandatory=True, parameters=(("n", 2),))
    outcome = fly(planner("plan", text, "task"), until=30, goals=(first, second))
    assert lines(outcome, "reject")[0].startswith("0 reject plan task Do(n=2)")
    assert open_goals(outcome) != []


@pytest.mark.parametrize("compiles", [False, True])
def test_what_is_asked_of_who_is_planning_is_answered_at_the_same_tick(compiles: bool) -> None:
    # At tick 25 the mission file asks the arm for eight ticks, and the task that is to end by 32 for seven.
    arm = simulator("sim", f"{ARM} Arm::Act {{ duration == n + 5; }} Arm arm = new Arm(Internal); close();", "arm")
    user = task("Task::Do { duration >= 3; duration <= 9; meets(Arm.Act a); a.n == n; }")
    goals = (
        GoalConfiguration("task", "Do", start=(23, 23), parameters=(("n", 2),)),
        GoalConfiguration("arm", "Act", at=25, start=(26, 30), parameters=(("n", 3),)),
    )
    flight = flown(user, arm, until=40, goals=goals, compiles=compiles)
    assert flight.report.holds
    assert [line.partition(":")[0] for line in lines(flight.outcome, "reject")] == ["25 reject sim arm Act(n=2)"]
    assert flight.outcome.abort is not None and flight.outcome.abort.code == "F6"


def test_the_goal_of_a_planner_whose_middle_gives_up_is_not_achieved() -> None:
    upper = f"{TASK}{JOB} Job::Make {{ contains(Task.Do d); d.n == 1; d.end == end; }}"
    top = planner(
        "top", f"{upper} Job job = new Job(Internal); Task task = new Task(External); close();", "job", "task"
    )
    middle = task("Task::Do { contains(Arm.Act a); a.n == n; a.end == end; } Arm::Act { duration <= 4; }")
    arm = simulator("sim", f"{ARM} Arm::Act {{ duration == 9; }} Arm arm = new Arm(Internal); close();", "arm")
    goals = (GoalConfiguration("job", "Make", mandatory=True, start=(5, 9)),)
    outcome = fly(top, middle, arm, until=60, goals=goals, on_failure="kill_reactor")
    assert history(outcome, "task")[-1].endswith("Failed")
    assert [goal.split(":")[0] for goal in open_goals(outcome)] == ["Make"]


def test_a_reactor_out_of_its_own_budget_is_f5() -> None:
    script = " ".join(f"goal(Task.Do g{k}); g{k}.start == {k * 3}; g{k}.duration == 2;" for k in range(1, 6))
    text = f"{TASK} Task task = new Task(Internal); close(); {script}"
    flyer = planner("plan", text, "task")
    deep = Flyer(type(flyer.configuration)("plan", "plan.nddl", 0, 100, ("task",), max_depth=2), text)
    assert fly(flyer, until=30).abort is None
    outcome = fly(deep, until=30)
    assert outcome.abort is not None and outcome.abort.code == "F5" and outcome.abort.reason.limit == 2


def test_a_model_that_what_was_drawn_contradicts_is_f9() -> None:
    text = f"float D = [1.0 10.0]; {TASK} Task task = new Task(Internal); close(); "
    text += "goal(Task.Do g); int k; float d; d == sampledParameter(D); k == ceil(d); g.n == k; g.n <= 5;"
    parameters = (ParameterConfiguration("D", 1.0, 10.0),)
    for value in (3.0, 8.0):
        outcome = fly(planner("plan", text, "task"), until=5, parameters=parameters, overrides={"D": value})
        assert (outcome.abort is None) == (value < 5)
        if outcome.abort is not None:
            assert (outcome.abort.code, outcome.abort.tick, outcome.last_tick) == ("F9", 0, 0)
            conflict = outcome.abort.conflict
            assert conflict is not None and conflict.parameters == ("D",)
            assert {"g.n <= 5", "ceil(d)"} <= {one.place.text.rstrip(";") for one in conflict.elements if one.place}


def test_one_command_for_two_is_the_answer_to_both_and_who_cannot_use_it_asks_anew() -> None:
    # Both ask the arm for the same; the second one needs the leg as well, which rests until tick 12.
    leg = ARM.replace("Arm", "Leg")
    body = "close();"
    one = task("Task::Do { any(Arm.Act a); a.start == start; a.n == 1; }")
    needs = "Job::Make { any(Arm.Act a); a.start == start; a.n == 1; any(Leg.Act b); b.start == start; b.n == 1; }"
    text = f"{ARM}{leg}{JOB}{needs} Job job = new Job(Internal); Arm arm = new Arm(External);"
    two = planner("two", f"{text} Leg leg = new Leg(External); {body}", "job", "arm leg", latency=1)
    acts = f"{ARM}{leg} Arm::Act {{ duration == 2; }} Leg::Rest {{ duration >= 12; }}"
    world = planner("world", f"{acts} Arm arm = new Arm(Internal); Leg leg = new Leg(Internal); {body}", "arm leg")
    goals = (
        GoalConfiguration("task", "Do", start=(4, 4), parameters=(("n", 1),)),
        GoalConfiguration("job", "Make", start=(2, 40)),
    )
    outcome = fly(one, two, world, until=40, goals=goals)
    asked = [event for event in outcome.events if event.kind is EventKind.REQUEST and event.timeline == "arm"]
    begun = next(e for e in outcome.events if e.kind is EventKind.OBSERVATION and e.predicate == "Act")
    assert begun.tick == 4
    assert {event.reactor for event in asked[:2]} == {"plan", "two"}
    numbers = {n for n, event in enumerate(outcome.events) if event in asked[:2]}
    assert numbers <= set(begun.causes)
    assert lines(outcome, "recall")[0].startswith("4 recall two arm Act(n=1)")
    assert outcome.abort is None and open_goals(outcome) == []


@pytest.mark.parametrize("named", ["any(Light.Off off); off.object == lamp;", "any(lamp.Off off);"])
def test_what_was_asked_for_is_the_default_by_the_name_of_the_base_class_too(named: str) -> None:
    # The task puts the lamp off itself: `Off` holds until something else is asked for, so the second need not wait.
    lights = """
    class Light extends AgentTimeline { predicate Off { } Light(Mode m) { super(m, "Off"); } }
    class Lamp extends Light { predicate On { int n; } Lamp(Mode m) { super(m); } }
    """
    two = "Lamp left = new Lamp({0}); Lamp right = new Lamp({0}); close();"
    rules = (
        f"Task::Do {{ Lamp lamp; duration == 5; contains(lamp.On a); a.n == n; a.end == end; {named} a meets off; }}"
    )
    text = f"{TASK}{lights} Task task = new Task(Internal); {rules} {two.format('External')}"
    world = simulator("world", f"{lights} {two.format('Internal')}", "left right")
    goals = tuple(GoalConfiguration("task", "Do", 0, True, (at, 80.0), parameters=(("n", at),)) for at in (3, 10))
    outcome = fly(planner("plan", text, "task", "left right"), world, until=90, goals=goals)
    assert open_goals(outcome) == []
    assert [line.partition(" ")[0] for line in history(outcome, "task") if "Do" in line] == ["3", "10"]
    assert [line.partition(" ")[0] for line in lines(outcome, "request") if " On" in line] == ["2", "9"]
