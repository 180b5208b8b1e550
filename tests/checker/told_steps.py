"""A small mission in, the steps of the story of one of its failures out."""

from collections.abc import Mapping
from pathlib import Path

from checker.batch.result import MissionResult
from checker.batch.worker import fly_one
from checker.buckets import group_failures
from checker.campaign import Campaign
from checker.findings import Fault
from checker.mission import read_mission
from checker.models import load_models
from checker.oracle import Verdict
from checker.pinned import pinned
from checker.steps import Step

# A planner of jobs that a device of a simulator does.
JOB_MISSION = """
[mission]
name = "job"
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
"""


def failed_mission(folder: Path, number: int) -> tuple[Campaign, MissionResult]:
    """Fly mission `number` of the mission file in a folder, which must fail."""
    mission, found = read_mission(folder / "mission.toml")
    assert mission is not None, found
    models = load_models(mission)
    given = Campaign(mission, models, pinned(models))
    failed = fly_one(given.load(models.agent), given.task(number))
    assert failed.verdict is Verdict.FAIL
    return given, failed


def steps_of(folder: Path, files: Mapping[str, str], number: int) -> tuple[Step, ...]:
    """Write the files, mission.toml among them, and tell of mission `number`, which must fail."""
    for name, text in files.items():
        (folder / name).write_text(text)
    given, failed = failed_mission(folder, number)
    (bucket,) = group_failures((failed,))
    return given.story(failed, Fault(bucket, None, None)).steps
