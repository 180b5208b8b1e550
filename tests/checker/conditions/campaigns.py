"""Small missions whose condition of failing is known, as campaigns that are flown in this process."""

from dataclasses import replace
from pathlib import Path

from checker.batch.result import MissionResult
from checker.batch.worker import Task, fly_one
from checker.buckets import group_failures
from checker.campaign import Campaign
from checker.conditions.condition import Condition
from checker.conditions.find import find_condition
from checker.conditions.flights import Refly
from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import pinned
from runtime.executive.configuration import AgentConfiguration

MODEL = """#include "TREX.nddl"
{ranges}
class Pump extends AgentTimeline {{
    predicate Wait {{ }}
    predicate Stroke {{ }}
    Pump(Mode m) {{ super(m, "Wait"); }}
}}
Pump::Wait {{ duration == 4; meets(object.Stroke stroke); }}
Pump::Stroke {{
    float p; float q; float r;
    p == sampledParameter(P);
    q == sampledParameter(Q);
    r == sampledParameter(R);
    {rule}
    duration == 4;
}}
Pump pump = new Pump(Internal);
close();
"""
MISSION = """
[mission]
name = "pump"
final_tick = {final_tick}
[[reactor]]
name = "sim"
model = "pump.nddl"
latency = 0
lookahead = 1
internal = ["pump"]
{more}
[check]
missions = {missions}
seed = 11
"""
RANGES = "float P = [0.0 1.0]; float Q = [0.0 1.0]; float R = [0.0 1.0];"


def campaign(
    folder: Path, rule: str, *, ranges: str = RANGES, more: str = "", missions: int = 150, final_tick: int = 10
) -> Campaign:
    """A pump whose stroke is under `rule`, of the draws p, q and r."""
    (folder / "pump.nddl").write_text(MODEL.format(ranges=ranges, rule=rule))
    file = folder / "mission.toml"
    file.write_text(MISSION.format(more=more, missions=missions, final_tick=final_tick))
    mission, found = read_mission(file)
    assert mission is not None, found
    models = load_models(mission)
    assert not models.has_errors, models.diagnostics
    return Campaign(replace(mission), models, pinned(models))


def flown(given: Campaign) -> tuple[MissionResult, ...]:
    """All missions of a campaign."""
    fly = given.load(given.models.agent)
    return tuple(fly_one(fly, given.task(number)) for number in range(1, given.mission.check.missions + 1))


def reflying(given: Campaign) -> Refly:
    """Flights in this process."""

    def refly(agent: AgentConfiguration, number: int, seed: int) -> MissionResult:
        return given.judged(fly_one(given.load(agent), Task(number, seed)))

    return refly


def conditions(given: Campaign, *, may_fly: bool = True) -> list[Condition | None]:
    """The condition of each bucket."""
    results = flown(given)
    refly = reflying(given) if may_fly else None
    agent, seed = given.models.agent, given.mission.check.seed
    return [find_condition(bucket, results, agent, seed, refly) for bucket in group_failures(results)]
