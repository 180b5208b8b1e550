"""What the founding paper says of its parts, in the INL survey (rows 5, 7, 12, 15, 16 and 18 of the reference)."""

import os
from dataclasses import replace
from functools import cache
from pathlib import Path
from shutil import copytree
from statistics import median
from time import process_time
from typing import Any, Literal, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from checker.mission import read_mission
from checker.models import load_models
from nddlc.main import run
from runtime.executive.columns import TokenColumns
from runtime.executive.events import EventLog
from runtime.executive.mission import record_mission, run_mission
from runtime.executive.outcome import Event, EventKind, Outcome
from tests.models.test_models import MODELS, NOMINAL, fly
from tests.programs import programs_of

pytestmark = pytest.mark.once
Numbers = NDArray[Any]
MODES: tuple[Literal["inter", "intra"], ...] = ("inter", "intra")


@cache
def survey(**values: float) -> Outcome:
    """The nominal survey with some values in place of the nominal ones."""
    return fly("auv/inl/mission.toml", values=NOMINAL | values)


def numbers(event: Event) -> dict[str, float]:
    """The arguments that are numbers."""
    return {name: value.interval[0] for name, value in event.arguments if value.interval is not None}


def seen(outcome: Outcome, timeline: str, predicate: str) -> list[Event]:
    """What was observed on a timeline that has a hundred tokens or fewer."""
    assert isinstance(outcome.events, EventLog)
    found = [event for event in outcome.events.on({timeline}) if event.kind is EventKind.OBSERVATION]
    return [event for event in found if event.predicate == predicate]


class Steps(NamedTuple):
    """The simulator's step of each tick: what it was for, and where the vehicle was."""

    ticks: Numbers
    kinds: list[str]
    places: Numbers  # (n, 3), m


def steps_of(outcome: Outcome) -> Steps:
    """All steps as columns; one event for each of them would take longer than the flight."""
    assert isinstance(outcome.events, EventLog)
    (step,) = [one for _, one in outcome.events.published() if (one.timeline, one.predicate) == ("motion", "Step")]
    columns = dict(zip(step.parameters, step.arguments.columns(), strict=True))
    assert len(step.ticks) > outcome.last_tick - 10
    kinds = [step.symbols[int(number)] for number in columns["kind"].numbers]
    return Steps(step.ticks, kinds, np.stack([columns[name].numbers for name in "xyz"], axis=1))


def kind(event: Event) -> str:
    """Of a step or a command, what the vehicle does."""
    return str(dict(event.arguments)["kind"])


def test_a_survey_of_eight_lines_is_decomposed_with_flexible_ends() -> None:
    mission, _ = read_mission(MODELS / "auv/inl/mission.toml")
    assert mission is not None
    agent = load_models(mission).agent
    _, record = record_mission(agent, programs_of(agent), 1, NOMINAL, until=9)  # planned, and nothing of it begun
    planned = [one for one in record.reactors[0].tokens if one.state == "active" and one.fate == "end"]
    for predicate, count in (("Path.Transect", 8), ("Nav.Go", 8), ("Path.FixStop", 4), ("Survey.VolumeSurvey", 1)):
        tokens = [one for one in planned if one.predicate == predicate]
        assert len(tokens) == count, predicate
        ends = [[float(str(end)) for end in one.end] if isinstance(one.end, tuple) else [] for one in tokens]
        assert all(each and each[0] < each[-1] for each in ends), predicate


def test_eight_lines_are_flown_as_eight_legs_and_four_stops_for_a_fix() -> None:
    outcome = survey()
    assert len(seen(outcome, "path", "Transect")) == len(seen(outcome, "nav", "Go")) == 8
    assert len(seen(outcome, "path", "FixStop")) == 4
    assert sum("YoYo" in kind(event) for event in seen(outcome, "helm", "Run")) >= 8


def test_six_hours_are_simulated_without_search_in_two_minutes_of_a_core() -> None:
    mission, _ = read_mission(MODELS / "auv/inl/mission.toml")
    assert mission is not None
    agent = load_models(mission).agent
    ticks = 21_600 if "NDDLC_PROOFS" in os.environ else 2_160
    programs = programs_of(agent)
    began = process_time()
    outcome, record = record_mission(agent, programs, 1, NOMINAL, until=ticks)
    assert process_time() - began < 120 * ticks / 21_600
    assert outcome.last_tick == ticks and outcome.abort is None
    (vehicle,) = (one for one in record.reactors if one.reactor == "psim")
    assert isinstance(vehicle.tokens, TokenColumns)  # register code to the end: no plan database has taken over
    assert len(vehicle.tokens) > ticks


def test_without_the_simulator_the_rest_loads(tmp_path: Path) -> None:
    copytree(MODELS / "auv", tmp_path / "auv")
    for file in (tmp_path / "auv").rglob("psim.nddl"):
        file.unlink()
    rest = sorted((tmp_path / "auv").rglob("*.nddl"))
    assert len(rest) > 5
    assert all(run(["lint", str(file)]) == 0 for file in rest)


def test_a_larger_hit_rate_is_a_longer_time_at_the_surface_on_the_same_path() -> None:
    times, paths = [], []
    for rate in (0.1, 1.0, 2.5, 4.0):
        outcome = survey(GPS_HIT_RATE=rate)
        need = [numbers(event)["need"] for event in seen(outcome, "gps", "Active")]
        assert set(need) == {max(1.0, 10 * rate)}
        times.append(sum(need) / len(need))
        steps = steps_of(outcome)
        paths.append(steps.places[["YoYo" in kind for kind in steps.kinds]])
    assert times == sorted(times) and len(set(times)) == len(times)
    assert np.array_equal(paths[0], paths[-1])


@pytest.mark.parametrize("axis", "xy")
def test_the_error_of_navigation_shows_at_a_fix_alone(axis: str) -> None:
    rate = 0.3
    outcome = survey(**{f"ERROR_RATE_{axis.upper()}": rate})
    fixes = seen(outcome, "gps", "Fix")
    assert fixes
    for fix in fixes:
        assert numbers(fix)[f"j{axis}"] == pytest.approx(rate * numbers(fix)["since"], abs=1e-6)
    steps, calm = steps_of(outcome), steps_of(survey())
    until = int(np.searchsorted(steps.ticks, fixes[0].tick))
    assert np.array_equal(steps.ticks[:until], calm.ticks[:until])
    assert np.array_equal(steps.places[:until], calm.places[:until])
    jump = (steps.places[until] - steps.places[until - 1])["xy".index(axis)]
    assert jump == pytest.approx(rate * numbers(fixes[0])["since"], abs=1e-6)


@pytest.mark.parametrize("axis", "xy")
def test_an_uneven_current_pushes_an_open_loop_leg_by_noise_times_time(axis: str) -> None:
    noise = -0.4
    outcome = survey(**{f"D{axis.upper()}_NOISE": noise})
    steps = steps_of(outcome)
    drifts = ["Loiter" in kind for kind in steps.kinds] & (steps.ticks > outcome.last_tick - 500)  # nothing steers it
    ticks, places = steps.ticks[drifts], steps.places[drifts, "xy".index(axis)]
    assert len(ticks) == 500
    assert places - places[0] == pytest.approx(noise * (ticks - ticks[0]), abs=1e-6)


def path(outcome: Outcome) -> Numbers:
    """Where the vehicle was, each ten ticks, m."""
    steps = steps_of(outcome)
    return steps.places[steps.ticks % 10 == 0, :2]


@pytest.mark.slow
def test_noise_that_changes_within_a_mission_looks_like_the_standard_path() -> None:
    # Row 18, figure 8: the median over 20 seeds of the RMS distance to the standard path.
    mission, _ = read_mission(MODELS / "auv/inl/mission.toml")
    assert mission is not None
    agent = load_models(mission).agent
    programs = programs_of(agent)
    calm = {name: value for name, value in NOMINAL.items() if "NOISE" not in name}
    standard = path(run_mission(agent, programs, 1, NOMINAL, until=12_000))
    medians = []
    for mode in MODES:
        noise = [replace(one, mode=mode, update=10) if "NOISE" in one.name else one for one in agent.parameters]
        distances = []
        for seed in range(20):
            flown = path(run_mission(replace(agent, parameters=tuple(noise)), programs, seed, calm, until=12_000))[::5]
            squares = ((flown[:, None] - standard) ** 2).sum(axis=2).min(axis=1)
            distances.append(float(squares.mean()) ** 0.5)
        medians.append(median(distances))
    assert medians[1] < 0.1 * medians[0]
