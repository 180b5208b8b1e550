"""Goals that lead to what a violated property promises may come too late, or ask for too much."""

from pathlib import Path

import pytest

from tests.checker.checked import faults_of

pytestmark = pytest.mark.once

SHARED = """#include "TREX.nddl"
class Lock extends AgentTimeline {
  predicate Shut { }
  predicate Open { int ticks; }
  Lock(Mode m) { super(m, "Shut"); }
}
"""
PILOT = """#include "lock.nddl"
#include "Resources.nddl"
Reservoir water = new Reservoir(100.0, 0.0, 100.0);
class Work extends AgentTimeline {
  predicate Wait { }
  predicate Pass { int ticks; }
  predicate Look { }
  Work(Mode m) { super(m, "Wait"); }
}
Work::Pass {
  contains(Lock.Open open);
  open.ticks == ticks;
  open.end == end;
  any(water.consume use);
  use.time == open.start;
  use.quantity == ticks * 1.0;
}
Work::Look { duration == 5; }
Work work = new Work(Internal);
Work watch = new Work(Internal);
Lock lock = new Lock(External);
close();
"""
KEEPER = """#include "lock.nddl"
Lock::Open { duration == ticks; }
Lock lock = new Lock(Internal);
close();
"""
MISSION = """[mission]
name = "locks"
final_tick = 200
[[reactor]]
name = "pilot"
model = "pilot.nddl"
latency = 1
lookahead = 200
internal = ["work", "watch"]
external = ["lock"]
[[reactor]]
name = "keeper"
model = "keeper.nddl"
latency = 0
lookahead = 1
internal = ["lock"]
[[goal]]
timeline = "watch"
predicate = "Look"
start = [120, 180]
mandatory = true
[[goal]]
timeline = "work"
predicate = "Pass"
start = [90, 120]
mandatory = true
parameters = { ticks = 30 }
[[property]]
name = "promised"
%s
[check]
missions = 2
"""
REACHED = 'kind = "reached"\ntimeline = "lock"\npredicate = "Open"\nby = 100'
LATER = 'kind = "reached"\ntimeline = "lock"\npredicate = "Open"\nfrom = 150'
LEVEL = 'kind = "level"\nresource = "water"\nreactor = "pilot"\nlevel = [80, 100]'


def told(
    folder: Path, capsys: pytest.CaptureFixture[str], promise: str, change: tuple[str, str] = ("", "")
) -> list[tuple[str, str, str]]:
    """The lines of the mission file among the causes, each with the value that mends."""
    mission = (MISSION % promise).replace(*change)
    files = {"lock.nddl": SHARED, "pilot.nddl": PILOT, "keeper.nddl": KEEPER, "mission.toml": mission}
    (fault,) = faults_of(folder, capsys, files)
    assert fault["code"] == "P1"
    ranked = [one for one in fault["causes"]["ranked"] if one["file"] == "mission.toml"]
    return [(one["text"], one["change"]["new"], one["claim"]) for one in ranked]


def test_a_goal_that_comes_too_late_for_a_promise_is_named_and_no_other(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = told(tmp_path, capsys, REACHED)
    assert ("start = [90, 120]", "[0, 200]", "mends") in found
    assert "start = [120, 180]" not in [text for text, *_ in found]
    assert found[0][0] == "start = [90, 120]"  # the narrowest window of the mission, sooner than the promise


def test_a_promise_is_rather_wrong_than_a_window_as_wide_as_others(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = told(tmp_path, capsys, REACHED, ("start = [120, 180]", "start = [120, 130]"))
    assert found[0][0] == "by = 100"


def test_what_is_promised_from_a_tick_on_may_come_before(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert ("from = 150", "0", "mends") in told(tmp_path, capsys, LATER)


def test_what_a_goal_asks_for_that_empties_a_store_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert ("ticks = 30", "15", "mends") in told(tmp_path, capsys, LEVEL)
