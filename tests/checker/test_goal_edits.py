"""What a mission file asks of a goal may be the mistake: its times are tried wider, and left out."""

from pathlib import Path

import pytest

from checker.mission import Mission, read_mission
from checker.mutation.edits import EditKind, edited
from checker.mutation.goal_edits import goal_sites, goals_with
from tests.checker.checked import faults_of
from tests.checker.test_open_objects import COURIER, MISSION, SHARED, WORLD

FILES = {"shared.nddl": SHARED, "courier.nddl": COURIER, "world.nddl": WORLD}


def read(folder: Path, text: str) -> Mission:
    for name, model in FILES.items():
        (folder / name).write_text(model, encoding="utf-8")
    (folder / "mission.toml").write_text(text, encoding="utf-8")
    mission, _ = read_mission(folder / "mission.toml")
    assert mission is not None
    return mission


def test_bounds_are_tried_wider_only(tmp_path: Path) -> None:
    mission = read(tmp_path, MISSION)
    (site,) = goal_sites(mission)
    assert site.text == "start = [5, 100]"
    assert MISSION.splitlines()[site.first - 1] == site.text
    for edit in site.edits:
        (goal, _) = goals_with(mission, edit) or ()
        if edit.kind is EditKind.DROPPED_CONSTRAINT:
            assert goal.start is None
        else:
            assert goal.start is not None
            assert goal.start[0] <= 5 and goal.start[1] >= 100 and goal.start != (5, 100)
    assert {edit.old for edit in site.edits} == {"5", "100", "start = [5, 100]"}


@pytest.mark.parametrize("written", ["end = 60", "end = [-inf, 60]", "end = [60.0, inf]"])
def test_each_edit_leaves_a_mission(tmp_path: Path, written: str) -> None:
    mission = read(tmp_path, MISSION.replace("start = [5, 100]", written))
    (site,) = goal_sites(mission)
    changed = [edited(mission.source.text, edit) for edit in site.edits]
    assert len(set(changed)) == len(changed) > 2
    assert all(goals_with(mission, edit) is not None for edit in site.edits)


def test_a_deadline_that_is_too_tight_is_among_the_causes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (fault,) = faults_of(tmp_path, capsys, FILES | {"mission.toml": f"{MISSION}[check]\nmissions = 1\n"})
    causes = fault["causes"]["ranked"][:3]
    asked = [(one["text"], one["claim"]) for one in causes if one["file"] == "mission.toml"]
    assert asked == [("start = [5, 100]", "mends")]
