"""The story of a goal that stayed open to the end tells what was waited for."""

from pathlib import Path

import pytest

from checker.batch.worker import Task, fly_one
from checker.buckets import group_failures
from checker.findings import Fault
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.variant import load_over, open_over
from checker.rendering import waiting_text
from checker.sampling.seeds import mission_seed
from checker.waiting import beside, waited_for
from nddl_lang.text.read import real_path
from runtime.executive.configuration import AgentConfiguration, ReactorConfiguration
from runtime.executive.outcome import (
    Conflict,
    ConflictElement,
    ElementKind,
    Event,
    EventKind,
    Outcome,
    Phase,
    Reason,
    ReasonKind,
)
from runtime.plan.readout.names import TokenName
from tests.checker.fault_study import faults_in, laid_out
from tests.checker.told_steps import failed_mission

MODEL = Path(__file__).resolve().parent / "unseen/papermill"
DAM = MODEL.parent / "dam"
REJECTED = 6  # the fault: three times as many minutes as were asked for

pytestmark = pytest.mark.once


def test_what_goes_on_is_told_through_all_planners_with_what_the_last_one_uses() -> None:
    mission, found = read_mission(MODEL / "mission.toml")
    assert mission is not None, found
    path = real_path(MODEL / "foreman.nddl")
    overlay = ((str(path), path.read_text().replace("full.end == end;", "")),)
    models = load_models(mission, open_over(overlay))
    task = Task(1, mission_seed(mission.check.seed, 1))
    result = fly_one(load_over(overlay, models.agent), task, keep_trace=True)
    assert result.outcome is not None
    assert [waiting_text(one) for one in waited_for(result.outcome, models.agent)] == [
        "Order on `sales`, asked for by the mission file at tick 0, goes on since tick 672",
        "Batch on `line`, asked for by office at tick 687, goes on since tick 688; of what foreman uses, "
        "`pulper` holds Empty since tick 727, `dryer` holds Cold since tick 797, `winder` holds Still since tick 835",
    ]


def test_what_was_asked_for_in_vain_is_told_with_what_rules_it_out(tmp_path: Path) -> None:
    """The warden rejects at tick 0 what the dispatcher needs for a goal, which begins all the same and has no end."""
    place = laid_out(DAM, list(faults_in(DAM))[REJECTED], tmp_path / "dam")
    given, failed = failed_mission(place, 1)
    (bucket,) = group_failures((failed,))
    steps = given.story(failed, Fault(bucket, None, None)).steps
    events = [step.subject for step in steps if isinstance(step.subject, Event)]
    assert [(one.tick, one.kind, one.reactor, one.predicate) for one in events] == [
        (0, EventKind.REJECT, "warden", "Release")
    ]
    lines = [step.place.text for step in steps if step.place is not None]
    assert {"minutes * 3", "duration <= RELEASE_MAX"} <= set(lines)
    assert [str(step.kind) for step in steps[-3:]] == ["event", "waiting", "abort"]


@pytest.mark.parametrize(("kind", "expected"), [("observation", ["Lift on `crane`"]), ("shared end", [])])
def test_what_was_under_way_is_told_beside_what_went_on_for_no_known_reason(kind: str, expected: list[str]) -> None:
    planner = ReactorConfiguration("planner", "p.nddl", 0, 50, ("work",), ("boat", "crane", "mast"))
    world = ReactorConfiguration("world", "w.nddl", 0, 1, ("boat", "crane", "mast"), ())
    asked = [(1, "mast", "Raise"), (4, "boat", "Hold"), (6, "crane", "Lift"), (7, "mast", "Lower")]
    events = [Event(t, Phase.DELIBERATE, EventKind.REQUEST, "planner", x, p, request=t) for t, x, p in asked]
    events += [Event(t + 1, Phase.SYNCHRONISE, EventKind.OBSERVATION, "world", x, p) for t, x, p in asked[:3]]
    events.sort(key=lambda one: one.tick)
    element = ConflictElement(ElementKind(kind), None, "", None, None, ())
    reason = Reason(ReasonKind.GOES_ON, TokenName("Boat.Hold", 3), tick=40, since=5)
    broken = Event(40, Phase.REPAIR, EventKind.RELAX, "planner", reason=reason, conflict=Conflict((element,)))
    outcome = Outcome(1, 90, 40, None, (), (*events, broken), ())
    found = beside(broken, outcome, AgentConfiguration("m", "", 90, (planner, world)))
    assert [waiting_text(one).partition(",")[0] for one in found] == expected
