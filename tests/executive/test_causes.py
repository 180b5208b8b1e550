"""Failures of the planner name the lines of the model that rule out what had to hold: F3, F4 and F10."""

from runtime.executive.configuration import GoalConfiguration
from runtime.executive.outcome import Deadlock, EventKind, Outcome
from tests.executive.flying import fly, open_goals, planner, simulator

PLANNER = """
class Survey extends AgentTimeline {
    predicate Idle { } predicate Transect { } predicate Turn { }
    Survey(Mode m) { super(m, "Idle"); }
}
class Motor extends AgentTimeline {
    predicate Off { } predicate Run { }
    Motor(Mode m) { super(m, "Off"); }
}
"""
OBJECTS = "Survey survey = new Survey(Internal); Motor motor = new Motor(Internal); close();"
RULES = """
int RUN_MAX = 30;
int LEG_MIN = 20;
Survey::Transect {
    duration >= LEG_MIN;
    contained_by(Motor.Run run);
}
Motor::Run {
    duration <= RUN_MAX;
}
"""


def lines_of(deadlock: Deadlock | None) -> set[str]:
    """The texts of the lines in all conflicts of what was tried."""
    found = deadlock.conflicts() if deadlock is not None else ()
    return {element.place.text for one in found for element in one.elements if element.place}


def survey(rules: str, script: str = "", start: tuple[int, int] | None = None) -> Outcome:
    """Fly a planner with two timelines of its own."""
    goals = (GoalConfiguration("survey", "Transect", mandatory=True, start=start),) if start else ()
    model = f"{PLANNER}{rules}{OBJECTS}{script}"
    return fly(planner("planner", model, "survey motor", lookahead=60), until=50, goals=goals)


def test_no_plan_for_a_token_that_must_hold_names_the_wrong_constant() -> None:
    must = "goal(Survey.Transect leg); leg.start >= 5; leg.start <= 8;"
    assert survey(RULES, must).abort is None
    outcome = survey(RULES.replace("RUN_MAX = 30", "RUN_MAX = 12"), must)
    assert outcome.abort is not None and outcome.abort.code == "F4"
    found = lines_of(outcome.abort.deadlock)
    assert {"duration >= LEG_MIN", "Motor.Run run", "duration <= RUN_MAX"} <= found
    assert any(line.startswith("RUN_MAX = 12") for line in found)


def test_a_rejected_mandatory_goal_names_the_wrong_constant() -> None:
    assert not survey(RULES, start=(5, 8)).open_goals
    outcome = survey(RULES.replace("RUN_MAX = 30", "RUN_MAX = 12"), start=(5, 8))
    assert outcome.abort is None
    (goal,) = outcome.open_goals
    assert {"duration >= LEG_MIN", "duration <= RUN_MAX"} <= lines_of(goal.deadlock)
    assert outcome.events[goal.event].deadlock == goal.deadlock


def test_a_goal_that_nobody_must_achieve_names_the_wrong_constant_too() -> None:
    model = f"{PLANNER}{RULES.replace('RUN_MAX = 30', 'RUN_MAX = 12')}{OBJECTS}"
    goals = (GoalConfiguration("survey", "Transect", mandatory=False, start=(5, 8)),)
    outcome = fly(planner("planner", model, "survey motor", lookahead=60), until=50, goals=goals)
    (reject,) = [event for event in outcome.events if event.kind is EventKind.REJECT]
    assert {"duration >= LEG_MIN", "duration <= RUN_MAX"} <= lines_of(reject.deadlock)


def test_a_request_that_its_owner_rejects_leads_from_the_abort_to_the_owners_lines() -> None:
    gps = 'class Gps extends AgentTimeline { predicate Off { } predicate Fix { } Gps(Mode m) { super(m, "Off"); } }'
    owner = (
        f"int LIMIT = 4; {gps} Gps::Fix {{ duration >= 6; duration <= LIMIT; }} Gps gps = new Gps(Internal); close();"
    )
    user = f"{PLANNER}{gps} Survey::Transect {{ duration <= 20; contains(Gps.Fix f); }}"
    user += "Survey survey = new Survey(Internal); Gps gps = new Gps(External); close();"
    flyers = simulator("sim", owner, "gps"), planner("top", user, "survey", "gps")
    outcome = fly(*flyers, until=50, goals=(GoalConfiguration("survey", "Transect", start=(5, 8)),))
    assert outcome.abort is not None and outcome.abort.code == "F6"
    causes = [outcome.events[number] for number in outcome.events[outcome.abort.event].causes]
    (reject,) = [event for event in causes if event.kind is EventKind.REJECT]
    assert reject.reactor == "sim"
    assert {"duration >= 6", "duration <= LIMIT", "LIMIT = 4"} <= lines_of(reject.deadlock)


def test_what_now_demands_and_has_no_place_names_the_lines() -> None:
    demands = [f"Survey::{name} {{ starts(Motor.Run run); }}" for name in ("Idle", "Transect", "Turn", "undefined")]
    rules = " ".join([*demands, "Motor::Run { duration >= RUN_MIN; duration <= 6; }"])
    assert survey("int RUN_MIN = 4;" + rules).abort is None
    outcome = survey("int RUN_MIN = 40;" + rules)
    assert outcome.abort is not None and outcome.abort.code == "F3"
    assert {"duration >= RUN_MIN", "duration <= 6"} <= lines_of(outcome.abort.deadlock)


def test_a_goal_that_a_repair_drops_says_what_broke() -> None:
    lamp = 'class Lamp extends AgentTimeline { predicate Off { } predicate On { } Lamp(Mode m) { super(m, "Off"); } }'
    model = lamp + "class User extends AgentTimeline { predicate Idle { } predicate Busy { }"
    model += 'User(Mode m) { super(m, "Idle"); } } User::Busy { ends(Lamp.On on); on.duration <= ON_MAX; }'
    model += "User user = new User(Internal); Lamp lamp = new Lamp(External); close();"
    owner = f"{lamp} Lamp::On {{ duration == 6; }} Lamp lamp = new Lamp(Internal); close();"
    goals = (GoalConfiguration("user", "Busy", start=(5, 7), mandatory=True),)
    outcomes = [
        fly(
            planner("user", f"int ON_MAX = {most}; {model}", "user", "lamp"),
            simulator("sim", owner, "lamp"),
            until=30,
            goals=goals,
        )
        for most in (6, 4)
    ]
    assert not outcomes[0].open_goals
    (goal,) = outcomes[1].open_goals
    (text,) = open_goals(outcomes[1])
    assert "goes on at tick" in text and "later than the plan allows" in text
    assert goal.conflict is not None
    places = [element.place.text for element in goal.conflict.elements if element.place]
    assert "on.duration <= ON_MAX" in places and "duration == 6" in places
    assert outcomes[1].events[goal.event].kind == "relax"
