"""What reactors see of each other: owners before users, news of the same tick, early and late answers."""

import pytest

from runtime.executive.configuration import GoalConfiguration
from runtime.executive.outcome import Outcome
from runtime.executive.ownership import OwnershipError
from runtime.executive.rendering import reason_text
from tests.executive.flying import Flyer, fly, history, lines, open_goals, planner, simulator

LAMP = """
class Lamp extends AgentTimeline { predicate Off { } predicate On { int n; } Lamp(Mode m) { super(m, "Off"); } }
"""
USER = """
class User extends AgentTimeline { predicate Idle { } predicate Busy { } User(Mode m) { super(m, "Idle"); } }
"""
BUSY = (GoalConfiguration("user", "Busy", start=(3, 3), mandatory=True),)


def lamp(rules: str) -> Flyer:
    """A simulator of a lamp."""
    return simulator("sim", f"{LAMP}{rules} Lamp lamp = new Lamp(Internal); close();", "lamp")


def user(rules: str) -> Flyer:
    """A planner that uses the lamp."""
    objects = "User user = new User(Internal); Lamp lamp = new Lamp(External); close();"
    return planner("user", f"{LAMP}{USER}{rules}{objects}", "user", "lamp")


def blinking(period: int) -> Flyer:
    """A lamp that goes on and off by itself."""
    return lamp(f"Lamp::Off {{ duration == {period}; meets(On on); }} Lamp::On {{ duration == 1; meets(Off off); }}")


def shone(duration: int) -> Outcome:
    """The lamp is asked to shine, and does so for some time; the user allows ten ticks."""
    using = "User::Busy { meets(Idle rest); contains(Lamp.On on); on.end == end; on.duration <= 10; }"
    return fly(user(using), lamp(f"Lamp::On {{ duration == {duration}; }}"), until=25, goals=BUSY)


def test_a_user_sees_the_value_of_the_same_tick() -> None:
    follows = "Lamp::On { starts(User.Busy b); } User::Busy { duration == 1; meets(Idle rest); }"
    outcome = fly(user(follows), blinking(4), until=12)
    assert history(outcome, "lamp") == [
        "0 Off",
        "4 On(n=[-inf +inf])",
        "5 Off",
        "9 On(n=[-inf +inf])",
        "10 Off",
    ]
    assert history(outcome, "user") == ["0 Idle", "4 Busy", "5 Idle", "9 Busy", "10 Idle"]


def test_the_order_in_the_configuration_does_not_matter() -> None:
    follows = user("Lamp::On { starts(User.Busy b); } User::Busy { duration == 1; meets(Idle rest); }")
    one, other = (fly(*pair, until=12) for pair in ((follows, blinking(4)), (blinking(4), follows)))
    assert history(one, "user") == history(other, "user")


@pytest.mark.parametrize("duration", [1, 5, 9, 10])
def test_early_and_late_answers_within_the_slack_need_no_repair(duration: int) -> None:
    outcome = shone(duration)
    assert outcome.abort is None and open_goals(outcome) == []
    assert lines(outcome, "relax") == []
    assert history(outcome, "user") == ["0 Idle", "3 Busy", f"{3 + duration} Idle"]


SUBCLASS = (
    LAMP
    + "class Beacon extends Lamp { Beacon(Mode m) { super(m); } }"
    + "class Signal extends Beacon { Signal(Mode m) { super(m); } }"
)


@pytest.mark.parametrize("of", ["Lamp", "Beacon", "Signal"])
def test_what_is_asked_of_a_class_is_met_by_what_a_subclass_does(of: str) -> None:
    objects = f"User user = new User(Internal); {of} lamp = new {of}(External); close();"
    rules = "User::Busy { contains(Lamp.On on); on.n == 2; on.end == end; on.duration <= 10; meets(Idle rest); }"
    sim = f"{SUBCLASS} Lamp::On {{ duration == 4; }} {of} lamp = new {of}(Internal); close();"
    outcome = fly(
        planner("user", f"{SUBCLASS}{USER}{rules}{objects}", "user", "lamp"),
        simulator("sim", sim, "lamp"),
        until=25,
        goals=BUSY,
    )
    assert lines(outcome, "relax") == [] and open_goals(outcome) == []
    assert history(outcome, "lamp") == ["0 Off", "3 On(n=2)", "7 Off"]
    assert history(outcome, "user") == ["0 Idle", "3 Busy", "7 Idle"]


def test_rules_of_the_subclass_alone_are_not_lost() -> None:
    """A token of what was asked for would not have them: so the observation stands by itself, with them."""
    objects = "User user = new User(Internal); Beacon lamp = new Beacon(External); close();"
    rules = "Beacon::On { duration <= 2; } User::Busy { contains(Lamp.On on); on.n == 2; duration <= 20; }"
    sim = f"{SUBCLASS} Lamp::On {{ duration == 4; }} Beacon lamp = new Beacon(Internal); close();"
    outcome = fly(
        planner("user", f"{SUBCLASS}{USER}{rules}{objects}", "user", "lamp"),
        simulator("sim", sim, "lamp"),
        until=25,
        goals=BUSY,
    )
    assert outcome.abort is not None and outcome.abort.code == "F1"


def test_one_tick_past_the_bound_there_are_two_repairs() -> None:
    outcome = shone(11)
    # What runs stays; what it needs is asked for anew, and lasts too long again.
    assert lines(outcome, "relax", "reject", "request") == [
        "0 request user Busy",
        "2 request user lamp On(n=[-inf +inf])",
        "13 relax user keeping the past: Lamp.On#4 of tick 3 goes on at tick 13, later than the plan allows",
        "13 relax user forgetting the past: Lamp.On#4 of tick 3 goes on at tick 13, later than the plan allows",
        "13 request user lamp On(n=[-inf +inf])",
        "24 relax user keeping the past: Lamp.On#4 of tick 14 goes on at tick 24, later than the plan allows",
        "24 relax user forgetting the past: Lamp.On#4 of tick 14 goes on at tick 24, later than the plan allows",
    ]
    assert outcome.abort is None and open_goals(outcome) == [
        "Busy: it began, and a repair has cut it loose from what was to end it"
        " (Lamp.On#4 of tick 14 goes on at tick 24, later than the plan allows)"
    ]


def test_what_is_only_planned_gives_way_to_the_world_with_the_past_kept() -> None:
    # Busy is to begin when the lamp, on since tick 2, goes off, which was to be by 9; it stays on until 12.
    using = "User::Busy { met_by(Lamp.On on); }"
    burning = lamp("Lamp::Off { duration <= 2; } Lamp::On { duration == 10; }")
    goals = (GoalConfiguration("user", "Busy", start=(5, 9)),)
    outcome = fly(user(using), burning, until=20, goals=goals)
    assert outcome.abort is None
    assert lines(outcome, "relax", "reject") == [
        "9 relax user keeping the past: Lamp.On#3 of tick 1 goes on at tick 9, later than the plan allows",
        "9 reject user user Busy: the planner found no place for it"
        " (Lamp.On#3 of tick 1 goes on at tick 9, later than the plan allows)",
    ]


def test_after_both_repairs_the_agent_gives_up() -> None:
    outcome = fly(user("Lamp::On { duration <= 3; }"), lamp("Lamp::Off { duration == 2; meets(On o); }"), until=20)
    assert lines(outcome, "relax", "abort") == [
        "5 relax user keeping the past: Lamp.On#2 of tick 2 goes on at tick 5, later than the plan allows",
        "5 relax user forgetting the past: Lamp.On#2 of tick 2 goes on at tick 5, later than the plan allows",
        "5 abort user lamp F1: Lamp.On#2 of tick 2 goes on at tick 5, later than the plan allows",
    ]
    assert outcome.last_tick == 5 and outcome.ended_early


def test_an_observation_that_the_model_forbids_is_unexpected() -> None:
    outcome = fly(user("Lamp::Off { duration >= 9; }"), blinking(4), until=20)
    assert outcome.abort is not None
    assert (outcome.abort.code, outcome.abort.tick, outcome.abort.relaxes) == ("F2", 4, 2)
    assert reason_text(outcome.abort.reason) == "Lamp.Off#0 of tick 0 ended at tick 4, when the plan does not allow it"


def test_a_predicate_that_the_user_does_not_know_is_undefined() -> None:
    strange = LAMP.replace("predicate On { int n; }", "predicate On { int n; } predicate Broken { }")
    owner = simulator(
        "sim",
        f"{strange} Lamp::Off {{ duration == 4; meets(Broken b); }} Lamp lamp = new Lamp(Internal); close();",
        "lamp",
    )
    follows = "Lamp::undefined { starts(User.Busy b); }"
    outcome = fly(user(follows), owner, until=8)
    assert history(outcome, "lamp") == ["0 Off", "4 Broken"]
    assert history(outcome, "user") == ["0 Idle", "4 Busy"]


@pytest.mark.parametrize(
    ("declared", "is_known"),
    [("int n;", True), ("int n; n <= 5;", False), ("bool n;", False), ("float k;", True), ("", True)],
)
def test_parameters_that_do_not_fit_make_an_observation_undefined(declared: str, is_known: bool) -> None:
    own = lamp("Lamp::Off { duration == 4; meets(On on); on.n == 7; }")
    seen = LAMP.replace("int n;", declared)
    follows = "Lamp::undefined { starts(User.Busy b); }"
    objects = "User user = new User(Internal); Lamp lamp = new Lamp(External); close();"
    outcome = fly(planner("user", f"{seen}{USER}{follows}{objects}", "user", "lamp"), own, until=8)
    assert outcome.abort is None
    assert history(outcome, "user") == (["0 Idle"] if is_known else ["0 Idle", "4 Busy"])


def test_an_observation_equal_to_the_last_is_a_new_token() -> None:
    again = lamp("Lamp::Off { duration == 4; meets(Off off); }")
    outcome = fly(user("Lamp::Off { duration <= 5; }"), again, until=12)
    assert outcome.abort is None
    assert history(outcome, "lamp") == ["0 Off", "4 Off", "8 Off", "12 Off"]


def test_a_timeline_is_owned_once() -> None:
    twin = simulator("twin", f"{LAMP} Lamp lamp = new Lamp(Internal); close();", "lamp")
    with pytest.raises(OwnershipError, match="`lamp` is owned by `sim` and by `twin`"):
        fly(lamp(""), twin)


def test_a_timeline_that_is_used_is_owned() -> None:
    with pytest.raises(OwnershipError, match="`user` uses `lamp`, which no reactor owns"):
        fly(user(""))


def test_reactors_do_not_wait_for_each_other() -> None:
    both = f"{LAMP}{USER} Lamp lamp = new Lamp(Internal); User user = new User(Internal); close();"
    with pytest.raises(OwnershipError, match="wait for each other's timelines in a cycle: `a`, `b`"):
        fly(simulator("a", both, "lamp", "user"), simulator("b", both, "user", "lamp"))
