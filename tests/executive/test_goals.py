"""Goals and requests: taken, refused, rejected, recalled, asked for in time."""

from math import inf
from typing import Any

import pytest

from runtime.executive.configuration import GoalConfiguration
from runtime.executive.outcome import EventKind
from runtime.executive.rendering import reason_text
from tests.executive.flying import Flyer, flown, fly, history, lines, open_goals, planner, simulator

LAMP = """
class Lamp extends AgentTimeline { predicate Off { } predicate On { int n; } Lamp(Mode m) { super(m, "Off"); } }
"""
USER = """
class User extends AgentTimeline { predicate Idle { } predicate Busy { int k; } User(Mode m) { super(m, "Idle"); } }
"""
OBJECTS = "User user = new User(Internal); Lamp lamp = new Lamp(External); close();"


def lamp(rules: str, lookahead: int = 1, latency: int = 0) -> Flyer:
    """The owner of the lamp."""
    text = f"{LAMP}{rules} Lamp lamp = new Lamp(Internal); close();"
    return planner("sim", text, "lamp", latency=latency, lookahead=lookahead)


def user(rules: str, objects: str = OBJECTS) -> Flyer:
    """A planner that uses the lamp."""
    return planner("user", f"{LAMP}{USER}{rules}{objects}", "user", "lamp")


def busy(**given: object) -> tuple[GoalConfiguration, ...]:
    """One goal for the user."""
    return (GoalConfiguration("user", "Busy", mandatory=True, **given),)  # type: ignore[arg-type]


def test_a_goal_carries_its_parameters_to_the_owner_of_what_it_needs() -> None:
    rules = "User::Busy { contains(Lamp.On on); on.n == k; meets(Idle rest); on.end == end; }"
    outcome = fly(user(rules), lamp("Lamp::On { duration == n; }"), goals=busy(parameters=(("k", 3),)), until=12)
    assert open_goals(outcome) == []
    assert lines(outcome, "request") == ["0 request user Busy(k=3)", "0 request user lamp On(n=3)"]
    assert history(outcome, "lamp") == ["0 Off", "1 On(n=3)", "4 Off"]


@pytest.mark.parametrize("compiles", [False, True])
@pytest.mark.parametrize("parameters", ["int n; int need;", "int need; int n;"])
def test_an_argument_without_an_upper_bound_is_what_its_consequences_say(parameters: str, compiles: bool) -> None:
    text = LAMP.replace("int n;", parameters)
    rule = "Lamp::On { float x; eq(x, n); need == max(ceil(1.5 * x), 1); duration == need; need <= 600; }"
    owner = simulator("sim", f"{text}{rule} Lamp lamp = new Lamp(Internal); close();", "lamp")
    goals = (GoalConfiguration("lamp", "On", parameters=(("n", (10.0, inf)),)),)
    mission = flown(owner, until=40, goals=goals, compiles=compiles)
    assert mission.report.holds and mission.report.open == 0
    begun = next(e for e in mission.outcome.events if e.kind is EventKind.OBSERVATION and e.predicate == "On")
    assert {name: domain.interval for name, domain in begun.arguments} == {"n": (10, 10), "need": (15, 15)}


def test_a_goal_of_an_unknown_predicate_is_refused() -> None:
    goals = (GoalConfiguration("lamp", "Shine", mandatory=True),)
    outcome = fly(lamp(""), goals=goals)
    assert open_goals(outcome) == ["Shine: `lamp` has no predicate `Shine`"]


def test_a_goal_whose_arguments_do_not_fit_is_refused() -> None:
    limited = LAMP.replace("int n;", "int n; n <= 5;")
    goals = (GoalConfiguration("lamp", "On", mandatory=True, parameters=(("n", 7),)),)
    outcome = fly(simulator("sim", f"{limited} Lamp lamp = new Lamp(Internal); close();", "lamp"), goals=goals)
    assert lines(outcome, "refuse") == ["0 refuse sim lamp On(n=7): its arguments do not fit"]
    assert outcome.abort is None and len(outcome.open_goals) == 1


@pytest.mark.parametrize(
    ("limit", "times", "told"),
    [
        ("n <= 9;", {"start": (7, 8), "end": (0, 6)}, "its times do not fit: start [7 8], end [0 6]"),
        ("duration <= 5;", {"duration": (6, 8)}, "its times do not fit: duration [6 8]"),
        ("duration == n;", {"duration": (1, 3)}, "its times do not fit its arguments: duration [1 3]"),
    ],
)
def test_a_goal_whose_times_do_not_fit_is_refused(limit: str, times: dict[str, Any], told: str) -> None:
    limited = LAMP.replace("int n;", f"int n; {limit}")
    goals = (GoalConfiguration("lamp", "On", parameters=(("n", 7),), **times),)
    outcome = fly(simulator("sim", f"{limited} Lamp lamp = new Lamp(Internal); close();", "lamp"), goals=goals)
    assert [line.partition(": ")[2] for line in lines(outcome, "refuse")] == [told]


@pytest.mark.parametrize("compiles", [True, False])
def test_an_argument_that_the_predicate_does_not_have_is_named(compiles: bool) -> None:
    goals = (GoalConfiguration("lamp", "On", mandatory=True, parameters=(("m", 7),)),)
    outcome = flown(lamp(""), goals=goals, until=20, compiles=compiles).outcome
    told = "0 refuse sim lamp On(m=7.0): its arguments do not fit: there is no parameter `m` (there is `n`)"
    assert lines(outcome, "refuse") == [told]


def test_a_goal_that_comes_too_late_is_refused() -> None:
    outcome = fly(user(""), lamp(""), goals=busy(at=5, start=(1, 4)))
    assert open_goals(outcome) == ["Busy: too late"]


def test_who_does_not_look_ahead_takes_no_goals() -> None:
    goals = (GoalConfiguration("lamp", "On", mandatory=True),)
    outcome = fly(lamp("", lookahead=0), goals=goals)
    assert open_goals(outcome) == ["On: its owner does not look ahead and takes no goals"]
    asked = fly(user("User::Busy { contains(Lamp.On on); }"), lamp("", lookahead=0), goals=busy())
    assert lines(asked, "request") == ["0 request user Busy"]


def test_a_goal_without_a_place_is_rejected_and_the_rest_is_done() -> None:
    goals = tuple(
        GoalConfiguration("user", "Busy", mandatory=True, start=(3, 4), parameters=(("k", k),)) for k in (1, 2)
    )
    outcome = fly(user("User::Busy { duration == 4; }"), lamp(""), goals=goals, until=12)
    assert outcome.abort is None
    assert open_goals(outcome) == ["Busy(k=2): the planner found no place for it"]
    assert history(outcome, "user") == ["0 Idle", "3 Busy(k=1)", "7 Idle"]


def test_a_mandatory_goal_that_has_not_ended_is_unmet() -> None:
    outcome = fly(user("User::Busy { duration == 8; }"), lamp(""), goals=busy(start=(5, 5)), until=10)
    assert open_goals(outcome) == ["Busy"]
    assert open_goals(fly(user("User::Busy { duration == 5; }"), lamp(""), goals=busy(start=(5, 5)), until=10)) == []


def test_a_goal_that_is_due_after_the_end_is_unmet() -> None:
    assert open_goals(fly(user(""), lamp(""), goals=busy(at=50), until=10)) == ["Busy"]
    assert open_goals(fly(user(""), lamp(""), goals=busy(start=(500, 600)), until=10)) == ["Busy"]


def test_a_goal_may_be_unbounded() -> None:
    rules = "User::Busy { contains(Lamp.On on); }"
    outcome = fly(user(rules), lamp("Lamp::On { duration == 2; }"), goals=busy())
    assert history(outcome, "lamp") == ["0 Off", "1 On(n=[-inf +inf])", "3 Off"]


def test_a_reactive_owner_is_asked_when_it_is_to_begin() -> None:
    outcome = fly(user("User::Busy { contains(Lamp.On on); }"), lamp(""), goals=busy(start=(6, 8)), until=12)
    assert lines(outcome, "request")[1:] == ["5 request user lamp On(n=[-inf +inf])"]


def test_a_planning_owner_is_asked_as_early_as_its_window_allows() -> None:
    outcome = fly(
        user("User::Busy { contains(Lamp.On on); }"),
        lamp("Lamp::On { duration == 3; }", lookahead=4, latency=2),
        goals=busy(start=(10, 12)),
        until=20,
    )
    assert lines(outcome, "request")[1:] == ["4 request user lamp On(n=[-inf +inf])"]
    assert history(outcome, "lamp") == ["0 Off", "10 On(n=[-inf +inf])", "13 Off"]


def test_what_is_only_observed_is_not_asked_for() -> None:
    objects = OBJECTS.replace("External", "Observe")
    rules = "User::Busy { contains(Lamp.On on); }"
    by_itself = lamp("Lamp::Off { duration == 4; meets(On on); } Lamp::On { duration == 2; }")
    outcome = fly(user(rules, objects), by_itself, goals=busy(start=(2, 2)), until=12)
    assert outcome.abort is None
    assert lines(outcome, "request") == ["0 request user Busy"]


def test_a_request_is_taken_back_when_its_token_loses_its_place() -> None:
    # Busy follows the lamp; the owner keeps it off for longer, so the goal is given up before it begins.
    rules = "User::Busy { any(Lamp.On on); on.start + 4 == start; }"
    stuck = lamp("Lamp::Off { duration >= 20; }", lookahead=5)
    outcome = fly(user(rules), stuck, goals=busy(start=(8, 8)), until=30)
    assert outcome.abort is None
    assert lines(outcome, "recall") == ["4 recall user lamp On(n=[-inf +inf])"]
    assert lines(outcome, "reject") == [
        "0 reject sim lamp On(n=[-inf +inf]): the planner found no place for it",
        "4 reject user user Busy: the planner found no place for it"
        " (Lamp.Off#0 of tick 0 goes on at tick 4, later than the plan allows)",
    ]
    assert history(outcome, "lamp") == ["0 Off"]


def test_a_sub_goal_without_a_place_ends_the_mission() -> None:
    rules = "User::Idle { contains(Lamp.On on); on.n == 1; on.duration >= 5; } Lamp::On { duration <= 3; }"
    outcome = fly(user(rules), lamp(""), until=20)
    assert outcome.abort is not None
    assert (outcome.abort.code, outcome.abort.tick, outcome.abort.relaxes) == ("F4", 0, 1)
    assert reason_text(outcome.abort.reason).startswith("no place for Lamp.On#")
    assert outcome.abort.conflict is not None and len(outcome.abort.conflict.elements) >= 2


def test_a_sub_goal_of_a_rejectable_goal_only_costs_the_goal() -> None:
    rules = "User::Busy { contains(Lamp.On on); on.duration >= 5; } Lamp::On { duration <= 3; }"
    outcome = fly(user(rules), lamp(""), goals=busy(), until=20)
    assert outcome.abort is None
    assert open_goals(outcome) == ["Busy: the planner found no place for it"]


def test_two_users_of_one_timeline_are_served_one_after_the_other() -> None:
    rules = "User::Busy { contains(Lamp.On on); on.n == k; on.end == end; meets(Idle rest); }"
    other = USER.replace("User", "Other")
    second = f"{LAMP}{other}{rules.replace('User', 'Other')}"
    second += "Other other = new Other(Internal); Lamp lamp = new Lamp(External); close();"
    goals = (
        GoalConfiguration("user", "Busy", mandatory=True, start=(2, 30), parameters=(("k", 1),)),
        GoalConfiguration("other", "Busy", mandatory=True, start=(12, 30), parameters=(("k", 2),)),
    )
    outcome = fly(
        user(rules),
        planner("second", second, "other", "lamp"),
        lamp("Lamp::On { duration == 4; }"),
        goals=goals,
        until=40,
    )
    assert outcome.abort is None and open_goals(outcome) == []
    assert history(outcome, "lamp") == ["0 Off", "2 On(n=1)", "6 Off", "12 On(n=2)", "16 Off"]


def test_a_goal_that_cannot_begin_is_tried_once_more_and_then_given_up() -> None:
    rules = "User::Busy { contains(Lamp.On on); on.n == k; on.end == end; if (start <= AGENT_CLOCK) { k > 5; } }"
    goals = busy(parameters=(("k", 2),), start=(3, 40))
    outcome = fly(user(rules), lamp("Lamp::On { duration == 3; }"), goals=goals, until=30)
    assert lines(outcome, "relax", "reject", "request") == [
        "0 request user Busy(k=2)",
        "2 request user lamp On(n=2)",
        "3 relax user keeping the past: User.Busy#2 cannot start at tick 3",
        "3 request user lamp On(n=2)",
        "6 relax user keeping the past: User.Busy#2 cannot start at tick 6",
        "6 reject user user Busy(k=2): the planner found no place for it (User.Busy#2 cannot start at tick 6)",
    ]
    assert outcome.abort is None and len(outcome.open_goals) == 1
    relax = next(event for event in outcome.events if event.kind == "relax")
    assert relax.conflict is not None
    assert "k > 5" in {one.place.text.strip(" ;") for one in relax.conflict.elements if one.place is not None}


def test_the_mission_file_takes_a_goal_back() -> None:
    rules = "User::Busy { duration == 6; }"
    waiting = fly(user(rules), lamp(""), goals=busy(start=(9, 20), recall=4), until=30)
    assert lines(waiting, "recall") == ["4 recall user Busy"]
    assert history(waiting, "user") == ["0 Idle"] and open_goals(waiting) == ["Busy: taken back"]
    begun = fly(user(rules), lamp(""), goals=busy(start=(3, 20), recall=4), until=30)
    assert history(begun, "user")[1:] == ["3 Busy(k=[-inf +inf])", "9 Idle"]
    over = fly(user(rules), lamp(""), goals=busy(start=(3, 20), recall=12), until=30)
    assert open_goals(over) == [] and lines(over, "achieved")


@pytest.mark.parametrize("bounds", [{"duration": (3.0, 3.0)}, {"end": (8.0, 8.0)}])
def test_what_a_goal_asks_of_its_end_is_given_up_where_the_world_takes_longer(bounds: dict[str, object]) -> None:
    rules = "User::Busy { equals(Lamp.On on); on.n == k; }"
    goals = busy(parameters=(("k", 1),), start=(5, 5), **bounds)
    outcome = fly(user(rules), lamp("Lamp::On { duration == 6; }"), goals=goals, until=20)
    kinds = ("relax", "reject", "abort", "achieved")
    told = [(event.tick, event.kind.value, event.reactor) for event in outcome.events if event.kind.value in kinds]
    assert told == [(8, "relax", "user"), (8, "reject", "user"), (11, "achieved", "sim")]
    assert history(outcome, "user") == ["0 Idle", "5 Busy(k=1)", "11 Idle"]
    assert len(open_goals(outcome)) == 1


def test_what_a_goal_asks_of_its_end_still_holds_after_a_repair_for_another_reason() -> None:
    mood = 'class Mood extends AgentTimeline { predicate Low { } predicate High { } Mood(Mode m) { super(m, "Low"); } }'
    rules = "Mood::High { any(Lamp.On on); on.n == 1; on.start >= 1; on.start <= 7; }"
    objects = "User user = new User(Internal); Mood mood = new Mood(Internal); Lamp lamp = new Lamp(Observe); close();"
    goals = (
        GoalConfiguration("user", "Busy", start=(5, 5), duration=(6, 6), parameters=(("k", 1),)),
        GoalConfiguration("mood", "High", start=(9, 9)),
    )
    watcher = planner("user", f"{LAMP}{USER}{mood}{rules}{objects}", "user mood", "lamp")
    outcome = fly(watcher, lamp(""), goals=goals, until=20)
    assert [event.tick for event in outcome.events if event.kind is EventKind.RELAX] == [7]
    assert lines(outcome, "achieved") == ["11 achieved user user Busy(k=1)"]


def test_an_end_that_a_sender_took_back_does_not_end_the_owner() -> None:
    rules = "User::Busy { equals(Lamp.On on); on.n == k; }"
    goals = busy(parameters=(("k", 1),), start=(5, 5), duration=(3.0, 3.0), recall=7)
    outcome = fly(user(rules), lamp("Lamp::On { duration == 6; }"), goals=goals, until=20)
    assert lines(outcome, "abort", "relax") == []
    assert history(outcome, "user") == ["0 Idle", "5 Busy(k=1)", "11 Idle"]


def test_what_runs_goes_on_to_its_own_end_once_it_is_taken_back() -> None:
    goals = busy(parameters=(("k", 1),), start=(5, 5), duration=(3.0, 3.0), recall=6)
    outcome = fly(user("User::Busy { duration <= 10; }"), lamp(""), goals=goals, until=20)
    assert history(outcome, "user") == ["0 Idle", "5 Busy(k=1)", "15 Idle"]


def test_of_goals_that_may_begin_at_the_same_tick_the_first_of_the_file_comes_first() -> None:
    goals = (
        GoalConfiguration("user", "Busy", at=10, start=(9, 30), parameters=(("k", 1),)),
        GoalConfiguration("user", "Busy", at=10, start=(3, 30), parameters=(("k", 2),)),
    )
    outcome = fly(user("User::Busy { duration == 3; }"), lamp(""), goals=goals, until=20)
    assert history(outcome, "user") == ["0 Idle", "11 Busy(k=1)", "14 Busy(k=2)", "17 Idle"]


def test_what_is_over_is_not_taken_back_where_a_repair_plans_it_anew() -> None:
    rules = "User::Busy { any(Lamp.On on); on.n == k; on.start == start - 3; if (start <= AGENT_CLOCK) { k > 5; } }"
    goals = busy(parameters=(("k", 2),), start=(10, 40))
    outcome = fly(user(rules), lamp("Lamp::On { duration == 3; }"), goals=goals, until=12)
    assert lines(outcome, "request", "recall", "achieved") == [
        "0 request user Busy(k=2)",
        "6 request user lamp On(n=2)",
        "10 achieved sim lamp On(n=2)",
        "10 request user lamp On(n=2)",
    ]


TEN = lamp("Lamp::On { duration == 10; }")


def chained(rule: str, hand: str, owner: Flyer = TEN, **first: object) -> tuple[list[str], list[str]]:
    """A boss asks a user, who asks for the lamp; behind the first goal one is to begin by 9."""
    kinds = USER.replace("User", "Job").replace("Busy", "Make") + USER
    rules = f"Job::Make {{ starts(User.Busy b); b.k == k; b.end == end; {rule} }}"
    boss = f"{kinds}{rules}Job job = new Job(Internal); User user = new User(External); close();"
    goals = (
        GoalConfiguration("job", "Make", mandatory=True, start=(4, 4), parameters=(("k", 1),), **first),  # type: ignore[arg-type]
        GoalConfiguration("job", "Make", start=(5, 9), parameters=(("k", 2),)),
    )
    outcome = fly(planner("boss", boss, "job", "user"), user(hand), owner, goals=goals, until=30)
    told = [line for line in lines(outcome, "reject", "achieved", "abort") if "(k=1)" in line or "abort" in line]
    return told, open_goals(outcome)


HAND = "User::Busy { contains(Lamp.On on); on.n == k; on.end == end; }"
GIVEN_UP = "it began, and a repair has cut it loose from what was to end it"


def test_a_goal_is_kept_whose_plan_can_use_what_ends_later_than_was_asked() -> None:
    told, left = chained("", HAND)
    assert told == [
        f"9 reject user user Busy(k=1): {GIVEN_UP} (Lamp.On#3 of tick 4 goes on at tick 9, later than the plan allows)",
        "14 achieved boss job Make(k=1)",
    ]
    assert left == []


def test_a_goal_whose_own_end_is_missed_is_given_up_by_its_own_repair() -> None:
    told, left = chained("", HAND, duration=(1.0, 9.0))
    assert [line[: line.index(" (")] for line in told[1:]] == [f"13 reject boss job Make(k=1): {GIVEN_UP}"]
    assert len(left) == 1


def test_a_rule_whose_end_is_missed_since_work_ends_late_ends_the_mission() -> None:
    told, _ = chained("duration <= 9;", HAND)
    assert told[1:] == ["13 abort boss user F1: User.Busy#4 of tick 4 goes on at tick 13, later than the plan allows"]


def test_a_goal_is_not_achieved_whose_work_ends_at_its_own_end_without_what_it_needed() -> None:
    """The lamp's owner has rejected what is to follow the work; who asked for the work ends with it."""
    needy = "User::Busy { duration == 5; any(Lamp.On on); on.n == k; on.start == end + 2; on.duration >= 8; }"
    told, left = chained("", needy, lamp("Lamp::On { duration <= 3; }", lookahead=60))
    assert [line.partition(" (")[0] for line in told[-2:]] == [
        "9 reject user user Busy(k=1): an owner has given up what it needs",
        "9 reject boss job Make(k=1): an owner has given up what it needs",
    ]
    assert len(left) == 1


@pytest.mark.parametrize(("answer", "relaxes"), [(1, []), (50, []), (100, []), (101, [110])])
def test_a_plan_with_a_slack_of_a_hundred_ticks_is_repaired_once_where_the_answer_comes_a_tick_later(
    answer: int, relaxes: list[int]
) -> None:
    """Row 4 of the reference: the arm may take from 1 to 100 ticks; what is asked of the end is a goal's to give up."""
    rules = "User::Busy { equals(Lamp.On on); on.n == k; }"
    goals = busy(parameters=(("k", 1),), start=(10, 10), duration=(1.0, 100.0))
    outcome = fly(user(rules), lamp(f"Lamp::On {{ duration == {answer}; }}"), goals=goals, until=200)
    assert [event.tick for event in outcome.events if event.kind is EventKind.RELAX] == relaxes
    assert history(outcome, "user") == ["0 Idle", "10 Busy(k=1)", f"{10 + answer} Idle"]
    assert outcome.abort is None and len(open_goals(outcome)) == len(relaxes)
