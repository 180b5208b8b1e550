"""Levels of resources are judged at all times that were left open, not as if what they belong to had not happened."""

import pytest

from checker.judge.judge import judge_mission
from checker.judge.rendering import disagreement_text
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.record import MissionRecord
from tests.executive.flying import flown, planner

MODEL = """
Reservoir battery = new Reservoir(100.0, 20.0, 100.0);
class Work extends AgentTimeline {
  predicate Idle { } predicate Inspect { } predicate Load { } Work(Mode m) { super(m, "Idle"); }
}
Work::Inspect { duration == 5; any(Reservoir.consume use); start <= use.time; use.time <= end; use.quantity == 50.0; }
Work::Load { duration == 5; any(Reservoir.produce gain); gain.time == end; gain.quantity == 40.0; }
Work work = new Work(Internal); close();
"""
GOALS = (GoalConfiguration("work", "Inspect", start=(3, 3)), GoalConfiguration("work", "Load", start=(10, 10)))


@pytest.mark.parametrize(("gain", "found"), [(40.0, 0), (49.0, 0), (51.0, 1)])
def test_a_consumption_at_an_open_time_counts_when_it_must_be_over(gain: float, found: int) -> None:
    mission = flown(planner("planner", MODEL, "work"), until=30, goals=GOALS)
    assert mission.report.holds, [disagreement_text(one) for one in mission.report.disagreements]
    (reactor,) = mission.record.reactors
    tokens = tuple(
        one._replace(arguments=(gain,)) if one.predicate == "Reservoir.produce" else one for one in reactor.tokens
    )
    assert any(not isinstance(one.start, int) for one in tokens if one.predicate == "Reservoir.consume")
    record = MissionRecord((reactor._replace(tokens=tokens),))
    report = judge_mission(mission.agent, mission.programs, mission.outcome, record)
    assert sum(one.kind == "level" for one in report.disagreements) == found
