"""Long missions: what is over leaves the plan, and nothing that was known because of it is lost."""

import pytest

from runtime.executive.configuration import AgentConfiguration, GoalConfiguration, ReactorConfiguration
from runtime.executive.draws import Draws, World
from runtime.executive.plan_reactor import PlanReactor
from runtime.executive.planning import Planner
from runtime.executive.rendering import event_text
from runtime.executive.stock import SHELVES
from runtime.executive.timelines import TimelineState
from runtime.executive.trace import Trace
from runtime.executive.workbench import Workbench
from runtime.plan.database import PlanDatabase
from runtime.solver.configuration.configuration import default_configuration
from tests.executive.flying import flown, history, lines, planner, program, simulator
from tests.executive.test_equal_runs import toy

METRONOME = """
class Clock extends AgentTimeline { predicate Tick { int n; float x; } Clock(Mode m) { super(m, "Tick"); } }
Clock::Tick {
  duration == 10; meets(Tick next);
  int one; one == 1; next.n == n + one;
  float half; half == 0.5; next.x == x + half;
}
Clock clock = new Clock(Internal); close();
goal(Clock.Tick first); first.start == 0; first.n == 0; first.x == 0.0;
"""


GROWTH = """
class Stock extends AgentTimeline { predicate Holds { float y; float y1; } Stock(Mode m) { super(m, "Holds"); } }
class Seen extends AgentTimeline { predicate Is { float w; } Seen(Mode m) { super(m, "Is"); } }
Stock::Holds {
  duration == 1; meets(object.Holds next); next.y == y1; equals(Seen.Is s); s.w == y;
  float a; a == y * 3.0; y1 == a + a * 2.0 * 0.1;
}
Stock stock = new Stock(Internal); Seen seen = new Seen(Internal); close();
fact(stock.Holds first); first.start == 0; eq(first.y, 1.0);
"""


def metronome(final_tick: int, rules: str = "") -> PlanReactor:
    """A simulator whose every token asks for the next one, by itself."""
    place = ReactorConfiguration("clock", "clock.nddl", internal=("clock",))
    database = PlanDatabase(program("clock.nddl", METRONOME.replace("Clock::Tick {", f"{rules} Clock::Tick {{")), None)
    assert database.run_script() is None
    bench = Workbench(database, "clock")
    bench.commit()
    planner = Planner(bench, default_configuration(), final_tick)
    trace = Trace()
    draws = Draws("clock", World(AgentConfiguration("toy", ".", final_tick, (place,)), 1, {}, trace))
    reactor = PlanReactor(place, bench, planner, final_tick, trace, draws)
    reactor.set_owners({}, 0)
    return reactor


def sizes(reactor: PlanReactor) -> tuple[int, ...]:
    """How many tokens, variables, edges, restrictions, scopes and holds there are or ever were at once."""
    engine, rows = reactor.bench.engine, reactor.bench.rows
    counts = (rows.token_count, engine.variables, engine.edges_used, rows.scope_count, rows.hold_count)
    return (rows.live, *counts, len(engine.restriction_span))


def let_pass(reactor: PlanReactor, first: int, last: int) -> list[tuple[int, ...]]:
    """Have a reactor live through some ticks; its sizes every 1000 ticks."""
    seen = []
    for tick in range(first, last + 1):
        if reactor.due > tick:
            continue
        reactor.trace.tick = tick
        reactor.start_tick(tick)
        assert reactor.synchronise(tick) is None
        reactor.observations(tick)
        while reactor.step(tick):
            pass
        assert reactor.failure() is None
        reactor.due = reactor.next_tick(tick)
        if tick % 1000 == 0:
            seen.append(sizes(reactor))
    return seen


@pytest.mark.slow
def test_the_plan_stays_small_for_twenty_thousand_ticks() -> None:
    reactor = metronome(20_000)
    seen = let_pass(reactor, 0, 20_000)
    assert seen[1] == seen[-1]
    assert seen[-1][0] <= 5
    last = reactor.trace.events[-1]
    assert (last.tick, event_text(last)) == (20_000, "Tick(n=2000, x=1000.0)")


def test_the_plan_stays_small() -> None:
    reactor = metronome(2_000)
    seen = let_pass(reactor, 0, 2_000)
    assert seen[1] == seen[2]
    assert event_text(reactor.trace.events[-1]) == "Tick(n=200, x=100.0)"


def test_of_what_rules_look_back_at_a_bounded_part_is_kept() -> None:
    user = (
        'class User extends AgentTimeline { predicate Idle { } predicate Busy { } User(Mode m) { super(m, "Idle"); } }'
    )
    reactor = metronome(3_000, f"{user} User::Busy {{ after(Clock.Tick t); }}")
    seen = let_pass(reactor, 0, 3_000)
    assert seen[1] == seen[3]
    assert 60 < seen[1][0] < 75


def test_what_is_visited_at_every_tick_stays_small_too() -> None:
    reactor = metronome(400)
    grown = []
    for tick in range(400):
        reactor.due = tick
        let_pass(reactor, tick, tick)
        if tick in (109, 389):  # at 399 nothing comes next
            grown.append(sizes(reactor))
    assert grown[0] == grown[1]


@pytest.mark.parametrize("compiles", [False, True])
def test_what_is_over_leaves_numbers_as_they_are_whose_last_places_exceed_the_tolerance(compiles: bool) -> None:
    flight = flown(simulator("shop", GROWTH, "stock seen"), until=26, compiles=compiles)
    assert flight.outcome.abort is None
    assert flight.report.holds
    y = 1.0
    for line in history(flight.outcome, "seen"):
        assert float(line.partition("w=")[2].rstrip(")")) == pytest.approx(y, rel=1e-12)
        y = y * 3.0 + y * 3.0 * 2.0 * 0.1
    assert y > 1e14


def test_what_was_asked_for_goes_in_a_repair_also_when_who_asked_was_archived() -> None:
    # What two tasks ask for overlaps: as the second is refused, the first is under way, and its task in the archive.
    arm, job = (
        f"class {name} extends AgentTimeline {{ predicate Rest {{ }} predicate {what} {{ int n; }} "
        f'{name}(Mode m) {{ super(m, "Rest"); }} }}'
        for name, what in (("Arm", "Act"), ("Job", "Do"))
    )
    rule = "Job::Do { duration >= 4; any(Arm.Act a); end + 2 <= a.start; a.start <= end + 9; a.n == n; }"
    user = f"{arm} {job} {rule} Job job = new Job(Internal); Arm arm = new Arm(External); close();"
    owner = f"{arm} Arm::Act {{ duration == n + 12; }} Arm arm = new Arm(Internal); close();"
    goals = tuple(
        GoalConfiguration("job", "Do", start=start, duration=(4, 19), parameters=(("n", n),))
        for start, n in (((6, 6), 3), ((10, 10), 2), ((17, 32), 3))
    )
    flyers = (planner("plan", user, "job", "arm", latency=1, lookahead=5), simulator("sim", owner, "arm"))
    flight = flown(*flyers, until=60, goals=goals)
    assert flight.report.holds
    assert [line for line in history(flight.outcome, "arm") if "Act" in line] == ["12 Act(n=3)", "38 Act(n=3)"]
    assert len(lines(flight.outcome, "recall")) == 2  # of the one under way, too


class Hoarder(Workbench):
    """A workbench that archives nothing."""

    calls = 0

    def archive(self, timelines: list[TimelineState], tick: int) -> int:
        """Leave what is over where it is."""
        Hoarder.calls += 1
        return 0


@pytest.mark.parametrize("seed", range(4))
def test_the_archive_changes_no_outcome(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    with_archive = toy(seed)
    monkeypatch.setattr("runtime.executive.mission.Workbench", Hoarder)
    SHELVES.clear()
    before = Hoarder.calls
    assert toy(seed) == with_archive
    assert Hoarder.calls > before
    SHELVES.clear()


def device(name: str, predicates: str) -> str:
    """A class of timelines that rest by default."""
    return (
        f"class {name} extends AgentTimeline {{ predicate Rest {{ }} {predicates} "
        f'{name}(Mode m) {{ super(m, "Rest"); }} }}'
    )


BOOM = simulator(
    "sim",
    f"{device('Boom', 'predicate Act { }')} Boom::Act {{ duration == 20; }} Boom boom = new Boom(Internal); close();",
    "boom",
)


@pytest.mark.parametrize(
    ("rule", "end"),
    [
        ("a.end <= b.end;", 23),
        ("a.end == b.end;", 23),
        ("a ends b;", 23),
        ("int over; a.end <= over; over <= b.end + 2;", 25),
        ("a.duration <= b.duration;", 23),
        ("b.end <= a.end;", 53),
    ],
)
@pytest.mark.parametrize("shared", ["", "Arm::Act { contained_by(Stand.Up s); } Stand stand = new Stand(Internal);"])
def test_what_a_task_says_of_two_that_outlast_it_is_kept(rule: str, end: int, shared: str) -> None:
    # The boom ends at 23, which only the world knows; what the task said of the arm has to hold then, long after it.
    classes = device("Arm", "predicate Act { }") + device("Boom", "predicate Act { }")
    classes += device("Job", "predicate Do { } predicate Sing { }") + device("Stand", "predicate Up { }")
    asks = "any(Arm.Act a); a.start == start; any(Boom.Act b); b.start == start;"
    rules = f"Job::Do {{ duration == 5; {asks} {rule} }} Job::Sing {{ duration == 2; }} Arm::Act {{ duration <= 50; }}"
    own = "Job job = new Job(Internal); Arm arm = new Arm(Internal); Boom boom = new Boom(External); close();"
    plan = planner("plan", f"{classes} {rules} {shared} {own}", "job arm" + (" stand" if shared else ""), "boom")
    goals = tuple(GoalConfiguration("job", what, start=(at, at)) for what, at in (("Do", 3), ("Sing", 10)))
    flight = flown(plan, BOOM, until=70, goals=goals)
    assert flight.report.holds
    assert history(flight.outcome, "arm") == ["0 Rest", "3 Act", f"{end} Rest"]


def test_what_is_merged_with_what_outlasts_its_parent_is_tied_to_another() -> None:
    # Both jobs find the arm at work; the second says that it works no longer than the boom does.
    classes = device("Arm", "predicate Act { }") + device("Boom", "predicate Act { }")
    classes += device("Job", "predicate Do { } predicate Add { } predicate Sing { }")
    rules = """
    Job::Do { duration == 2; any(Arm.Act a); a.start == start; }
    Job::Add { duration == 3; contained_by(Arm.Act a); any(Boom.Act b); b.start == start; a.end <= b.end; }
    Job::Sing { duration == 2; }
    Arm::Act { duration <= 50; }
    """
    own = "Job job = new Job(Internal); Arm arm = new Arm(Internal); Boom boom = new Boom(External); close();"
    plan = planner("plan", f"{classes} {rules} {own}", "job arm", "boom")
    goals = tuple(GoalConfiguration("job", what, start=(at, at)) for what, at in (("Do", 3), ("Add", 7), ("Sing", 14)))
    flight = flown(plan, BOOM, until=70, goals=goals)
    assert flight.report.holds
    assert history(flight.outcome, "arm") == ["0 Rest", "3 Act", "27 Rest"]
