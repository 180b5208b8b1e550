"""AGENT_CLOCK in rules: a guard on it fires exactly when it comes to be true, and ticks are only then all visited."""

import pytest

from runtime.executive.configuration import GoalConfiguration
from tests.executive.flying import Flyer, flown, fly, history, lines, planner, simulator

LAMP = """
class Lamp extends AgentTimeline { predicate Off { } predicate On { int n; } Lamp(Mode m) { super(m, "Off"); } }
"""
USER = """
class User extends AgentTimeline { predicate Idle { } predicate Busy { } User(Mode m) { super(m, "Idle"); } }
"""
OBJECTS = "User user = new User(Internal); Lamp lamp = new Lamp(External); close();"
OWNER = simulator("sim", f"{LAMP} Lamp::On {{ duration == 2; }} Lamp lamp = new Lamp(Internal); close();", "lamp")
BUSY = (GoalConfiguration("user", "Busy", start=(6, 6)),)


def user(rules: str) -> Flyer:
    """A planner that uses the lamp."""
    return planner("user", f"{LAMP}{USER}{rules}{OBJECTS}", "user", "lamp")


def test_what_is_guarded_by_the_clock_is_planned_when_the_token_starts() -> None:
    guarded = "User::Busy { if (start <= AGENT_CLOCK) { contains(Lamp.On on); } }"
    outcome = fly(user(guarded), OWNER, until=12, goals=BUSY)
    assert lines(outcome, "request")[1:] == ["6 request user lamp On(n=[-inf +inf])"]
    plain = fly(user("User::Busy { contains(Lamp.On on); }"), OWNER, until=12, goals=BUSY)
    assert lines(plain, "request")[1:] == ["5 request user lamp On(n=[-inf +inf])"]


def test_the_guard_does_not_fire_a_tick_early() -> None:
    guarded = "User::Busy { if (start + 3 <= AGENT_CLOCK) { contains(Lamp.On on); } }"
    outcome = fly(user(guarded), OWNER, until=14, goals=BUSY)
    assert lines(outcome, "request")[1:] == ["9 request user lamp On(n=[-inf +inf])"]


def test_what_never_comes_to_be_true_takes_the_other_branch() -> None:
    guarded = "User::Busy { if (AGENT_CLOCK < 0) { start == 99; } else { contains(Lamp.On on); } }"
    outcome = fly(user(guarded), OWNER, until=12, goals=BUSY)
    assert history(outcome, "lamp") == ["0 Off", "6 On(n=[-inf +inf])", "8 Off"]


def test_a_guarded_part_that_cannot_hold_is_final_for_what_runs() -> None:
    guarded = "User::Busy { if (start + 2 <= AGENT_CLOCK) { duration <= 1; } }"
    outcome = fly(user(guarded), OWNER, until=14, goals=BUSY)
    assert lines(outcome, "relax")[0] == ("8 relax user keeping the past: the plan does not allow it to be tick 8")
    assert outcome.abort is not None and (outcome.abort.code, outcome.abort.tick) == ("F3", 8)
    assert history(outcome, "user") == ["0 Idle", "6 Busy"]


def test_the_mission_ends_where_the_clock_does() -> None:
    outcome = fly(
        user("User::Busy { start == MISSION_END - 4; }"), OWNER, until=12, goals=(GoalConfiguration("user", "Busy"),)
    )
    assert history(outcome, "user") == ["0 Idle", "8 Busy"]


@pytest.mark.parametrize("stop", [None, 10])
@pytest.mark.parametrize("guard", ["start <= AGENT_CLOCK", "start + 3 <= AGENT_CLOCK", "end <= AGENT_CLOCK"])
def test_guards_fire_at_the_final_tick_and_not_before_a_flight_is_cut_short(guard: str, stop: int | None) -> None:
    rules = f"User::Idle {{ duration == 5; if ({guard}) {{ meets(object.Idle next); }} }}"
    mission = flown(user(rules), OWNER, until=10 if stop is None else 30, stop=stop)
    assert mission.report.holds, mission.report.disagreements
    assert history(mission.outcome, "user") == ["0 Idle", "5 Idle", "10 Idle"]
