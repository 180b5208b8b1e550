"""Plans that take in ever more: what looks back at its own kind ends, anything else ends with a message."""

from functools import partial

import pytest

import runtime.executive.mission
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.planning import Planner
from runtime.limits import LimitError
from tests.executive.flying import fly, history, planner, simulator

GPS = 'class Gps extends AgentTimeline { predicate Idle { } predicate Fix { } Gps(Mode m) { super(m, "Idle"); } }'
NAV = """
class Nav extends AgentTimeline { predicate Hold { } predicate Surface { } Nav(Mode m) { super(m, "Hold"); } }
Nav::Surface { contains(Gps.Fix fix); duration <= 20; }
Gps::Fix { after(Nav.Surface s); }
Nav nav = new Nav(Internal); Gps gps = new Gps(External); close();
"""
WORLD = f"{GPS} Gps::Fix {{ duration == 3; }} Gps gps = new Gps(Internal); close();"
ENDLESS = """
class Job extends AgentTimeline { predicate Rest { } predicate Work { } Job(Mode m) { super(m, "Rest"); } }
class Note { predicate Line { int n; } }
Job::Work { any(Note.Line first); first.n == 1; duration <= 10; }
Note::Line {
  any(Line next);
  next.n == n + 1;
}
Job job = new Job(Internal); Note note = new Note(); close();
"""


def work_without_an_end() -> None:
    goal = GoalConfiguration("job", "Work", start=(5, 20))
    fly(planner("worker", ENDLESS, "job"), goals=(goal,), until=30)


def limited(deepest: int, most_changes: int, *given: object, **named: object) -> Planner:
    """A planner with limits of its own."""
    made = Planner(*given, **named)  # type: ignore[arg-type]
    made.deepest = deepest
    made.bench.engine.trail_most = most_changes
    return made


def test_what_looks_back_at_its_own_kind_finds_an_end_before_the_mission() -> None:
    goal = GoalConfiguration("nav", "Surface", start=(5, 10), mandatory=True)
    navigator, world = planner("navigator", GPS + NAV, "nav", "gps"), simulator("world", WORLD, "gps")
    outcome = fly(navigator, world, goals=(goal,), until=40)
    assert outcome.abort is None and outcome.open_goals == ()
    assert history(outcome, "nav")[:2] == ["0 Hold", "5 Surface"]


@pytest.mark.parametrize(
    ("deepest", "changes", "said"),
    [(40, 2**62, "more than 40 decisions are in force"), (2**62, 1024, "more than 1024 changes of its plan")],
)
def test_a_plan_that_takes_in_ever_more_ends_with_the_line_that_asks(
    deepest: int, changes: int, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(runtime.executive.mission, "Planner", partial(limited, deepest, changes))
    with pytest.raises(
        LimitError, match=f"{said}.*`worker` plans [0-9]+ tokens `Note.Line`, for worker.nddl:7"
    ) as found:
        work_without_an_end()
    assert "max_depth" in found.value.advice


SIMULATED = """
class Tap extends AgentTimeline { predicate Shut { } predicate Run { } Tap(Mode m) { super(m, "Shut"); } }
class Arm extends AgentTimeline { predicate Rest { } predicate Wipe { int k; } Arm(Mode m) { super(m, "Rest"); } }
Tap::Run { meets(Arm.Wipe w); w.k == 2; w.duration == 1; }
Arm::Wipe { met_by(object.Wipe w); }
Tap tap = new Tap(Internal); Arm arm = new Arm(Internal); close();
"""


def test_a_simulator_that_takes_in_ever_more_once_it_is_planned_for_ends_with_the_line_that_asks(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(runtime.executive.mission, "Planner", partial(limited, 2**62, 4096))
    goal = GoalConfiguration("tap", "Run", start=(3, 5))
    with pytest.raises(
        LimitError, match=r"more than 4096 changes.*`world` plans [0-9]+ tokens `Arm.Wipe`, for world.nddl:6"
    ):
        fly(simulator("world", SIMULATED, "tap arm"), goals=(goal,), until=30)
