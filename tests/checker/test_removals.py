"""A change that takes the check away which failed is no repair; behind Python, what it had read is tried."""

import json
from pathlib import Path
from typing import Any

import pytest

from checker.counterfactual.bounds import side_of
from nddlc.main import run

SHARED = """#include "TREX.nddl"
class Craft extends AgentTimeline {
    predicate Rest { }
    predicate At { int z; }
    Craft(Mode m) { super(m, "Rest"); }
}
class Level extends AgentTimeline {
    predicate None { }
    predicate Full { int bin; int x; }
    Level(Mode m) { super(m, "None"); }
}
"""
WORLD = """#include "shared.nddl"
int STEP = 5;
Craft craft = new Craft(Internal);
close();
Craft::Rest { duration == 1; meets(object.At next); next.z == 0; }
Craft::At {
    int now;
    duration == 4;
    now == z - STEP;
    meets(object.At next);
    next.z == now;
}
"""
WATCH = """#include "shared.nddl"
int MOST = 39;
Level level = new Level(External);
close();
Level::Full {
    0 <= bin;
    bin <= MOST;
    duration >= 1;
}
"""
GAUGE = """from runtime.user.reactor import Now, Reactor


class Gauge(Reactor):
    def tick(self, now: Now) -> None:
        seen = now.seen["craft"]
        if "z" in seen.arguments and seen.arguments["z"] != 0:
            now.publish("level", "Full", bin=int(seen.arguments["z"]) // 5, x=3)
"""
MISSION = """
[mission]
name = "gauge"
final_tick = 40
[[reactor]]
name = "watch"
model = "watch.nddl"
external = ["level"]
lookahead = 20
[[reactor]]
name = "world"
model = "world.nddl"
internal = ["craft"]
latency = 0
lookahead = 1
[[reactor]]
name = "gauge"
code = "gauge.py:Gauge"
internal = ["level"]
external = ["craft"]
"""


@pytest.fixture
def causes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> list[dict[str, Any]]:
    """All that is told of a vehicle that sinks the wrong way, as what Python makes of it is out of its limits."""
    monkeypatch.chdir(tmp_path)
    files = {"shared.nddl": SHARED, "world.nddl": WORLD, "watch.nddl": WATCH, "gauge.py": GAUGE}
    for name, text in (files | {"mission.toml": MISSION}).items():
        (tmp_path / name).write_text(text)
    assert run(["check", "mission.toml", "--missions", "2"]) == 1
    capsys.readouterr()
    assert run(["explain", "--format", "json"]) == 0
    ranked: list[dict[str, Any]] = json.loads(capsys.readouterr().out)["causes"]["ranked"]
    return ranked


def test_a_line_behind_python_comes_before_changes_that_take_the_check_away(causes: list[dict[str, Any]]) -> None:
    first, *others = causes
    assert (first["file"], first["text"], first["claim"]) == ("world.nddl", "now == z - STEP;", "mends")
    check = [one for one in others if one["text"] == "0 <= bin;"]
    assert [one["claim"] for one in check] in ([], ["loosens"])


@pytest.mark.parametrize(
    ("line", "side"),
    [
        ("0 <= bin;", -1),
        ("bin <= 39;", 1),
        ("bin >= 0;", -1),
        ("LIMIT > bin;", 1),
        ("bin == 3;", 0),
        ("bin <= bin;", 0),
        ("bin + 1 <= 3;", 0),
    ],
)
def test_which_side_of_a_variable_a_line_bounds(line: str, side: int) -> None:
    assert side_of(line, "bin") == side
