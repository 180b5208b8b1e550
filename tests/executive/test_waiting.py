"""Commands that wait for the same state of the world go in the order in which they were asked for."""

import pytest

from runtime.executive.configuration import GoalConfiguration
from tests.executive.flying import fly, history, lines, planner

ARM = (
    'class Arm extends AgentTimeline { predicate Free { } predicate Work { int n; } Arm(Mode m) { super(m, "Free"); } }'
)
DOOR = """
class Door extends AgentTimeline { predicate Shut { } predicate Open { } Door(Mode m) { super(m, "Shut"); } }
Door::Shut { duration == 20; meets(object.Open o); }
Door::Open { duration == 10; meets(object.Shut s); }
"""
ASKED = tuple(
    GoalConfiguration("arm", "Work", at=at, start=(at + 1, 90), parameters=(("n", n),))
    for n, at in enumerate((4, 7, 10), 1)
)


def worked(rule: str, lookahead: int, goals: tuple[GoalConfiguration, ...] = ASKED) -> list[str]:
    """What the arm did before the final tick."""
    text = f"{ARM}{DOOR}Arm::Work {{ {rule} }} Door door = new Door(Internal); Arm arm = new Arm(Internal); close();"
    owner = planner("owner", text, "arm door", lookahead=lookahead)
    return [line for line in history(fly(owner, until=100, goals=goals), "arm") if "Work" in line]


@pytest.mark.parametrize("lookahead", [1, 40])
def test_the_first_that_was_asked_for_is_the_first_where_all_wait_for_the_same(lookahead: int) -> None:
    told = worked("duration == 3; starts_during(Door.Open open);", lookahead)
    assert told == ["20 Work(n=1)", "23 Work(n=2)", "26 Work(n=3)"]


@pytest.mark.parametrize("lookahead", [1, 40])
def test_what_finds_no_room_any_more_waits_for_the_next_time(lookahead: int) -> None:
    told = worked("duration == 7; starts_during(Door.Open open);", lookahead)
    assert told == ["20 Work(n=1)", "27 Work(n=2)", "50 Work(n=3)"]


@pytest.mark.parametrize("lookahead", [1, 40])
def test_what_does_not_wait_is_not_held_back(lookahead: int) -> None:
    told = worked("duration == 3; if (n == 1) { starts_during(Door.Open open); }", lookahead)
    assert told == ["8 Work(n=2)", "11 Work(n=3)", "20 Work(n=1)"]


@pytest.mark.parametrize("lookahead", [1, 40])
def test_what_begins_at_once_may_delay_what_waits(lookahead: int) -> None:
    told = worked(
        "if (n == 1) { duration == 3; starts_during(Door.Open open); } else { duration == 14; }", lookahead, ASKED[:2]
    )
    assert told == ["8 Work(n=2)", "22 Work(n=1)"]


def test_what_follows_a_command_is_still_planned_when_that_is_over_by_who_looks_one_tick_ahead() -> None:
    act = "duration == 2; if (n > 0) { before(object.Work next); next.n == n - 1; next.start >= start + 6; }"
    text = f"{ARM} Arm::Work {{ {act} }} Arm arm = new Arm(Internal); close();"
    goal = GoalConfiguration("arm", "Work", start=(3, 5), parameters=(("n", 2),))
    outcome = fly(planner("owner", text, "arm", lookahead=1, early=("arm",)), until=30, goals=(goal,))
    assert [line for line in history(outcome, "arm") if "Work" in line] == [
        "3 Work(n=2)",
        "9 Work(n=1)",
        "15 Work(n=0)",
    ]


BOSS = """
class Dev extends AgentTimeline { predicate Off { } predicate On { } Dev(Mode m) { super(m, "Off"); } }
class Gate extends AgentTimeline { predicate Shut { } predicate Ajar { } Gate(Mode m) { super(m, "Shut"); } }
class Shift extends AgentTimeline {
    predicate Idle { } predicate Handle { } predicate Load { } predicate Finish { }
    Shift(Mode m) { super(m, "Idle"); }
}
Shift::Load { contained_by(Gate.Ajar gate); gate.start + 4 <= start; end + 3 == gate.end; duration == 10; }
Shift::Handle { contains(Dev.On on); on.start <= start + 5; on.end == end; }
Shift::Finish { after(object.Load load); contains(Dev.On on); on.start <= start + 5; on.end == end; }
Shift shift = new Shift(Internal);
Gate gate = new Gate(Internal);
Dev dev = new Dev(External);
close();
"""
DEV = """
class Dev extends AgentTimeline { predicate Off { } predicate On { } Dev(Mode m) { super(m, "Off"); } }
Dev::On { duration == 8; }
Dev dev = new Dev(Internal);
close();
"""


def test_nothing_is_asked_for_a_goal_behind_what_begins_as_late_as_it_may() -> None:
    # The gate was asked for by nobody, so that the load waits for it, and the goal behind that for the load.
    starts = {"Handle": (3, 8), "Load": (20, 40), "Finish": (20, 60)}
    goals = tuple(GoalConfiguration("shift", name, start=start) for name, start in starts.items())
    boss = planner("boss", BOSS, "shift gate", "dev", latency=1)
    outcome = fly(boss, planner("world", DEV, "dev", lookahead=60), until=100, goals=goals)
    assert not lines(outcome, "recall", "relax", "reject")
    assert lines(outcome, "request")[3:] == ["0 request boss dev On", "36 request boss dev On"]
    assert [line for line in history(outcome, "gate") if "Ajar" in line] == ["36 Ajar"]
    assert history(outcome, "dev") == ["0 Off", "3 On", "11 Off", "50 On", "58 Off"]


PARTS = """
class Arm extends AgentTimeline { predicate Rest { } predicate Act { int n; } Arm(Mode m) { super(m, "Rest"); } }
class Valve extends AgentTimeline { predicate Shut { } predicate Open { } Valve(Mode m) { super(m, "Shut"); } }
class Task extends AgentTimeline { predicate Idle { } predicate Do { } Task(Mode m) { super(m, "Idle"); } }
class Side extends AgentTimeline { predicate Idle { } predicate Run { } Side(Mode m) { super(m, "Idle"); } }
"""
TOGETHER = {
    "relations": "starts(Arm.Act act); act.n == 2; starts(Valve.Open open);",
    "lengths": "contains(Arm.Act act); act.n == 2; act.duration == 6; act.end <= start + 6; starts(Valve.Open open);",
}


def given_together(rule: str, goal: GoalConfiguration, until: int = 25) -> list[str]:
    """Requests and recalls of a planner whose task begins as two owners do, one of which is busy from tick 4 to 10."""
    wants = f"Task::Do {{ {rule} }} Side::Run {{ contains(Arm.Act act); act.n == 1; }}"
    own = "Task task = new Task(Internal); Side side = new Side(Internal);"
    valve, used = (
        "Valve valve = new Valve(Internal);",
        "Arm arm = new Arm(External); Valve valve = new Valve(External);",
    )
    outcome = fly(
        planner("arms", f"{PARTS} Arm::Act {{ duration == 6; }} Arm arm = new Arm(Internal); close();", "arm"),
        planner("taps", f"{PARTS} Valve::Open {{ duration == 3; }} {valve} close();", "valve"),
        planner("boss", f"{PARTS} {wants} {own} {used} close();", "task side", "valve arm"),
        until=40,
        goals=(goal, GoalConfiguration("task", "Do", at=5, start=(6, until))),
    )
    return [line for line in lines(outcome, "request", "recall") if " boss " in line] + history(outcome, "task")[1:2]


@pytest.mark.parametrize("rule", TOGETHER)
def test_commands_for_one_tick_wait_for_what_holds_back_one_of_them(rule: str) -> None:
    told = given_together(TOGETHER[rule], GoalConfiguration("side", "Run", start=(4, 4)))
    assert told[1:] == ["10 request boss valve Open", "10 request boss arm Act(n=2)", "11 Do"]


@pytest.mark.parametrize("rule", TOGETHER)
def test_commands_that_come_apart_are_asked_for_again_when_what_went_on_is_over(rule: str) -> None:
    told = given_together(TOGETHER[rule], GoalConfiguration("arm", "Act", start=(4, 4), parameters=(("n", 1),)))
    assert told == [
        "5 request boss valve Open",
        "5 request boss arm Act(n=2)",
        "6 recall boss valve Open",
        "6 recall boss arm Act(n=2)",
        "10 request boss valve Open",
        "10 request boss arm Act(n=2)",
        "11 Do",
    ]


def test_a_command_is_not_given_when_the_owner_of_one_that_goes_with_it_has_given_that_up() -> None:
    busy = GoalConfiguration("arm", "Act", start=(4, 4), parameters=(("n", 1),))
    told = given_together(TOGETHER["relations"], busy, until=9)
    assert told[:3] == ["5 request boss valve Open", "5 request boss arm Act(n=2)", "6 recall boss valve Open"]
    assert "6 request boss valve Open" not in told


@pytest.mark.parametrize(
    ("length", "told"),
    [
        ("duration <= 9;", ["11 request boss arm Act(n=2)", "3 Do", "12 Idle", "14 Act(n=2)"]),
        ("duration == 9;", ["0 request boss arm Act(n=2)", "3 Do", "12 Idle", "14 Act(n=2)"]),
        ("", ["3 Do"]),
    ],
)
def test_what_is_to_come_after_an_open_end_is_asked_for_when_that_has_come(length: str, told: list[str]) -> None:
    rule = f"Task::Do {{ {length} before(Arm.Act act); act.n == 2; act.start == end + 2; }}"
    boss = f"{PARTS} {rule} Task task = new Task(Internal); Arm arm = new Arm(External); close();"
    arms = f"{PARTS} Arm::Act {{ duration == 6; }} Arm arm = new Arm(Internal); close();"
    outcome = fly(
        planner("arms", arms, "arm"),
        planner("boss", boss, "task", "arm"),
        until=30,
        goals=(GoalConfiguration("task", "Do", start=(3, 5)),),
    )
    assert not lines(outcome, "recall", "relax", "reject")
    assert lines(outcome, "request")[1:] + history(outcome, "task")[1:] + history(outcome, "arm")[1:2] == told
