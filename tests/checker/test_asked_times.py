"""A time that was asked for, or observed, leads to lines of the reactors that stand before, or behind, in a chain."""

from pathlib import Path

import pytest

from checker.batch.worker import Task, fly_one
from checker.causes import failed_by
from checker.culprit import culprit_of
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.variant import load_over, open_over
from checker.proofs.conflict import Finding, confirm
from checker.proofs.places import text_of
from checker.sampling.seeds import mission_seed
from checker.steps import StepKind
from checker.waiting import Waiting
from nddl_lang.text.read import real_path
from runtime.executive.events import single_events
from runtime.executive.outcome import ElementKind, Event, EventKind
from tests.checker.told_steps import failed_mission

UNSEEN = Path(__file__).resolve().parent / "unseen"

CHAIN = {
    "shared.nddl": """
#include "TREX.nddl"
class Motor extends AgentTimeline { predicate Off { } predicate Run { int metres; } Motor(Mode m) { super(m, "Off"); } }
class Wind extends AgentTimeline { predicate Gale { } predicate Calm { } Wind(Mode m) { super(m, "Calm"); } }
class Way extends AgentTimeline {
  predicate There { } predicate Ready { } predicate Go { int metres; }
  Way(Mode m) { super(m, "There"); }
}
class Work extends AgentTimeline {
  predicate Idle { } predicate Survey { int metres; }
  Work(Mode m) { super(m, "Idle"); }
}
""",
    "nav.nddl": """
#include "shared.nddl"
Way::Ready { duration == 10; }
Way::Go { contains(Motor.Run run); run.metres == metres; run.end == end; }
Way way = new Way(Internal); Motor motor = new Motor(External); close();
""",
    "sim.nddl": """
#include "shared.nddl"
float SPEED = 0.5;
Motor::Run { duration == ceil(metres / SPEED); }
Wind::Calm { duration == 60; meets(object.Gale gale); }
Motor motor = new Motor(Internal); Wind wind = new Wind(Internal); close();
""",
    "mission.toml": """
mission = { name = "chain", final_tick = 200 }
goal = [{ timeline = "work", predicate = "Survey", mandatory = true, start = [3, 20], parameters = { metres = 30 } }]
reactor = [
  { name = "base", model = "base.nddl", latency = 1, lookahead = 150, internal = ["work"], external = ["way", "wind"] },
  { name = "nav", model = "nav.nddl", latency = 1, lookahead = 100, internal = ["way"], external = ["motor"] },
  { name = "sim", model = "sim.nddl", lookahead = 1, internal = ["motor", "wind"] },
]
""",
}
OWNED = "Work work = new Work(Internal); Way way = new Way(External); Wind wind = new Wind(Observe); close();"
ASKS = "contains(Way.Go go); go.metres == metres; go.end == end;"

pytestmark = pytest.mark.once


@pytest.mark.parametrize(
    ("name", "file", "constant", "wanted", "number"),
    [
        ("crane", "foreman.nddl", "BAY_MAX", 180, 9),  # two planners: the other one gives up what was asked
        ("cablecar", "operator.nddl", "RIDE_MAX", 260, 2),  # refused by the world
    ],
)
def test_the_limit_of_who_asked_is_what_breaks(name: str, file: str, constant: str, wanted: int, number: int) -> None:
    mission, found = read_mission(UNSEEN / name / "mission.toml")
    assert mission is not None, found
    path = real_path(UNSEEN / name / file)
    given = next(line for line in path.read_text().splitlines() if line.startswith(f"int {constant} ="))
    overlay = ((str(path), path.read_text().replace(given, f"int {constant} = {wanted};")),)
    models = load_models(mission, open_over(overlay))
    task = Task(number, mission_seed(mission.check.seed, number))
    result = fly_one(load_over(overlay, models.agent), task, keep_trace=True)
    conflict = failed_by(result.outcome).conflict
    culprit = culprit_of(conflict)
    assert conflict is not None
    assert culprit.place is not None
    assert [one.text for one in (culprit.place, *culprit.limits)] == [
        f"duration <= {constant}",
        f"{constant} = {wanted}",
    ]
    assert result.outcome is not None
    conflicts = [conflict, *(one.conflict for one in single_events(result.outcome.events) if one.conflict is not None)]
    asked = [one for each in conflicts for one in each.elements if one.kind is ElementKind.REQUEST]
    assert any(one.says is not None and one.terms[0].name == "eq" for one in asked)  # as in the plan of who asked
    proved = confirm(conflict, text_of(models.agent, models.programs))
    assert (proved.finding, proved.is_minimal) == (Finding.CONFIRMED, True)


@pytest.mark.parametrize(
    ("rule", "repairs"),
    [
        (f"{ASKS} contained_by(Wind.Calm calm);", 0),  # the planner in the middle sleeps, and is asked for no end
        (f"{ASKS} contains(Way.Ready ready); ready before go; duration <= 60;", 1),  # its plan breaks first
    ],
)
def test_what_goes_on_by_the_word_of_a_planner_leads_to_the_line_of_its_simulator(
    rule: str, repairs: int, tmp_path: Path
) -> None:
    files = CHAIN | {"base.nddl": f'#include "shared.nddl"\nWork::Survey {{ {rule} }}\n{OWNED}'}
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    given, failed = failed_mission(tmp_path, 1)
    conflict = failed_by(failed.outcome).conflict
    assert conflict is not None
    assert [one.kind for one in conflict.elements].count(ElementKind.SHARED_END) == 2
    assert {"ceil(metres / SPEED)", "SPEED = 0.5"} <= {
        one.place.text for one in conflict.elements if one.place is not None
    }
    proved = confirm(conflict, text_of(given.models.agent, given.models.programs))
    assert (proved.finding, proved.is_minimal, proved.untranslated) == (Finding.CONFIRMED, True, ())
    steps = given.story(failed, None).steps
    told = [step.subject for step in steps if step.kind is StepKind.EVENT]
    repaired = [one for one in told if isinstance(one, Event) and one.kind is EventKind.RELAX]
    assert [one.reactor for one in repaired] == ["nav"] * repairs
    assert [step.kind for step in steps].count(StepKind.BROKEN) == repairs


def test_what_was_under_way_when_something_was_to_be_reached_is_told_through_all_reactors(tmp_path: Path) -> None:
    wanted = """
[[property]]
name = "surveyed"
kind = "reached"
timeline = "work"
predicate = "Survey"
by = 40
"""
    files = CHAIN | {"base.nddl": f'#include "shared.nddl"\nWork::Survey {{ {ASKS} }}\n{OWNED}'}
    for name, text in files.items():
        (tmp_path / name).write_text(text + wanted * (name == "mission.toml"))
    given, failed = failed_mission(tmp_path, 1)
    steps = [step for step in given.story(failed, None).steps if step.kind is StepKind.WAITING]
    told = [
        (step.tick, step.subject.predicate, step.subject.since) for step in steps if isinstance(step.subject, Waiting)
    ]
    assert told == [(40, "Go", 3), (40, "Run", 3)]
