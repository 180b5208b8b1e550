"""Trials are bounded by flights and processor time; the clock ends them only where a machine gives none of that."""

import time
from itertools import count
from pathlib import Path

import pytest

from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.effort import Bounds
from checker.counterfactual.missions import Missions
from checker.counterfactual.ranking import rank
from checker.counterfactual.rendering import effort_text
from checker.counterfactual.trials import try_out
from checker.counterfactual.tried import Trials, TrialsEnd
from checker.counterfactual.usage import usage_of
from checker.oracle import Verdict
from tests.checker.test_trials import result, sites

pytestmark = pytest.mark.once


def tried(folder: Path, bounds: Bounds, *, helps: bool = False) -> Trials:
    """What trials of one line tell that never help, or all do."""
    found = sites(folder)
    candidates = [Candidate(found["duration <= SPAN;"], 0.0, Suspicion.CONFLICT)]
    missions, passes = Missions([result(1, Verdict.FAIL)], []), result(1, Verdict.PASS)
    usage = usage_of(list(found.values()))
    return try_out(candidates, missions, usage, lambda edit, mission, most: passes if helps else mission, bounds)


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


def test_where_nothing_mends_there_are_further_flights(tmp_path: Path) -> None:
    few, more = (tried(tmp_path, Bounds(2, further=further)) for further in (0, 3))
    assert (few.flights, few.ended, more.flights, more.ended) == (2, TrialsEnd.FLIGHTS, 5, TrialsEnd.FLIGHTS)
    assert rank(more, tmp_path).is_all_of(2) and not rank(few, tmp_path).is_all_of(3)


def test_where_something_mends_there_are_none(tmp_path: Path) -> None:
    assert tried(tmp_path, Bounds(2, further=3), helps=True).flights <= 2
