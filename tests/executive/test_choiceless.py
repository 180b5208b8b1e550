"""What register code leaves to the planner: tokens that may be one, what follows an open end, what competes."""

import pytest

from runtime.executive.configuration import GoalConfiguration, ParameterConfiguration
from runtime.executive.outcome import EventKind
from tests.executive.determined_models import Case, told
from tests.executive.flying import history, in_all_ways, simulator
from tests.executive.generated.choiceless import fly_choiceless

MODEL = """
class Lamp extends AgentTimeline { predicate Off { } predicate On { int n; } Lamp(Mode m) { super(m, "Off"); } }
class Hood extends AgentTimeline { predicate Shut { } predicate Open { int n; } Hood(Mode m) { super(m, "Shut"); } }
class Horn extends AgentTimeline { predicate Still { } predicate Loud { int n; } Horn(Mode m) { super(m, "Still"); } }
Lamp::On { duration == 4; FIRST }
Hood::Open { SECOND }
Horn::Loud { THIRD }
Lamp lamp = new Lamp(Internal); Hood hood = new Hood(Internal); Horn horn = new Horn(Internal); close();
"""
PAIR = ("equals(Hood.Open o); o.n == n;", "equals(Lamp.On l); l.n == n;", "")
RING = ("equals(Hood.Open o); o.n == n;", "equals(Horn.Loud h); h.n == n;", "equals(Lamp.On l); l.n == n;")
STARTS = ("starts(Hood.Open o); o.n == n;", "starts(Lamp.On l); l.n == n; duration == 4;", "")
GUARDED = ("if (n > 1) { equals(Hood.Open o); o.n == n; }", "equals(Lamp.On l); l.n == n;", "")


@pytest.mark.parametrize("rules", [PAIR, RING, STARTS, GUARDED], ids=["pair", "ring", "starts", "guarded"])
def test_two_rules_that_ask_for_each_other_begin_one_token_each(rules: tuple[str, str, str]) -> None:
    model = MODEL
    for word, rule in zip(("FIRST", "SECOND", "THIRD"), rules, strict=True):
        model = model.replace(word, rule)
    asked = GoalConfiguration("lamp", "On", 0, True, (3, 9), None, None, (("n", 2),))
    case = Case((simulator("sim", model, "lamp hood horn"),), (asked,), until=20)
    assert not case.is_compiled()
    outcome = case.fly(1, compiles=True)
    assert outcome.abort is None and not outcome.open_goals
    assert told(outcome) == told(case.fly(1, compiles=True, every_tick=True))
    names = {"lamp": "On", "hood": "Open"} | ({"horn": "Loud"} if rules is RING else {})
    shown = [event for event in outcome.events if event.kind is EventKind.OBSERVATION and event.tick]
    for timeline, predicate in names.items():
        mine = [(event.tick, event.predicate) for event in shown if event.timeline == timeline]
        assert mine[0] == (3, predicate) and mine[1][0] == 7 and len(mine) == 2


HELM = """
class Helm extends AgentTimeline { predicate Idle { } predicate Run { int n; } predicate Rest { int k; }
  Helm(Mode m) { super(m, "Idle"); } }
class Lamp extends AgentTimeline { predicate Off { } predicate On { } Lamp(Mode m) { super(m, "Off"); } }
Helm::Run { LASTS meets(object.Rest r); r.k == n; }
Helm::Rest { NEXT }
Helm helm = new Helm(Internal); Lamp lamp = new Lamp(Internal); close();
"""


@pytest.mark.parametrize("n", [0, 1, 2])
@pytest.mark.parametrize("lasts", ["", "duration >= 2;", "duration <= 4;"])
@pytest.mark.parametrize(
    "rule",
    [
        "k >= 1; duration == 2;",
        "start <= 9;",
        "end <= 12; duration >= 2;",
        "duration == k;",
        "equals(Lamp.On o); duration == 2;",
        "contained_by(Lamp.On o); duration == 2;",
        "duration == 2;",
    ],
)
def test_what_is_to_follow_an_open_end_is_held_against_its_rules_at_once(rule: str, lasts: str, n: int) -> None:
    model = HELM.replace("LASTS", lasts).replace("NEXT", rule)
    asked = GoalConfiguration("helm", "Run", 0, False, (5, 20), None, None, (("n", n),))
    in_all_ways(simulator("sim", model, "helm lamp"), 30, (asked,), (), 1)


ARMS = """
class Arm extends AgentTimeline { predicate Rest { } predicate Act { int n; } predicate Wipe { }
  Arm(Mode m) { super(m, "Rest"); } }
class Tap extends AgentTimeline { predicate Shut { } predicate Run { } Tap(Mode m) { super(m, "Shut"); } }
class Fan extends AgentTimeline { predicate Off { } predicate On { } Fan(Mode m) { super(m, "Off"); } }
RULES
Arm arm = new Arm(Internal); Tap tap = new Tap(Internal); Fan fan = new Fan(Internal); close();
"""


def asked(timeline: str, predicate: str, start: tuple[float, float], n: int | None = None) -> GoalConfiguration:
    return GoalConfiguration(timeline, predicate, 0, False, start, None, None, () if n is None else (("n", n),))


@pytest.mark.parametrize(
    ("rules", "goals"),
    [
        (  # what follows the tap's run on the arm, and a second command for the arm
            "Arm::Act { duration == n; } Tap::Run { meets(Arm.Wipe w); w.duration == 6; }",
            (asked("arm", "Act", (5, 11), 4), asked("arm", "Act", (9, 29), 1), asked("tap", "Run", (5, 25))),
        ),
        (  # a command ends what the fan is to follow, when it is too late for that
            "Arm::Act { starts(Tap.Run r); } Tap::Run { if (start < 12) { meets(Fan.On o); } } "
            "Fan::On { starts_during(Arm.Wipe w); met_by(object.Off b); } Fan::Off { duration >= 3; } "
            "Arm::Wipe { end <= 20; }",
            (asked("arm", "Act", (17, 37), 1), asked("arm", "Wipe", (9, 11)), asked("tap", "Run", (9, 11))),
        ),
        (  # two commands of two timelines for one time need a third
            "Arm::Act { starts(Fan.On o); duration == 3; } "
            "Tap::Run { equals(Fan.On o); equals(Arm.Wipe w); duration <= 3; }",
            (asked("tap", "Run", (5, 11)), asked("arm", "Act", (5, 25), 1)),
        ),
    ],
    ids=["between", "too late", "shared"],
)
def test_what_competes_is_ordered_by_the_planner(rules: str, goals: tuple[GoalConfiguration, ...]) -> None:
    in_all_ways(simulator("sim", ARMS.replace("RULES", rules), "arm tap fan"), 40, goals, (), 1)


@pytest.mark.parametrize(
    ("rule", "end", "duration", "over"),
    [
        ("duration <= 10;", (0, 14), None, 20),
        ("duration <= 10;", None, (1, 4), 20),
        ("duration >= 3; duration <= 30;", (35, 38), (26, 28), 40),
        ("duration == 4;", (0, 14), (4, 4), 14),
        ("duration == 4;", None, None, 14),
    ],
)
def test_who_has_taken_back_what_runs_binds_it_no_more(
    rule: str, end: tuple[int, int] | None, duration: tuple[int, int] | None, over: int
) -> None:
    text = ARMS.replace("RULES", f"Arm::Act {{ {rule} }}")
    goal = GoalConfiguration("arm", "Act", 0, False, (10, 30), end, duration, (("n", 1),), 12)
    outcome = in_all_ways(simulator("sim", text, "arm tap fan"), 60, (goal,), (), 1)
    assert [line.partition(" ")[0] for line in history(outcome, "arm")][1:] == ["10", str(over)]


@pytest.mark.parametrize("seed", [*range(40), 5218, 6278, 6479, 7034, 20066])
def test_a_random_simulator_without_a_choice_flies_alike_in_all_ways(seed: int) -> None:
    fly_choiceless(seed)


DRAWN = """
int LAG = [1 4];
class Arm extends AgentTimeline { predicate Rest { } predicate Act { int n; } Arm(Mode m) { super(m, "Rest"); } }
Arm::Act { RULE }
Arm arm = new Arm(Internal); close();
"""


@pytest.mark.parametrize(
    "guard",
    [
        "if (n < 3)",
        "bool few; few == (n < 3); if (few)",
        "int m; m == n; if (m == 2)",
        "bool yes; yes == true; if (yes)",
    ],
)
@pytest.mark.parametrize("update", [1, 50])
def test_a_draw_behind_a_condition_is_drawn_by_the_general_engine_too(guard: str, update: int) -> None:
    model = DRAWN.replace("RULE", f"{guard} {{ int lag; lag == sampledParameter(LAG); duration == lag; }}")
    lag = ParameterConfiguration("LAG", 1, 4, distribution="discrete", values=(1, 2, 4), mode="intra", update=update)
    for seed in range(3):
        outcome = in_all_ways(simulator("sim", model, "arm"), 30, (asked("arm", "Act", (13, 19), 2),), (lag,), seed)
        holds = [event.tick for event in outcome.events if event.kind is EventKind.OBSERVATION]
        assert len(holds) == 3 and 1 <= holds[2] - holds[1] <= 4
