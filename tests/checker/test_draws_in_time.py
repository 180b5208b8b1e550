"""A story tells a draw before what came of it: that of the repair first, then those of the end."""

from pathlib import Path

import pytest

from checker.batch.worker import fly_one
from checker.buckets import group_failures
from checker.campaign import Campaign
from checker.findings import Fault
from checker.mission import read_mission
from checker.models import load_models
from checker.oracle import Verdict
from checker.pinned import pinned
from checker.steps import Step, StepKind
from runtime.executive.outcome import Draw, Event, EventKind

pytestmark = pytest.mark.once

SHARED = """#include "TREX.nddl"
class Job extends AgentTimeline { predicate Idle { } predicate Do { } Job(Mode m) { super(m, "Idle"); } }
class Dev extends AgentTimeline { predicate Off { } predicate Run { } Dev(Mode m) { super(m, "Off"); } }
"""
PLANNER = """#include "shared.nddl"
int RUN_MAX = 5;
Job::Do { contains(Dev.Run run); run.end == end; run.duration <= RUN_MAX; }
Job job = new Job(Internal);
Dev dev = new Dev(External);
close();
"""
SIMULATOR = """#include "shared.nddl"
int LATE = [6 12];
Dev::Run { int late; late == sampledParameter(LATE); duration == late; }
Dev dev = new Dev(Internal);
close();
"""
MISSION = """
[mission]
name = "late"
final_tick = 60

[[reactor]]
name = "planner"
model = "planner.nddl"
lookahead = 60
internal = ["job"]
external = ["dev"]

[[reactor]]
name = "simulator"
model = "simulator.nddl"
lookahead = 1
internal = ["dev"]

[[goal]]
timeline = "job"
predicate = "Do"
mandatory = true

[parameters.LATE]
mode = "intra"
update = 10
"""


def _steps(folder: Path, number: int) -> tuple[Step, ...]:
    files = {"shared.nddl": SHARED, "planner.nddl": PLANNER, "simulator.nddl": SIMULATOR, "mission.toml": MISSION}
    for name, text in files.items():
        (folder / name).write_text(text)
    mission, found = read_mission(folder / "mission.toml")
    assert mission is not None, found
    models = load_models(mission)
    given = Campaign(mission, models, pinned(models))
    failed = fly_one(given.load(models.agent), given.task(number))
    assert failed.verdict is Verdict.FAIL
    (bucket,) = group_failures((failed,))
    return given.story(failed, Fault(bucket, None, None)).steps


@pytest.mark.parametrize("number", range(6))
def test_each_draw_stands_before_what_came_of_it(tmp_path: Path, number: int) -> None:
    steps = _steps(tmp_path, number)
    draws = [one.subject[0] for one in steps if isinstance(one.subject, tuple)]
    assert draws
    assert all(isinstance(one, Draw) and one.parameter == "LATE" for one in draws)
    repairs = [
        at for at, one in enumerate(steps) if isinstance(one.subject, Event) and one.subject.kind is EventKind.RELAX
    ]
    drawn = [at for at, one in enumerate(steps) if one.kind is StepKind.DRAW]
    assert drawn[0] < repairs[0]
    assert steps[drawn[0]].tick == 0
    ticks = [one.tick for one in steps if one.kind in (StepKind.DRAW, StepKind.EVENT) and one.tick is not None]
    assert ticks == sorted(ticks)
