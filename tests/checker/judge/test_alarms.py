"""The judge raises no false alarms: missions in which it once did."""

from pathlib import Path
from shutil import copytree
from typing import Any

import pytest

from checker.judge.judge import judge_mission
from checker.judge.rendering import disagreement_text
from checker.mission import read_mission
from checker.models import load_models
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.mission import record_mission
from runtime.executive.record import ValueRange
from tests.checker.judge.corruption import again
from tests.checker.judge.missions import walking
from tests.executive.determined_models import random_case
from tests.executive.flying import Flown, flown, planner, simulator
from tests.programs import programs_of

KILN = Path(__file__).parents[1] / "unseen/kiln"

# 7: a guard at a real that is near its bound; 85 and 428: numbers beyond all bounds; 3372: a merged token that left the
# plan before a repair gave up the bound of its end.
ONCE_ALARMED = (7, 85, 428, 3372)


@pytest.mark.parametrize("compiles", [True, False])
@pytest.mark.parametrize("number", ONCE_ALARMED)
def test_a_right_mission_raises_no_alarm(number: int, compiles: bool) -> None:
    agent, programs = random_case(number).agent()
    outcome, record = record_mission(agent, programs, number, compiles=compiles)
    report = judge_mission(agent, programs.programs, outcome, record)
    assert [disagreement_text(one) for one in report.disagreements] == []
    assert report.judged > 100


def test_what_a_loop_asked_for_is_told_apart_when_a_repair_has_forgotten_some_of_it(tmp_path: Path) -> None:
    folder = copytree(KILN, tmp_path / "kiln")
    planner = folder / "planner.nddl"
    right, wrong = (f"    {relation}(Door.Open first);" for relation in ("contains", "met_by"))
    assert right in planner.read_text()
    planner.write_text(planner.read_text().replace(right, wrong))
    mission, _ = read_mission(folder / "mission.toml")
    assert mission is not None
    agent = load_models(mission).agent
    programs = programs_of(agent)
    outcome, record = record_mission(agent, programs, 0)
    assert any(one.fate == "cut" for each in record.reactors for one in each.tokens)
    report = judge_mission(agent, programs.programs, outcome, record, programs.constraints)
    assert [disagreement_text(one) for one in report.disagreements] == []
    (fire,) = [one for each in record.reactors for one in each.tokens if one.predicate == "Plan.Fire"]
    assert [each.children for each in fire.runs] == [(6, 7, 8)]


@pytest.mark.parametrize(("later", "found"), [(5, set()), (0, {"overlap"})])
def test_of_tokens_that_repairs_put_in_each_others_place_the_last_counts(later: int, found: set[str]) -> None:
    mission = walking(1)
    reactor = mission.record.reactors[0]
    steps = [one for one in reactor.tokens if one.predicate == "Walk.Step" and one.fate == "over"]
    taken = steps[len(steps) // 2]
    assert isinstance(taken.end, int)
    first = taken._replace(fate="cut", tick=taken.end)
    second = first._replace(key=max(one.key for one in reactor.tokens) + 1, tick=taken.end + later)
    others = [one for one in reactor.tokens if one.key != taken.key]
    altered = reactor._replace(tokens=tuple(sorted([*others, first, second])))
    report = again(mission._replace(record=mission.record._replace(reactors=(altered,))))
    assert {one.kind for one in report.disagreements} == found


SHARED = """
class Job extends AgentTimeline { predicate Wait { } predicate Work { } Job(Mode m) { super(m, "Wait"); } }
class Mount extends AgentTimeline { predicate Rest { } predicate Track { } Mount(Mode m) { super(m, "Rest"); } }
class Camera extends AgentTimeline { predicate Warm { } predicate Expose { } Camera(Mode m) { super(m, "Warm"); } }
"""
NIGHT = f"""{SHARED}
Reservoir disk = new Reservoir(0.0, 0.0, 400.0);
Job::Work {{
    contains(Mount.Track track);
    contains(Camera.Expose expose);
    track.end == end;
    expose.start >= start + 9;
    duration <= 10;
    any(Reservoir.produce data);
    data.time == expose.end;
}}
Job job = new Job(Internal);
Mount mount = new Mount(External);
Camera camera = new Camera(External);
close();
"""
SITE = f"""{SHARED}
Mount::Track {{ duration == 20; }}
Camera::Expose {{ duration <= 5; }}
Mount mount = new Mount(Internal);
Camera camera = new Camera(Internal);
close();
"""


def of_two_plans(fate: str) -> Flown:
    """A mission that no repair has saved: what its last plan leaves open an earlier one had fixed."""
    work = GoalConfiguration("job", "Work", start=(2, 4))
    mission = flown(
        planner("night", NIGHT, "job", "mount camera"),
        simulator("site", SITE, "mount camera"),
        until=40,
        goals=(work,),
    )
    assert mission.outcome.abort is not None and mission.outcome.abort.code == "F1"
    reactor = mission.record.reactors[0]
    loose = ValueRange(3.0, 12.0)
    changes: dict[str, dict[str, Any]] = {
        "Camera.Expose": {"fate": fate},
        "Reservoir.produce": {"start": loose, "end": loose},
    }
    tokens = tuple(one._replace(**changes.get(one.predicate, {})) for one in reactor.tokens)
    reactors = (reactor._replace(tokens=tokens), *mission.record.reactors[1:])
    return mission._replace(record=mission.record._replace(reactors=reactors))


@pytest.mark.parametrize(("fate", "alarms"), [("cut", 0), ("end", 1)])
def test_values_of_an_earlier_plan_do_not_bind_the_last_one(fate: str, alarms: int) -> None:
    assert len(again(of_two_plans(fate)).disagreements) == alarms
