"""Trials are bounded by flights and processor time; the clock ends them only where a machine gives none of that."""

import time
from itertools import count
from pathlib import Path

import pytest

from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.effort import Bounds
from checker.counterfactual.ranking import rank
from checker.counterfactual.rendering import effort_text
from checker.counterfactual.trials import Missions, Trials, TrialsEnd, try_out
from checker.counterfactual.usage import usage_of
from checker.oracle import Verdict
from tests.checker.test_trials import result, sites

pytestmark = pytest.mark.once


def tried(folder: Path, bounds: Bounds) -> Trials:
    """What trials of one line tell that never help."""
    found = sites(folder)
    candidates = [Candidate(found["duration <= SPAN;"], 0.0, Suspicion.CONFLICT)]
    missions = Missions([result(1, Verdict.FAIL)], [])
    usage = usage_of(list(found.values()))
    return try_out(candidates, missions, usage, lambda edit, mission, most: mission, bounds)


def test_a_busy_machine_ends_no_trials(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    hours = count(0.0, 20.0)
    monkeypatch.setattr(time, "monotonic", lambda: next(hours))
    quiet = tried(tmp_path, Bounds(seconds=1e6, spent=lambda: 0.0))
    assert quiet.ended is TrialsEnd.COMPLETE


def test_processor_time_ends_trials_whatever_the_clock_says(tmp_path: Path) -> None:
    seconds = count(0.0, 0.5)
    found = tried(tmp_path, Bounds(seconds=3.0, spent=lambda: next(seconds)))
    assert found.ended is TrialsEnd.SECONDS
    assert 0 < found.flights < 6


def test_a_machine_without_time_ends_trials_and_this_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    hours = count(0.0, 60.0)
    monkeypatch.setattr(time, "monotonic", lambda: next(hours))
    found = tried(tmp_path, Bounds(seconds=30.0, spent=lambda: 0.0))
    assert found.ended is TrialsEnd.CLOCK
    assert effort_text(rank(found, tmp_path)).endswith("then the machine had no time for more")
