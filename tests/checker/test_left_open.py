"""A story says which argument of a request was left open, where what was asked for goes on longer than planned."""

from pathlib import Path

import pytest

from checker.requested import PlannerChoice
from checker.steps import StepKind
from tests.checker.told_steps import JOB_MISSION, steps_of

pytestmark = pytest.mark.once

SHARED = """#include "TREX.nddl"
class Job extends AgentTimeline { predicate Idle { } predicate Do { } Job(Mode m) { super(m, "Idle"); } }
class Dev extends AgentTimeline { predicate Off { } predicate Run { int ticks; } Dev(Mode m) { super(m, "Off"); } }
"""
PLANNER = """#include "shared.nddl"
Job::Do {
    contains(Dev.Run first);
    contains(Dev.Run second);
    first.ticks == 4;
    first before second;
    second.end == end;
    duration <= 20;
}
Job job = new Job(Internal);
Dev dev = new Dev(External);
close();
"""
SIMULATOR = """#include "shared.nddl"
Dev::Run { duration == ticks; }
Dev dev = new Dev(Internal);
close();
"""


@pytest.mark.parametrize("line", ["", "second.ticks == 30;", "second.ticks >= 30;"])
def test_an_argument_that_no_line_speaks_of_is_told(tmp_path: Path, line: str) -> None:
    planner = PLANNER.replace("second.end == end;", f"second.end == end; {line}")
    files = {"shared.nddl": SHARED, "planner.nddl": planner, "simulator.nddl": SIMULATOR, "mission.toml": JOB_MISSION}
    chosen = [one for one in steps_of(tmp_path, files, 0) if one.kind is StepKind.CHOSEN]
    if line:
        assert chosen == []
        return
    ((subject, place),) = [(one.subject, one.place) for one in chosen]
    assert isinstance(subject, PlannerChoice)
    assert (subject.reactor, subject.argument, subject.is_open) == ("planner", "Run.ticks", True)
    assert place is not None
    assert place.text == "contains(Dev.Run second);"
