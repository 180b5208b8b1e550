"""A goal that is not over when the mission is: where it might not begin sooner, the line that says so is named."""

from pathlib import Path

import pytest

from tests.checker.checked import faults_of

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
class Shield extends AgentTimeline {
  predicate Idle { }
  predicate Rest { int ticks; }
  Shield(Mode m) { super(m, "Idle"); }
}
Shield::Rest { duration == ticks; }
Shield shield = new Shield(Internal);
close();
"""
MISSION = """[mission]
name = "shield"
final_tick = 200
[[reactor]]
name = "desk"
model = "desk.nddl"
latency = 1
lookahead = 200
internal = ["shield"]
[[goal]]
timeline = "shield"
predicate = "Rest"
start = [150, 160]
mandatory = true
parameters = { ticks = 80 }
[check]
missions = 2
"""


@pytest.mark.parametrize("is_plain", [True, False])
def test_a_window_that_leaves_no_time_for_a_goal_is_named(
    is_plain: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = {"desk.nddl": MODEL, "mission.toml": MISSION}
    if is_plain:  # then lint tells of it, too
        files["desk.nddl"] = MODEL.replace("duration == ticks", "duration == 80").replace(" int ticks;", "")
        files["mission.toml"] = MISSION.replace("parameters = { ticks = 80 }\n", "")
    (fault,) = faults_of(tmp_path, capsys, files)
    assert fault["code"] == "F10"
    told = [(one["file"], one["text"], one["claim"]) for one in fault["causes"]["ranked"]]
    assert told[0] == ("mission.toml", "start = [150, 160]", "mends")
    assert bool(fault["causes"]["ranked"][0].get("lint")) is is_plain


def test_a_goal_that_had_time_enough_is_not_moved(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mission = MISSION.replace("start = [150, 160]", "start = [10, 160]").replace("ticks = 80", "ticks = 30")
    model = MODEL.replace("duration == ticks;", "duration == ticks; duration >= 190;")
    (fault,) = faults_of(tmp_path, capsys, {"desk.nddl": model, "mission.toml": mission})
    assert "start = [10, 160]" not in [one["text"] for one in fault["causes"]["ranked"]]
