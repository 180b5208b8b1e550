"""A search that found nothing is explained by a line of a rule whose token was never flown."""

from pathlib import Path

import pytest

from tests.checker.checked import faults_of

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
int SWEEP_MAX = 90;
int WARM_MAX = 30;
int BEAM = 12;
int SLACK = 10;
class Lidar extends AgentTimeline {
  predicate Off { }
  predicate Warm { }
  predicate Beam { int turns; }
  Lidar(Mode m) { super(m, "Off"); }
}
class Sweep extends AgentTimeline {
  predicate Wait { }
  predicate Over { int turns; }
  Sweep(Mode m) { super(m, "Wait"); }
}
Sweep::Over {
  contains(Lidar.Beam beam);
  beam.turns == turns;
  beam.end == end;
  duration <= SWEEP_MAX;
}
Lidar::Beam {
  met_by(object.Warm warm);
  warm.duration <= WARM_MAX;
  warm.duration >= 10;
  duration == BEAM * turns;
}
Sweep sweep = new Sweep(Internal);
Lidar lidar = new Lidar(Internal);
close();
"""
MISSION = """[mission]
name = "sweep"
final_tick = 200
[[reactor]]
name = "planner"
model = "sweep.nddl"
latency = 0
lookahead = 200
internal = ["sweep", "lidar"]
[[goal]]
timeline = "sweep"
predicate = "Over"
mandatory = true
start = [5, 40]
[goal.parameters]
turns = 3
[check]
missions = 4
"""


def test_the_model_is_right_as_it_stands(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert faults_of(tmp_path, capsys, {"sweep.nddl": MODEL, "mission.toml": MISSION}) == []


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("met_by(object.Warm warm)", "starts(object.Warm warm)"),
        ("warm.duration >= 10", "warm.duration >= 100"),
        ("warm.duration <= WARM_MAX", "warm.duration > WARM_MAX * 9"),
    ],
)
def test_the_line_of_a_token_that_was_never_flown_is_first(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], old: str, new: str
) -> None:
    (fault,) = faults_of(tmp_path, capsys, {"sweep.nddl": MODEL.replace(old, new), "mission.toml": MISSION})
    assert fault["code"] == "F10"
    assert new in fault["causes"]["ranked"][0]["text"]
