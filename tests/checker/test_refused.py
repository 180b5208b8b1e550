"""What a planner below refused is explained by what made it refuse, not by who missed it."""

from pathlib import Path
from typing import Any

import pytest

from tests.checker.checked import faults_of

pytestmark = pytest.mark.once

SHARED = """#include "TREX.nddl"
class Arm extends AgentTimeline {
  predicate Rest { }
  predicate Reach { float far; }
  predicate Hold { int grips; }
  Arm(Mode m) { super(m, "Rest"); }
}
class Pick extends AgentTimeline {
  predicate None { }
  predicate Fetch { float far; int grips; }
  Pick(Mode m) { super(m, "None"); }
}
"""
CHIEF = """#include "shared.nddl"
int JOB_MAX = 120;
float FAR = 6.0;
class Job extends AgentTimeline {
  predicate Wait { }
  predicate Do { int grips; }
  Job(Mode m) { super(m, "Wait"); }
}
Job::Do {
  contains(Pick.Fetch fetch);
  fetch.far == FAR;
  fetch.grips == grips;
  fetch.end == end;
  duration <= JOB_MAX;
}
Job job = new Job(Internal);
Pick pick = new Pick(External);
close();
"""
HAND = """#include "shared.nddl"
int PAUSE = 15;
int REACH_MAX = 40;
int HOLD_MAX = 40;
Pick::Fetch {
  contains(Arm.Reach reach);
  contains(Arm.Hold hold);
  reach.far == far;
  hold.grips == grips;
  reach before hold;
  hold.start <= reach.end + PAUSE;
  reach.duration <= REACH_MAX;
  hold.duration <= HOLD_MAX;
  hold.end == end;
}
Pick pick = new Pick(Internal);
Arm arm = new Arm(External);
close();
"""
WORLD = """#include "shared.nddl"
float PACE = [0.3 0.5];
Arm::Reach {
  float pace;
  float time;
  pace == sampledParameter(PACE);
  mulEq(pace, time, far);
  duration == ceil(time);
}
Arm::Hold { duration == grips * 2; }
Arm arm = new Arm(Internal);
close();
"""
REACTOR = """[[reactor]]
name = "{0}"
model = "{0}.nddl"
latency = {1}
lookahead = {2}
internal = ["{3}"]
"""
MISSION = (
    '[mission]\nname = "fetch"\nfinal_tick = 300\n'
    + REACTOR.format("chief", 1, 200, "job")
    + 'external = ["pick"]\n'
    + REACTOR.format("hand", 1, 200, "pick")
    + 'external = ["arm"]\n'
    + REACTOR.format("world", 0, 1, "arm")
    + '[[goal]]\ntimeline = "job"\npredicate = "Do"\nmandatory = true\nstart = [5, 20]\n'
    + "[goal.parameters]\ngrips = 6\n[check]\nmissions = 6\n"
)


def faults(folder: Path, capsys: pytest.CaptureFixture[str], old: str = "", new: str = "") -> list[dict[str, Any]]:
    models = {"shared.nddl": SHARED, "chief.nddl": CHIEF, "hand.nddl": HAND, "world.nddl": WORLD}
    changed = {name: text.replace(old, new) if old else text for name, text in models.items()}
    return faults_of(folder, capsys, changed | {"mission.toml": MISSION})


def test_the_models_are_right_as_they_stand(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert faults(tmp_path, capsys) == []


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("reach.end + PAUSE", "reach.end - PAUSE"),
        ("reach before hold", "reach after hold"),
        ("PAUSE = 15", "PAUSE = -15"),
    ],
)
def test_the_line_is_first_that_made_the_owner_refuse(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], old: str, new: str
) -> None:
    (fault,) = faults(tmp_path, capsys, old, new)
    assert fault["code"] == "F6"
    assert fault["place"]["file"] == "hand.nddl"
    assert new in fault["causes"]["ranked"][0]["text"]
