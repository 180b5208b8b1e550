"""A change after which a mission only keeps away from what fails is no mending."""

import json
from pathlib import Path
from typing import Any

import pytest

from nddlc.main import run

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
float A = [0.0 1.0];
float B = [0.0 1.0];
class W extends AgentTimeline {
  predicate Idle { }
  predicate Go { }
  W(Mode m) { super(m, "Idle"); }
}
W::Idle { duration == 5; meets(object.Go g); }
W::Go {
  float a; float b;
  a == sampledParameter(A);
  b == sampledParameter(B);
  bool p; bool q;
  p == (a > 0.5);
  q == (b > 0.5);
  p == q;
  duration == 5;
}
W w = new W(Internal);
close();
"""
MISSION = """[mission]
name = "either"
final_tick = 12
[[reactor]]
name = "sim"
model = "either.nddl"
latency = 0
lookahead = 1
internal = ["w"]
[check]
missions = 30
seed = 3
max_failure_rate = 0.01
"""


def test_a_postponement_is_no_mending(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "either.nddl").write_text(MODEL, encoding="utf-8")
    (tmp_path / "mission.toml").write_text(MISSION, encoding="utf-8")
    report = tmp_path / "report"
    assert run(["check", str(tmp_path / "mission.toml"), "--no-store", "--output", str(report)]) == 1
    capsys.readouterr()
    data: dict[str, Any] = json.loads((report / "report.json").read_text(encoding="utf-8"))
    (fault,) = data["faults"]
    claims = {one["line"]: one["claim"] for one in fault["causes"]["ranked"]}
    line = MODEL.splitlines().index("W::Idle { duration == 5; meets(object.Go g); }") + 1
    assert claims.get(line, "evades") == "evades"
    assert "mends" not in claims.values()  # no change of one bound suits both either
