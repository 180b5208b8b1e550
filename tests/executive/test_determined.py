"""Determined reactors: register code tells the same as the general engine, and hands over where it cannot."""

import re
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import pytest

from checker.judge.judge import judge_mission
from checker.mission import read_mission
from compiler.determined import code
from runtime.determined.reactor import DeterminedReactor
from runtime.executive.agent import Agent
from runtime.executive.configuration import GoalConfiguration, ParameterConfiguration
from runtime.executive.draws import World
from runtime.executive.mission import record_mission, register_program, request_of, run_mission
from runtime.executive.outcome import EventKind
from runtime.executive.trace import Trace
from tests.executive.determined_models import Case, random_case, told
from tests.executive.flying import simulator
from tests.programs import programs_of

ROOT = Path(__file__).resolve().parents[2]
MISSIONS = sorted([*(ROOT / "models").rglob("m*.toml"), *(ROOT / "tests").rglob("mission.toml")])
CASES = ROOT / "tests/executive/cases"  # test_cases flies them both ways
KINDS = {"v": ("float", "float"), "n": ("int", "int")}

STEPS = """
float NOISE = [-1.0 1.0];
class Helm extends AgentTimeline {
  predicate Idle { } predicate Run { float v; int n; } Helm(Mode m) { super(m, "Idle"); }
}
class Mirror extends AgentTimeline { predicate Holds { float v; } Mirror(Mode m) { super(m, "Holds"); } }
class Motion extends AgentTimeline { predicate Step { float x; float x1; } Motion(Mode m) { super(m, "Step"); } }
class Tank extends AgentTimeline {
  predicate Ready { int left; } predicate Firing { int left; } Tank(Mode m) { super(m, "Ready"); }
}
Helm::Idle { equals(Mirror.Holds s); s.v == 0.0; }
Helm::Run { equals(Mirror.Holds s); s.v == v * 0.1; duration >= n; }
Motion::Step {
  duration == 1; contained_by(Mirror.Holds c); meets(object.Step next); next.x == x1;
  float n; n == sampledParameter(NOISE); x1 == x + (n + c.v) * TICK_DURATION; x1 <= 50.0;
}
Tank::Ready { duration >= 4; }
Tank::Firing {
  met_by(object.Ready r0); meets(object.Ready r1); duration == 3; left == r0.left; r1.left == left - 2;
}
Helm helm = new Helm(Internal); Mirror mirror = new Mirror(Private); Motion motion = new Motion(Internal);
Tank tank = new Tank(Internal);
close();
fact(motion.Step s0); s0.start == 0; eq(s0.x, 0.0);
fact(tank.Ready r); r.start == 0; r.left == 10;
"""


def steps(*goals: GoalConfiguration, until: int = 40) -> Case:
    """A simulator that makes a token a tick, with commands and bottles."""
    noise = ParameterConfiguration("NOISE", -1.0, 1.0, mode="intra", update=3)
    return Case((simulator("psim", STEPS, "helm mirror motion tank"),), goals, (noise,), until)


def run(at: int, start: tuple[float, float], v: float, n: int = 1) -> GoalConfiguration:
    """A command."""
    return GoalConfiguration("helm", "Run", at, False, start, None, None, (("v", v), ("n", n)))


def agree(case: Case, seed: int = 1) -> None:
    """Fly a case both ways, and event-driven or not."""
    assert case.is_compiled()
    general = told(case.fly(seed, compiles=False))
    assert told(case.fly(seed, compiles=True)) == general
    assert told(case.fly(seed, compiles=True, every_tick=True)) == general


UNTIL = {"dam": 72}  # then comes a search without an end


@pytest.mark.once
@pytest.mark.parametrize(
    "path", [one for one in MISSIONS if CASES not in one.parents], ids=lambda path: path.relative_to(ROOT).as_posix()
)
def test_every_mission_of_the_project_flies_the_same(path: Path) -> None:
    mission, _ = read_mission(path)
    assert mission is not None
    agent, programs = mission.agent, programs_of(mission.agent)
    for seed in (1, 2):
        flights = [
            run_mission(agent, programs, seed, until=UNTIL.get(path.parent.name, 120), compiles=way)
            for way in (False, True)
        ]
        general, compiled = map(told, flights)
        assert compiled == general


@pytest.mark.parametrize("seed", range(60))
def test_random_determined_models_fly_the_same(seed: int) -> None:
    agree(random_case(seed), seed)


@pytest.mark.parametrize(
    ("factor", "until"), [pytest.param("0.02", 1400, marks=pytest.mark.once), ("0.5", 120), ("0.3", 160)]
)
def test_numbers_whose_last_places_come_near_the_tolerance_are_left_to_the_general_engine(
    factor: str, until: int
) -> None:
    model = f"""
    float DX = [-0.6 0.6];
    class Motion extends AgentTimeline {{
      predicate Step {{ float c; float c1; }} Motion(Mode m) {{ super(m, "Step"); }}
    }}
    Motion::Step {{
      duration == 1; float n; n == sampledParameter(DX);
      c1 == c - (n - c) * {factor}; meets(object.Step next); next.c == c1;
    }}
    Motion motion = new Motion(Internal); close();
    fact(motion.Step s0); s0.start == 0; eq(s0.c, 0.0);
    """
    agree(Case((simulator("psim", model, "motion"),), until=until))


@pytest.mark.once
def test_the_missions_of_the_project_have_determined_reactors() -> None:
    compiled = simulated = 0
    for path in MISSIONS[::8]:
        mission, _ = read_mission(path)
        assert mission is not None
        programs = programs_of(mission.agent)
        simulators = [number for number, one in enumerate(mission.agent.reactors) if one.lookahead <= 1]
        simulated += bool(simulators)
        compiled += any(register_program(mission.agent, programs, number) is not None for number in simulators)
    assert compiled > 0.9 * simulated > 20


def test_a_step_a_tick_takes_commands() -> None:
    agree(steps(run(3, (5, 9), 10.0), run(12, (14, 14), -3.0)))


def test_a_record_that_is_still_read_is_not_in_the_way_of_new_kinds_of_commands() -> None:
    plain = steps(until=10)
    agent, programs = plain.agent()
    outcome, record = record_mission(agent, programs, 1)
    before = [tuple(each.tokens) for each in record.reactors]
    asked = replace(agent, goals=(GoalConfiguration("helm", "Run", 2, False, (4, 4), None, None, (("v", 3.0),)),))
    later, _ = record_mission(asked, programs, 1)
    assert any(event.predicate == "Run" and event.kind is EventKind.OBSERVATION for event in later.events)
    assert [tuple(each.tokens) for each in record.reactors] == before
    assert len(outcome.events) < len(later.events)


def test_a_command_waits_until_the_one_before_may_end() -> None:
    agree(steps(run(3, (5, 9), 10.0, 8), run(6, (8, 30), 2.0)))


def test_a_command_that_cannot_start_in_its_window_is_given_up() -> None:
    agree(steps(run(3, (5, 9), 10.0, 20), run(6, (8, 12), 2.0)))


def test_two_commands_for_one_time_are_planned_in_general() -> None:
    agree(steps(run(2, (6, 20), 1.0), run(3, (6, 20), 2.0)))


def test_state_that_is_carried_from_the_token_before() -> None:
    fire = GoalConfiguration("tank", "Firing", 4, False, (8.0, 12.0))
    agree(steps(fire, GoalConfiguration("tank", "Firing", 20, False, (24.0, 30.0))))


GRIP = """
float LONG = [1.0 9.0];
class Arm extends AgentTimeline {
  predicate Rest { } predicate Grip { int n; } predicate Torn { } Arm(Mode m) { super(m, "Rest"); }
}
class Lamp extends AgentTimeline { predicate Off { } predicate On { } Lamp(Mode m) { super(m, "Off"); } }
Arm::Grip {
  duration == sampledParameter(LONG);
  if (n > 2) {
    meets(object.Torn torn); torn.duration == n + 1;
    meets(Lamp.On on); on.duration == sampledParameter(LONG);
  }
}
Arm::Torn { starts(Lamp.On on); on.end == end; }
Arm arm = new Arm(Internal); Lamp lamp = new Lamp(Internal); close();
"""


@pytest.mark.parametrize("rule", ["Arm::Torn { }", "Arm::Torn { duration == 5; }", "Lamp::On { duration <= 4; }"])
def test_a_token_tells_how_long_the_next_one_lasts(rule: str) -> None:
    long = ParameterConfiguration("LONG", 2, 6, distribution="discrete", values=(2, 3, 6), mode="intra", update=1)
    model = GRIP.replace("Arm::Torn { starts(Lamp.On on); on.end == end; }", rule)
    for n in (1, 3, 4):
        asked = GoalConfiguration("arm", "Grip", 2, False, (4, 9), None, None, (("n", n),))
        again = GoalConfiguration("arm", "Torn", 2, False, (12, 29))
        agree(Case((simulator("psim", model, "arm lamp"),), (asked, again), (long,)), n)


RUN = """
int LIMIT = 1;
typedef int {1, 3} Few; typedef int [1 3] Some; typedef float [0.1 2.0] Part;
class Helm extends AgentTimeline {
  predicate Idle { } predicate Run { int n; } predicate Rest { int k; } predicate Halt { }
  Helm(Mode m) { super(m, "Idle"); }
}
class Lamp extends AgentTimeline { predicate Off { } predicate On { Some k; } Lamp(Mode m) { super(m, "Off"); } }
Helm::Run { duration == 4; meets(object.Rest r); r.k == n; }
Helm helm = new Helm(Internal); Lamp lamp = new Lamp(Internal); close();
"""


@pytest.mark.parametrize("n", [0, 1, 2])
@pytest.mark.parametrize(
    ("kept", "rule"),
    [
        ("Few k;", "r.k == n;"),
        ("Some k;", "r.k == n;"),
        ("int k = [1 3];", "r.k == n;"),
        ("int k = LIMIT;", "r.k == n;"),
        ("Part k;", "r.k == n * 0.1;"),
        ("int k;", "r.duration == n;"),
        ("int k;", "bool none; none == (n < 1); if (none) { r.duration == n; } else { r.k == 2; }"),
        ("int k;", "meets(Lamp.On on); on.k == n;"),
        ("int k;", "meets(Lamp.On on); on.k == 1; on.duration == n;"),
    ],
)
def test_what_is_said_of_the_next_token_holds_before_it_starts(kept: str, rule: str, n: int) -> None:
    model = RUN.replace("Rest { int k; }", f"Rest {{ {kept} }}").replace("r.k == n;", rule)
    asked = GoalConfiguration("helm", "Run", 0, False, (5, 20), None, None, (("n", n),))
    case = Case((simulator("psim", model, "helm lamp"),), (asked,))
    agree(case)
    holds = [(event.tick, event.predicate) for event in case.fly(1, compiles=True).events if event.timeline == "helm"]
    assert ((5, "Run") in holds) == (n != 0 and (kept, n) not in (("Few k;", 2), ("int k = LIMIT;", 2)))


@pytest.mark.parametrize("n", [0, 1])
def test_a_token_that_leaves_no_room_for_what_comes_after_the_next_fails_in_time(n: int) -> None:
    model = RUN.replace("duration == 4;", "duration == 1;")
    model += "Helm::Rest { duration == 1; meets(object.Halt h); h.duration == k; }"
    agree(
        Case(
            (simulator("psim", model, "helm lamp"),),
            (GoalConfiguration("helm", "Run", 0, False, (5, 20), None, None, (("n", n),)),),
        )
    )


SLIT = """
class Slit extends AgentTimeline {
  predicate Closed { } predicate Opening { } predicate Open { } Slit(Mode m) { super(m, "Closed"); }
}
class Lamp extends AgentTimeline { predicate Off { } predicate On { } Lamp(Mode m) { super(m, "Off"); } }
Slit::Opening { duration == 9; meets(Open open); }
Slit::Open { duration >= 20; duration <= 90; starts(Lamp.On on); on.end == end; }
Slit slit = new Slit(Internal); Lamp lamp = new Lamp(Internal); close();
"""


@pytest.mark.parametrize(("timeline", "predicate"), [("slit", "Open"), ("lamp", "On")])
@pytest.mark.parametrize(("at", "start"), [(0, (10, 80)), (3, (4, 80)), (8, (9, 12)), (8, (13, 60)), (9, (11, 60))])
def test_what_is_asked_for_and_what_a_rule_begins_are_merged_by_the_planner(
    timeline: str, predicate: str, at: int, start: tuple[float, float]
) -> None:
    opening = GoalConfiguration("slit", "Opening", 0, False, (1, 5))
    asked = GoalConfiguration(timeline, predicate, at, False, start)
    agree(Case((simulator("psim", SLIT, "slit lamp"),), (opening, asked), until=120))


def test_what_is_asked_with_a_range_is_left_to_the_general_engine() -> None:
    goal = GoalConfiguration("helm", "Run", 3, False, (5.0, 9.0), None, None, (("v", (1.0, 2.0)), ("n", 2)))
    agree(steps(goal))


def test_a_request_that_its_owner_does_not_know_is_refused() -> None:
    agree(steps(GoalConfiguration("helm", "Fly", 3, False, (5.0, 9.0))))


def test_a_model_that_fails_in_flight_fails_the_same() -> None:
    agree(steps(run(3, (5, 5), 200.0), until=20))


COUNT = """
class Count extends AgentTimeline { predicate At { int k; } Count(Mode m) { super(m, "At"); } }
class Copy extends AgentTimeline { predicate None { } predicate Of { int k; } Copy(Mode m) { super(m, "None"); } }
"""
COUNTER = """
Count::At { duration == 5; meets(object.At next); next.k == k + 1; }
Count count = new Count(Internal);
close();
fact(count.At first); first.start == 0; first.k == 0;
"""
COPIER = """
Count::At { equals(Copy.Of c); c.k == k * 2; }
Count count = new Count(External); Copy copy = new Copy(Internal);
close();
"""


def test_observations_are_inputs() -> None:
    counter = simulator("counter", COUNT + COUNTER, "count")
    copier = simulator("copier", COUNT + COPIER, "copy", "count")
    agree(Case((counter, copier), until=23))


def test_the_machine_has_the_numbers_of_the_compiler() -> None:
    text = (ROOT / "runtime" / "determined" / "machine.py").read_text(encoding="utf-8")
    found = {name: int(number) for number, name in re.findall(r"op == (\d+):  # ([A-Z_]+)", text)}
    assert len(found) > 38
    assert {name: getattr(code, name) for name in found} == found


def test_what_was_executed_is_on_record() -> None:
    case = steps(run(3, (5, 9), 10.0), run(12, (14, 14), -3.0))
    agent, programs = case.agent()
    loaded = register_program(agent, programs, 0)
    assert loaded is not None
    trace = Trace()
    world = World(agent, 1, {}, trace)
    world.learn(programs.programs[0])
    reactor = DeterminedReactor(agent.reactors[0], loaded, world.in_force, _never, 40, trace)
    requests = [(goal.at, request_of(goal, -1 - n, KINDS)) for n, goal in enumerate(case.goals)]
    outcome = Agent(agent, [reactor], requests, 1, trace).run()
    record = reactor.record().tokens
    by_key = {token.key: token for token in record}
    assert len(by_key) == len(record)
    published = sorted(
        (event.tick, event.timeline, event.predicate) for event in outcome.events if event.kind is EventKind.OBSERVATION
    )
    active = [token for token in record if token.state == "active"]
    assert sorted((token.start, token.object, token.predicate.rpartition(".")[2]) for token in active) == published
    assert {token.origin for token in active} == {"fact", "request", "rule", "own"}
    for token in record:
        if token.state == "merged":
            into = by_key[token.merged_into]
            assert (into.state, into.object, into.start, into.end) == ("active", token.object, token.start, token.end)
        for made in token.runs:
            assert all(key in by_key for key in made.children)
    second = [token for token in active if token.predicate == "Motion.Step"]
    mirror, following = second[0].runs[0].children
    assert by_key[mirror].predicate == "Mirror.Holds" and by_key[following] == second[1]
    assert second[0].end == second[1].start == 1


def _never(trace: Trace) -> NoReturn:
    raise AssertionError("the machine does not stop")


@pytest.mark.parametrize("seed", range(20))
def test_the_judge_agrees_with_what_was_executed(seed: int) -> None:
    agent, programs = random_case(seed).agent()
    found = []
    for compiles in (False, True):
        outcome, record = record_mission(agent, programs, seed, compiles=compiles)
        assert len(record.reactors[0].tokens) >= len(agent.reactors[0].internal)
        report = judge_mission(agent, programs.programs, outcome, record)
        found.append({(each.kind, each.name) for each in report.disagreements})
    # What is within a hair of a bound may be told differently by the judge, but then of both.
    assert found[0] == found[1]


def test_the_judge_sees_a_value_that_was_not_computed() -> None:
    agent, programs = steps(run(3, (5, 9), 10.0)).agent()
    outcome, record = record_mission(agent, programs, 1)
    assert judge_mission(agent, programs.programs, outcome, record).disagreements == ()
    (reactor,) = record.reactors
    place = next(k for k, token in enumerate(reactor.tokens) if token.predicate == "Motion.Step" and token.start == 3)
    step = reactor.tokens[place]
    wrong = step._replace(arguments=(step.arguments[0], 40.0))
    tokens = (*reactor.tokens[:place], wrong, *reactor.tokens[place + 1 :])
    altered = record._replace(reactors=(reactor._replace(tokens=tokens),))
    assert judge_mission(agent, programs.programs, outcome, altered).disagreements


ARM = """
class Arm extends AgentTimeline { predicate Rest { } predicate Act { } Arm(Mode m) { super(m, "Rest"); } }
"""
LATENCY = 3


@pytest.mark.parametrize("rule", ["duration == 0;", "duration <= 0;", "duration == 5;", "end == 12;", "end <= 9;"])
@pytest.mark.parametrize(
    ("duration", "end"), [(None, None), ((3, 3), None), ((0, 0), None), (None, (9, 9)), (None, (5, 20))]
)
def test_what_cannot_last_as_it_must_is_refused_as_soon_as_in_general(
    rule: str, duration: tuple[int, int] | None, end: tuple[int, int] | None
) -> None:
    text = f"{ARM} Arm::Act {{ {rule} }} Arm arm = new Arm(Internal); close();"
    for start in ((5, 8), (20, 20)):
        goal = GoalConfiguration("arm", "Act", mandatory=True, start=start, end=end, duration=duration)
        case = Case((simulator("sim", text, "arm", latency=LATENCY),), (goal,))
        assert case.is_compiled()
        assert told(case.fly(1, compiles=True)) == told(case.fly(1, compiles=False))
