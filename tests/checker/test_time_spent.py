"""What is too late by the clock: the mistake is the likelier in what took most of the time, however long ago."""

from pathlib import Path

import pytest

from checker.counterfactual.time_spent import time_spent
from runtime.executive.outcome import Outcome
from tests.checker.checked import faults_of
from tests.checker.fault_study import faults_in, laid_out
from tests.checker.told_steps import failed_mission

pytestmark = pytest.mark.once

FAB = Path(__file__).parent / "unseen" / "fab"
VENTING, QUEUE_MAX = 3, 6  # 120 for 12; 160 for 300


def flown(number: int, folder: Path) -> Outcome:
    place = laid_out(FAB, list(faults_in(FAB))[number], folder / "fab")
    _, result = failed_mission(place, 1)
    assert result.outcome is not None
    return result.outcome


def test_what_is_done_before_a_deadline_has_its_share_of_the_time(tmp_path: Path) -> None:
    outcome = flown(VENTING, tmp_path)
    shares = time_spent(outcome)
    assert max(shares.keys() - {"Wafer"}, key=shares.__getitem__) == "Vent"
    assert shares["Vent"] == pytest.approx(360 / outcome.last_tick)  # three wafers
    assert "Vacuum" not in shares  # nobody asked for it


def test_a_limit_on_a_duration_asks_nothing_of_what_was_before(tmp_path: Path) -> None:
    outcome = flown(QUEUE_MAX, tmp_path)
    assert outcome.abort is not None
    assert time_spent(outcome) == {}


def test_the_line_that_made_a_deadline_late_hours_ago_is_the_first_cause(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fault = list(faults_in(FAB))[VENTING]
    files = {path.name: path.read_text() for path in FAB.glob("*.*") if path.name != "hand.toml"} | fault.texts
    files["mission.toml"] = files["mission.toml"].replace("missions = 30", "missions = 3")
    (found,) = faults_of(tmp_path, capsys, files)
    assert found["causes"]["ranked"][0]["text"] == "int VENTING = 120;"
