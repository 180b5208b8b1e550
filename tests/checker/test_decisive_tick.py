"""A story ends where it was decided that the mission fails: what was drawn and seen later is no part of why."""

import json
from pathlib import Path

import pytest

from nddlc.main import run
from tests.checker.test_open_objects import COURIER, MISSION, SHARED

pytestmark = pytest.mark.once

WORLD = """#include "shared.nddl"
float FLIGHT = [110.0 170.0];
Rotor::Flying {
    float seconds;
    seconds == sampledParameter(FLIGHT);
    duration == ceil(seconds);
}
Rotor rotor = new Rotor(Internal);
close();
"""
LATER = """[[goal]]
timeline = "courier"
predicate = "Deliver"
start = [200, 210]
[goal.parameters]
to = "island"
[parameters.FLIGHT]
mode = "intra"
update = 20
[check]
missions = 1
"""


def test_the_draw_that_was_in_force_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = {"shared.nddl": SHARED, "courier.nddl": COURIER, "world.nddl": WORLD, "mission.toml": MISSION + LATER}
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    store = ["--store", str(tmp_path / "runs.sqlite")]
    assert run(["check", str(tmp_path / "mission.toml"), "--output", str(tmp_path / "report"), *store]) == 1
    capsys.readouterr()
    run(["explain", "latest#1", "--format", "json", *store])
    told = json.loads(capsys.readouterr().out)
    rejected = next(step["tick"] for step in told["steps"] if "reject" in step["reason"])
    drawn = [step["tick"] for step in told["steps"] if step["kind"] == "draw"]
    assert told["last_tick"] > 3 * rejected
    assert drawn == [0]  # not that of the later flight
    assert all(step["tick"] <= rejected for step in told["steps"] if step["kind"] == "event")
    nodes = {node["id"]: node for node in told["graph"]["nodes"]}
    linked = [(nodes[cause], nodes[effect]) for cause, effect in told["graph"]["edges"]]
    sampled = {cause["tick"] for cause, effect in linked if (cause["kind"], effect["kind"]) == ("sample", "constraint")}
    assert sampled == {1}  # when the first flight began
