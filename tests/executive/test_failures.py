"""Reactors that fail: the agent ends, or the reactor is killed and the others go on."""

from runtime.executive.configuration import GoalConfiguration
from tests.executive.flying import Flyer, fly, history, lines, open_goals, planner, simulator

LAMP = """
class Lamp extends AgentTimeline { predicate Off { } predicate On { } Lamp(Mode m) { super(m, "Off"); } }
"""
USER = """
class User extends AgentTimeline { predicate Idle { } predicate Busy { } User(Mode m) { super(m, "Idle"); } }
"""
OBJECTS = "User user = new User(Internal); Lamp lamp = new Lamp(External); close();"
DYING = f"{LAMP} Lamp::Off {{ end <= 5; }} Lamp::On {{ end <= 5; }} Lamp lamp = new Lamp(Internal); close();"
DYING = DYING.replace("Lamp lamp", "Lamp::undefined { end <= 5; } Lamp lamp")


def user(rules: str) -> Flyer:
    """A planner that uses the lamp."""
    return planner("user", f"{LAMP}{USER}{rules}{OBJECTS}", "user", "lamp")


def test_the_agent_ends_with_its_first_reactor() -> None:
    outcome = fly(user(""), simulator("sim", DYING, "lamp"), until=9)
    assert outcome.abort is not None
    assert (outcome.abort.code, outcome.abort.reactor, outcome.abort.tick) == ("F3", "sim", 5)
    assert lines(outcome, "end") == []


def test_a_killed_reactor_publishes_failed_and_the_others_go_on() -> None:
    rules = "Lamp::Failed { starts(User.Busy b); }"
    outcome = fly(user(rules), simulator("sim", DYING, "lamp"), until=9, on_failure="kill_reactor")
    assert outcome.abort is None and outcome.last_tick == 9
    assert [line.partition(":")[0] for line in lines(outcome, "kill")] == ["5 kill sim lamp F3"]
    assert history(outcome, "lamp") == ["0 Off", "5 Failed"]
    assert history(outcome, "user") == ["0 Idle", "5 Busy"]


def test_a_reactor_that_cannot_live_with_failed_is_killed_too() -> None:
    rules = "Lamp::Failed { start >= 100; }"
    outcome = fly(user(rules), simulator("sim", DYING, "lamp"), until=9, on_failure="kill_reactor")
    assert [line.partition(":")[0] for line in lines(outcome, "kill")] == ["5 kill sim lamp F3", "5 kill user lamp F8"]
    assert outcome.last_tick == 5 and outcome.ended_early


def test_who_is_killed_while_planning_is_missed_at_the_next_tick() -> None:
    # The owner plans from tick 4 on, when `On` comes into its window, and finds no place for what it needs.
    owner = f"{LAMP} Lamp::On {{ meets(Off rest); rest.duration >= 5; rest.duration <= 3; }}"
    script = "Lamp lamp = new Lamp(Internal); close(); goal(Lamp.On on); on.start == 8;"
    outcome = fly(
        user("Lamp::Failed { starts(User.Busy b); }"),
        planner("sim", f"{owner}{script}", "lamp", lookahead=4),
        until=9,
        on_failure="kill_reactor",
    )
    assert [line.partition(":")[0] for line in lines(outcome, "kill")] == ["4 kill sim lamp F4"]
    assert history(outcome, "lamp") == ["0 Off", "4 Failed"]
    assert history(outcome, "user") == ["0 Idle", "5 Busy"]


def test_goals_of_a_killed_reactor_stay_unmet() -> None:
    goals = (
        GoalConfiguration("lamp", "On", mandatory=True, start=(7, 9)),
        GoalConfiguration("lamp", "On", mandatory=True, at=8),
    )
    outcome = fly(user(""), simulator("sim", DYING, "lamp"), until=9, goals=goals, on_failure="kill_reactor")
    assert open_goals(outcome) == ["On", "On"]


def test_requests_of_a_killed_reactor_are_taken_back() -> None:
    # The user asks for the lamp and dies, as its own timeline may not last beyond tick 5; the lamp stays off.
    rules = "User::Idle { contains(Lamp.On on); on.start >= 4; end <= 5; } User::Busy { start >= 100; }"
    rules += "User::undefined { start >= 100; }"
    owner = f"{LAMP} Lamp::Off {{ duration >= 7; }} Lamp lamp = new Lamp(Internal); close();"
    outcome = fly(user(rules), simulator("sim", owner, "lamp"), until=12, on_failure="kill_reactor")
    assert history(outcome, "lamp") == ["0 Off"]


def test_a_planner_that_runs_out_of_steps_goes_on_at_the_next_tick() -> None:
    script = f"{USER} User user = new User(Internal); close();"
    goals = tuple(GoalConfiguration("user", "Busy", start=(at, at), duration=(1, 1)) for at in range(10, 20, 2))
    outcome = fly(planner("user", script, "user", max_steps=2), until=25, goals=goals)
    assert outcome.abort is None
    assert len(history(outcome, "user")) == 11


def test_what_has_begun_stays_when_the_token_that_asked_for_it_goes() -> None:
    # Busy waits for the end of the lamp's light, which has begun; then the light lasts too long, and Busy is given up.
    rules = "User::Busy { ends(Lamp.On on); on.duration <= 4; meets(Idle i); } User::Idle { duration >= 3; }"
    owner = f"{LAMP} Lamp::On {{ duration == 6; }} Lamp lamp = new Lamp(Internal); close();"
    goals = tuple(GoalConfiguration("user", "Busy", start=(5, at)) for at in (7, 20, 40))
    flyers = (user(rules), simulator("sim", owner, "lamp"))
    outcome = fly(*flyers, until=45, goals=goals)
    assert outcome.last_tick == 45
    assert fly(*flyers, until=45, goals=goals, every_tick=True) == outcome
    assert any(event.kind == "relax" for event in outcome.events)
