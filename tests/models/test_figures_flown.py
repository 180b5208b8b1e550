"""Figures 13 and 14 of the founding paper, drawn from the stored trace of a mission alone (trex 4 rows 34 and 35)."""

import re
from dataclasses import replace
from pathlib import Path
from typing import Literal
from xml.etree import ElementTree

import numpy as np
import pytest

from checker.batch.result import MissionResult, read_record, write_record
from checker.batch.worker import Task, fly_one
from checker.figures import Figures
from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import pinned
from checker.report.paths import section_figure, space_figure
from checker.report.track import Track, track_of
from runtime.executive.events import events_on
from runtime.executive.outcome import EventKind, Outcome

pytestmark = pytest.mark.once

MODELS = Path(__file__).parents[2] / "models" / "auv"


def stored(name: str, seed: int, mode: Literal["inter", "intra"]) -> tuple[Outcome, Figures]:
    """A mission as a store has it: flown, written as text, and read again."""
    mission, _ = read_mission(MODELS / name)
    assert mission is not None and mission.figures is not None
    models = load_models(mission)
    agent = replace(models.agent, parameters=tuple(replace(each, mode=mode) for each in models.agent.parameters))
    text = write_record(fly_one(pinned(models)(agent), Task(1, seed), keep_trace=True))
    result = read_record(MissionResult, text)
    assert result.outcome is not None and result.outcome.abort is None
    return result.outcome, mission.figures


def drawn(outcome: Outcome, figures: Figures) -> Track:
    track = track_of(outcome, figures)
    assert track is not None
    return track


def test_an_emptied_bank_leaves_five_marks_on_a_coloured_path_in_space() -> None:
    outcome, figures = stored("inl/mission.toml", 1635799601, "intra")
    track = drawn(outcome, figures)
    left = [
        dict(event.arguments)["left"].interval
        for event in events_on(outcome.events, {"gulper"})
        if event.kind is EventKind.OBSERVATION
    ]
    assert left[-1] == (0.0, 0.0)  # ten samplers, two at a time
    assert len(track.samples) == 5
    for figure in (space_figure(track), section_figure(track, figures.cell)):
        assert re.findall(r">(S\d+)</text>", figure) == ["S1", "S2", "S3", "S4", "S5"]
    lines = ElementTree.fromstring(space_figure(track)).iter("polyline")
    kinds = {str(one.get("class")) for one in lines if "path" in str(one.get("class"))}
    assert kinds >= {"path p0", "path p5"}, "where the feature is held to be, the path has another colour"
    assert np.ptp(track.positions, axis=0).min() > 40.0, "it goes east, north and deep"


def test_a_front_is_tracked_in_phases_with_cells_of_five_metres_and_a_new_target() -> None:
    outcome, figures = stored("front/mission.toml", 1635799601, "inter")
    track = drawn(outcome, figures)
    assert {one.predicate for one in track.phases} >= {"Search", "Map"}
    assert all(one.end == two.start for one, two in zip(track.phases, track.phases[1:], strict=False))
    assert [what for _, what in track.targets] == ["Track asked", "Track recalled", "Track asked"]
    assert figures.cell == 5.0
    root = ElementTree.fromstring(section_figure(track, figures.cell))
    cells = [one for one in root.iter("rect") if "cell" in str(one.get("class")) and one.get("height") != "11"]
    rows = sorted({float(str(one.get("y"))) for one in cells})
    depth = float(track.positions[:, 2].max())
    assert len(rows) == int(np.ceil(depth / 5.0)), "cells of 5 m down to the deepest point"
    bands = [one for one in root.iter("rect") if "bar" in str(one.get("class"))]
    titles = [str(one.findtext("title")) for one in bands if one.find("title") is not None]
    assert titles == [f"{one.predicate}, {one.start} to {one.end}" for one in track.phases]
    labels = " ".join(str(one.text) for one in root.iter("text") if one.get("class") == "label")
    assert labels.count("Track asked") == 2 and "Track recalled" in labels
