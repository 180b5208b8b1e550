"""What a rule asks for and what is over by now: it is found among what has happened, or the plan has failed."""

from checker.judge.rendering import disagreement_text
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.outcome import EventKind, Outcome
from tests.executive.flying import flown, fly, history, lines, planner, simulator

LAMP = """
class Lamp extends AgentTimeline {
  predicate Off { } predicate Rising { } predicate On { }
  Lamp(Mode m) { super(m, "Off"); }
}
class Sky extends AgentTimeline { predicate Low { } predicate High { } Sky(Mode m) { super(m, "High"); } }
"""
USER = """
class User extends AgentTimeline { predicate Idle { } predicate Busy { } User(Mode m) { super(m, "Idle"); } }
"""
OBJECTS = "User user = new User(Internal); Lamp lamp = new Lamp(External); Sky sky = new Sky({0}); close();"
HIGH_FIRST = 'Sky(Mode m) { super(m, "High"); }'
WORLD = "Lamp lamp = new Lamp(Internal); Sky sky = new Sky(Internal); close();"


def busy(using: str, world: str, start: tuple[int, int], until: int, sky: str = "External") -> Outcome:
    """The user is asked to be busy; the judge has to agree with what comes of it."""
    return fly(
        planner("user", f"{LAMP}{USER}{using}{OBJECTS.format(sky)}", "user", "lamp sky"),
        simulator("world", f"{LAMP}{world}{WORLD}", "lamp sky"),
        until=until,
        goals=(GoalConfiguration("user", "Busy", start=start, mandatory=True),),
    )


def test_a_token_does_not_end_so_that_its_child_is_forgotten() -> None:
    # The lamp never shines. Once that is too late, `Busy` could end at once, its child all in the past.
    using = "User::Busy { contains(Lamp.On on); on.end + 2 <= end; duration <= 10; }"
    outcome = busy(using, "Lamp::On { start >= 1000; }", (3, 3), 30)
    assert history(outcome, "user") == ["0 Idle", "3 Busy"]
    assert outcome.abort is not None
    assert (outcome.abort.code, outcome.abort.reactor, outcome.abort.tick) == ("F6", "user", 10)


def test_a_token_may_end_where_its_child_has_been_there() -> None:
    using = "User::Busy { contains(Lamp.On on); on.end + 2 <= end; duration <= 10; }"
    outcome = busy(using, "Lamp::On { duration == 4; }", (3, 3), 30)
    assert outcome.abort is None and outcome.open_goals == ()
    assert lines(outcome, "relax") == []


def test_a_plan_does_not_put_one_child_where_another_had_to_be_and_was_not() -> None:
    # High lasts as long as the sky wishes, and the lamp has to shine within it; it shines longer.
    using = "User::Busy { contains(Sky.High h); contains(Lamp.On on); h contains on; duration <= 30; }"
    world = "Sky::High { duration == 5; meets(object.Low l); } Lamp::On { duration == 8; }"
    outcome = busy(f"{using} Sky::Low {{ meets(object.High h); }}", world, (3, 3), 60)
    assert outcome.abort is not None and outcome.abort.reactor == "user"


def test_the_end_of_an_observation_is_kept_when_the_token_it_met_goes() -> None:
    # The sky ends sooner than planned, so that what the lamp was raised for goes; the lamp fails later.
    using = "User::Busy { contained_by(Lamp.On on); contained_by(Sky.High h); duration == 5; }"
    using += "Lamp::On { met_by(Rising r); duration <= 60; }"
    world = "Lamp::Rising { duration == 3; meets(object.On on); } Lamp::On { duration == 34; }"
    world += "Sky::High { duration == 20; meets(object.Low l); } Sky::Low { duration == 15; meets(object.High h); }"
    mission = flown(
        planner("user", f"{LAMP}{USER}{using}{OBJECTS.format('Observe')}", "user", "lamp sky"),
        simulator("world", f"{LAMP}{world}{WORLD}", "lamp sky"),
        until=70,
        goals=(GoalConfiguration("user", "Busy", start=(30, 60), mandatory=True),),
    )
    assert [disagreement_text(one) for one in mission.report.disagreements] == []
    assert sum(event.kind is EventKind.RELAX for event in mission.outcome.events) > 1
    reactor = mission.record.reactors[0]
    published = [
        (event.tick, event.predicate)
        for event in mission.outcome.events
        if event.kind is EventKind.OBSERVATION and event.timeline == "lamp" and event.tick <= reactor.last_tick
    ]
    ends = dict(zip(published, [tick for tick, _ in published[1:]], strict=False))
    held = {
        (one.start, one.predicate.rpartition(".")[2]): one.end
        for one in reactor.tokens
        if one.object == "lamp" and one.origin == "observation" and one.state == "active"
    }
    assert list(ends) == [(0, "Off"), (1, "Rising")]
    assert {key: held[key] for key in ends} == ends


def test_nothing_is_put_where_the_past_is_forgotten() -> None:
    # The lamp shines shorter than planned, and the sky's turn, which had to lie within, goes on.
    using = "User::Busy { contains(Sky.High h); contains(Lamp.On on); h contained_by on; duration <= 30; }"
    world = "Lamp::On { duration == 8; } Sky::Low { } Sky::High { duration == 20; }"
    sky = 'Sky(Mode m) { super(m, "Low"); }'
    outcome = fly(
        planner(
            "user", f"{LAMP}{USER}{using}{OBJECTS.format('External')}".replace(HIGH_FIRST, sky), "user", "lamp sky"
        ),
        simulator("world", f"{LAMP}{world}{WORLD}".replace(HIGH_FIRST, sky), "lamp sky"),
        until=60,
        goals=(GoalConfiguration("user", "Busy", start=(3, 3), mandatory=True),),
    )
    assert outcome.abort is not None and outcome.abort.reactor == "user"


def test_what_its_own_rules_leave_only_the_past_is_not_begun() -> None:
    # Two makes overlap. That the second would have begun at 22 shows when its length is known, at 23; steps end there.
    task = (
        'class Task extends AgentTimeline { predicate Idle { } predicate Do { } Task(Mode m) { super(m, "Idle"); } }'
        'class Job extends AgentTimeline { predicate Free { } predicate Make { } Job(Mode m) { super(m, "Free"); } }'
        "Task::Do { duration == 4; any(Job.Make a); a.start == start; any(Job.Make b); b.end == start + 5; }"
        "Job::Make { duration == 3; } Task task = new Task(Internal); Job job = new Job(Internal); close();"
    )
    goals = tuple(GoalConfiguration("task", "Do", start=(start, start)) for start in (20, 40))
    flight = flown(planner("plan", task, "task job", latency=1, lookahead=60, max_steps=1), until=60, goals=goals)
    assert flight.report.holds, [disagreement_text(one) for one in flight.report.disagreements]
    assert lines(flight.outcome, "abort")[0].endswith("no place for Job.Make#13")
