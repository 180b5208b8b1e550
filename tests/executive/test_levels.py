"""Levels of reservoirs in executed time: what was taken stays taken, whatever a repair forgets."""

from pathlib import Path

from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import pinned
from runtime.executive.outcome import EventKind, RepairStage

HERE = Path(__file__).parent / "levels"


def test_a_repair_that_forgets_the_past_keeps_what_was_consumed() -> None:
    """70 units less 40 less 24 are below the limit of 10: the second visit is not flown on with 46 units left.

    It is judged, too: a level out of bounds in what was executed is an error of the tool.
    """
    mission, found = read_mission(HERE / "mission.toml")
    assert mission is not None, found
    models = load_models(mission)
    outcome = pinned(models)(models.agent)(1406981920)
    repairs = [event.stage for event in outcome.events if event.kind is EventKind.RELAX and event.reactor == "pilot"]
    assert RepairStage.FORGET_PAST in repairs
    assert outcome.abort is not None and (outcome.abort.code, outcome.abort.tick) == ("F4", 817)
