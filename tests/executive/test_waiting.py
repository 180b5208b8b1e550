"""Commands that wait for the same state of the world go in the order in which they were asked for."""

import pytest

from runtime.executive.configuration import GoalConfiguration
from tests.executive.flying import fly, history, planner

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
