"""Figures of a vehicle's way: what is read from a trace, and what is drawn of it."""

import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from checker.figures import Figures
from checker.mission import parse_mission
from checker.models import load_models
from checker.report.paths import DrawnPath, plan_figure, section_figure, space_figure
from checker.report.track import Track, track_of
from compiler.program import DomainConstant
from nddl_lang.text.source import Source
from runtime.executive.messages import Arguments
from runtime.executive.outcome import Event, EventKind, Outcome, Phase

FIGURES = Figures("motion", ("x", "y", "z"), "job", "feature", "p", "gulper", "Firing", "phase", "front")
FIRED = (300, 500, 700, 900, 1100)


def numbers(**values: float) -> Arguments:
    return tuple((name, DomainConstant("float", "float", (value, value), None)) for name, value in values.items())


def seen(tick: int, timeline: str, predicate: str, **values: float) -> Event:
    return Event(tick, Phase.SYNCHRONISE, EventKind.OBSERVATION, "r", timeline, predicate, numbers(**values))


def asked(tick: int, kind: EventKind) -> Event:
    return Event(tick, Phase.DISPATCH, kind, "shore", "front", "Track")


def outcome(fired: tuple[int, ...] = FIRED) -> Outcome:
    """A yo-yo between 0 and 30 m, eastwards at 1 m a tick until 1200, then adrift; the feature lies from 400 to 800."""
    events = [seen(0, "job", "Idle"), seen(10, "job", "Run"), seen(1200, "job", "Idle")]
    events += [seen(0, "feature", "Outside"), seen(400, "feature", "Inside", p=0.92), seen(800, "feature", "Outside")]
    events += [seen(0, "gulper", "Ready", left=10.0)]
    for at, tick in enumerate(fired):
        events += [seen(tick, "gulper", "Firing"), seen(tick + 8, "gulper", "Ready", left=8.0 - 2.0 * at)]
    events += [seen(0, "phase", "Search"), seen(600, "phase", "Map"), seen(900, "phase", "Search")]
    events += [asked(0, EventKind.REQUEST), asked(700, EventKind.RECALL), asked(700, EventKind.REQUEST)]
    for tick in range(2000):
        depth = abs((tick % 60) - 30)
        events.append(seen(tick, "motion", "Step", x=float(tick), y=5.0 * (tick > 600), z=float(depth)))
    events.sort(key=lambda one: one.tick)
    return Outcome(1, 2000, 2000, None, (), tuple(events), ())


@pytest.fixture(scope="module")
def track() -> Track:
    found = track_of(outcome(), FIGURES)
    assert found is not None
    return found


def classes(figure: str, tag: str) -> list[str]:
    return [str(one.get("class")) for one in ElementTree.fromstring(figure).iter(tag)]


def test_a_track_is_what_was_held_while_the_job_ran(track: Track) -> None:
    assert (track.ticks[0], track.ticks[-1]) == (10, 1200)
    assert list(track.positions[30]) == [40.0, 0.0, 10.0]
    assert {round(float(one), 2) for one in track.probabilities} == {0.0, 0.92}
    inside = track.ticks[track.probabilities > 0.5]
    assert (inside[0], inside[-1]) == (400, 799)
    assert track.samples == FIRED
    assert [(one.start, one.end, one.predicate) for one in track.phases] == [
        (0, 600, "Search"), (600, 900, "Map"), (900, 1200, "Search"),
    ]  # fmt: skip
    assert track.targets == ((0, "Track asked"), (700, "Track recalled"), (700, "Track asked"))


def test_without_a_position_there_is_no_track() -> None:
    assert track_of(outcome(), Figures("nowhere", ("x", "y", "z"))) is None
    assert track_of(outcome(), Figures("motion", ("x", "y", "w"))) is None


@pytest.mark.parametrize("fired", [FIRED, FIRED[:2], ()])
def test_each_pair_of_samplers_has_its_mark(fired: tuple[int, ...]) -> None:
    """An emptied bank of ten, fired two at a time, has exactly five (trex 4 row 34)."""
    found = track_of(outcome(fired), FIGURES)
    assert found is not None
    for figure in (space_figure(found), section_figure(found, 5.0)):
        assert classes(figure, "circle").count("sample") == len(fired)
        assert re.findall(r">(S\d)</text>", figure) == [f"S{at}" for at in range(1, len(fired) + 1)]


def test_the_path_in_space_is_coloured_by_probability(track: Track) -> None:
    kinds = classes(space_figure(track), "polyline")
    assert kinds == ["path p0", "path p5", "path p0"]


def test_the_section_has_cells_bands_and_targets(track: Track) -> None:
    """Cells of 5 m, phase bands below the depth, and what shore asked for anew (trex 4 row 35)."""
    root = ElementTree.fromstring(section_figure(track, 5.0))
    cells = [one for one in root.iter("rect") if "cell" in str(one.get("class")) and one.get("height") != "11"]
    heights = {one.get("height") for one in cells}
    rows = sorted({float(str(one.get("y"))) for one in cells})
    assert len(heights) == 1
    assert len(rows) == 6  # 30 m in cells of 5 m
    assert np.allclose(np.diff(rows), float(str(heights.pop())), atol=0.1)
    bands = [one for one in root.iter("rect") if "bar" in str(one.get("class"))]
    floor = max(rows) + 5.0
    assert all(float(str(one.get("y"))) > floor for one in bands)
    assert [str(one.find("title").text) for one in bands if one.find("title") is not None] == [  # type: ignore[union-attr]
        "Search, 0 to 600", "Map, 600 to 900", "Search, 900 to 1200",
    ]  # fmt: skip
    labels = [str(one.text) for one in root.iter("text") if one.get("class") == "label"]
    assert "Track asked at 0" in labels
    assert "Track recalled, Track asked at 700" in labels


def test_a_vehicle_that_a_mistake_sends_far_away_is_drawn() -> None:
    """A depth of 4e15 m asked for 608 PiB, and the whole report was lost."""
    near, far = outcome(), 4.2e15
    runs = [seen(2000 + n, "motion", "Step", x=10.0**n, y=-(10.0**n), z=far * n) for n in range(300)]
    runs += [seen(1100 + tick, "motion", "Step", x=1100.0 + tick, y=0.0, z=10.0**tick) for tick in range(9)]
    events = tuple(sorted((*near.events, *runs), key=lambda one: one.tick))
    track = track_of(replace(near, events=events, last_tick=2300), replace(FIGURES, during=""))
    assert track is not None
    assert 1e7 < track.positions.max() < 1e9
    for figure in (section_figure(track, 5.0), space_figure(track), plan_figure((DrawnPath(track, "", "passed"),))):
        assert ElementTree.fromstring(figure) is not None
        assert not re.search("nan|inf", figure)
        assert len(figure) < 200_000


def test_a_map_has_one_scale_in_both_directions(track: Track) -> None:
    figure = plan_figure((DrawnPath(track, "mission 1 passes", "passed"), DrawnPath(track, "standard", "standard")))
    assert classes(figure, "polyline") == ["path passed", "path standard"]
    line = str(next(ElementTree.fromstring(figure).iter("polyline")).get("points"))
    points = np.array([[float(one) for one in pair.split(",")] for pair in line.split()])
    wide, tall = np.ptp(points, axis=0)
    assert wide / tall == pytest.approx(np.ptp(track.positions[:, 0]) / np.ptp(track.positions[:, 1]), rel=0.05)
    assert len(line) < 20_000


INL = Path("models/auv/inl/mission.toml")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('path = "motion"', 'path = "moton"', "no reactor owns the timeline `moton`"),
        ('path = "motion"', 'path = "motion"\nposition = ["x", "y", "depth"]', "`motion` has no parameter `depth`"),
        ('path = "motion"', 'path = "motion"\nposition = ["x", "y"]', "`position` must be three arguments"),
        ('"feature.p"', '"feature.q"', "`feature` has no parameter `q`"),
        ('"feature.p"', '"feature"', "`feature` must be a timeline and its argument"),
        ('"gulper.Firing"', '"gulper.Fired"', "`gulper` has no predicate `Fired`"),
        ('targets = "survey"', 'target = "survey"', "no key `target` in"),
    ],
)
def test_a_mistake_in_a_figure_is_named(old: str, new: str, message: str) -> None:
    text = INL.read_text(encoding="utf-8")
    assert text.count(old) == 1
    mission, found = parse_mission(Source(str(INL), text.replace(old, new)), INL.parent)
    if mission is not None:
        found = (*found, *load_models(mission).diagnostics)
    assert any(message in one.message for one in found), [one.message for one in found]
