"""A story tells a draw before what came of it: that of the repair first, then those of the end."""

from pathlib import Path

import pytest

from checker.contrast import Contrast, Difference
from checker.steps import StepKind
from runtime.executive.outcome import Draw, Event, EventKind
from tests.checker.fault_study import faults_in, laid_out
from tests.checker.told_steps import JOB_MISSION, failed_mission, steps_of

pytestmark = pytest.mark.once

DEPOT = Path(__file__).parent / "unseen" / "depot"
TOO_LITTLE_TIME, LONG_WASH = 4, 14  # the fault, and a mission in which charging and washing take long together

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
REDRAWN = (
    JOB_MISSION
    + """
[parameters.LATE]
mode = "intra"
update = 10
"""
)


@pytest.mark.parametrize("number", range(6))
def test_each_draw_stands_before_what_came_of_it(tmp_path: Path, number: int) -> None:
    files = {"shared.nddl": SHARED, "planner.nddl": PLANNER, "simulator.nddl": SIMULATOR, "mission.toml": REDRAWN}
    steps = steps_of(tmp_path, files, number)
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


def test_each_draw_is_told_that_sets_the_mission_apart(tmp_path: Path) -> None:
    place = laid_out(DEPOT, list(faults_in(DEPOT))[TOO_LITTLE_TIME], tmp_path / "depot")
    campaign, result = failed_mission(place, LONG_WASH)
    apart = Contrast(18, (Difference("CURRENT", 1.4, 1.1), Difference("DIRT", 1.4, 0.9)), True, 4, (), 0)
    told = []
    for contrast in (None, apart):
        subjects = [one.subject for one in campaign.story(result, None, (), contrast).steps]
        told.append({one[0].parameter for one in subjects if isinstance(one, tuple) and isinstance(one[0], Draw)})
    assert told == [{"CURRENT"}, {"CURRENT", "DIRT"}]
