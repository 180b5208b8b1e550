"""A line that ties quantities which all others leave apart is odd, and a change that makes one is unlikely."""

from pathlib import Path

import pytest

from checker.counterfactual.smallness import cost_of
from checker.counterfactual.usage import Usage, usage_of
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.variant import load_graph

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
float SPEED = [1.0 2.0];
float HEIGHT = 25.0;
float TROLLEY = 2.0;
float PER_TON = 0.5;
int HANG_MAX = 5;
int MOVE_MAX = 90;
class Hoist extends AgentTimeline {
  predicate Lift { float mass; }
  predicate Lower { float mass; }
  predicate Go { float metres; float mass; }
  Hoist(Mode m) { super(m, "undefined"); }
}
Hoist::Lift {
  float speed;
  float time;
  speed == sampledParameter(SPEED);
  mulEq(speed, time, HEIGHT);
  duration == ceil(time + mass * PER_TON);
}
Hoist::Lower {
  float speed;
  float time;
  speed == sampledParameter(SPEED);
  mulEq(speed, time, HEIGHT);
  duration == ceil(time + LOAD * PER_TON);
}
Hoist::Go {
  float time;
  mulEq(TROLLEY, time, metres);
  duration == ceil(time * (1.0 - 0.1 * mass));
  contains(object.Lift up);
  up.mass == mass;
  up.start <= start + HANG_MAX;
  duration <= MOVE_MAX;
  addEq(up.duration, HANG_MAX, MOVE_MAX);
}
"""


def sites_with(folder: Path, load: str) -> list[EditSite]:
    path = folder / "m.nddl"
    path.write_text(MODEL.replace("LOAD", load))
    return sites_of(load_graph(path, ()))


@pytest.fixture
def sites(tmp_path: Path) -> list[EditSite]:
    return sites_with(tmp_path, "mass")


def change(sites: list[EditSite], text: str, old: str, new: str) -> tuple[SmallEdit, EditSite]:
    kinds = (EditKind.NAME, EditKind.LIMIT)
    site = next(one for one in sites if one.text == text)
    return next((edit, site) for edit in site.edits if edit.kind in kinds and (edit.old, edit.new) == (old, new))


@pytest.mark.parametrize(
    ("text", "old", "new", "gain"),
    [
        ("mulEq(speed, time, HEIGHT);", "HEIGHT", "TROLLEY", -1),
        ("mulEq(speed, time, HEIGHT);", "HEIGHT", "PER_TON", -1),
        ("duration <= MOVE_MAX;", "MOVE_MAX", "HANG_MAX", 0),
        ("duration <= MOVE_MAX;", "MOVE_MAX", "HEIGHT", -1),
        ("up.start <= start + HANG_MAX;", "HANG_MAX", "MOVE_MAX", 0),
        ("up.mass == mass;", "mass", "metres", -1),
    ],
)
def test_quantities_that_other_lines_leave_apart_are_hardly_meant_for_each_other(
    sites: list[EditSite], text: str, old: str, new: str, gain: int
) -> None:
    assert usage_of(sites).dimensions.gain(*change(sites, text, old, new)) == gain


def test_a_line_that_the_others_imply_is_likely_meant(tmp_path: Path) -> None:
    sites = sites_with(tmp_path, "time")
    usage = usage_of(sites)
    right = change(sites, "duration == ceil(time + time * PER_TON);", "time", "mass")
    assert usage.dimensions.gain(*right) == 1
    others = [edit for edit in right[1].edits if edit.kind is EditKind.LIMIT]
    assert others and all(usage.measure(edit, right[1]) < usage.measure(*right) for edit in others)


def test_a_height_gives_way_to_a_speed_later_than_to_another_height(sites: list[EditSite]) -> None:
    usage: Usage = usage_of(sites)
    absurd = change(sites, "mulEq(speed, time, HEIGHT);", "HEIGHT", "TROLLEY")
    assert usage.measure(*absurd) < 0.0
    assert cost_of(*absurd, usage) > cost_of(*change(sites, "duration <= MOVE_MAX;", "MOVE_MAX", "HANG_MAX"), usage)
