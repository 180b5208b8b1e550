"""A mission whose model contradicts itself from the first is explained by the lines that do, and by what mends it."""

from pathlib import Path

import pytest

from tests.checker.checked import faults_of

MODEL = """#include "TREX.nddl"
class Mill extends AgentTimeline {
  predicate Still { }
  predicate Saw { int job; }
  Mill(Mode m) { super(m, "Still"); }
}
Mill mill = new Mill(Internal);
close();
goal(mill.Saw first);
goal(mill.Saw second);
first.duration == 3;
second.duration == 2;
first.start == 4;
first contained_by second;
"""
MISSION = """[mission]
name = "mill"
final_tick = 30
[[reactor]]
name = "planner"
model = "mill.nddl"
lookahead = 30
internal = ["mill"]
[check]
missions = 1
"""


def test_the_line_that_contradicts_others_before_the_mission_is_the_first_cause(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (fault,) = faults_of(tmp_path, capsys, {"mill.nddl": MODEL, "mission.toml": MISSION})
    assert fault["code"] == "F9"
    first = fault["causes"]["ranked"][0]
    assert (first["line"], first["claim"]) == (14, "mends")
    assert first["change"]["kind"] == "relation"
