"""Mutants of missions fly alike compiled and interpreted, determined or not, and the judge agrees."""

import random
import time

import pytest

from checker.counterfactual.search import sites_in
from checker.mission import read_mission
from checker.mutation.kinds import OUTSIDE, REPAIRS, EditKind
from runtime.user.limit import WATCH
from tests.executive.mutants.campaign import Campaign, departures
from tests.executive.mutants.flights import FILES, SlowError, at_most, edit_of

COUNT = 24
MISSIONS = 2


@pytest.mark.once
@pytest.mark.slow
@pytest.mark.parametrize(("only", "count", "kinds"), [("", COUNT, 3), ("models/auv", 1, 1)])
def test_mutants_fly_alike_in_both_forms(only: str, count: int, kinds: int) -> None:
    campaign = Campaign(seconds=20, whole=40, until=400, only=only, general=1)
    tally = campaign.tried(0, count, MISSIONS, both=True)
    assert tally.wrong == []
    assert "ended" in tally.codes
    assert len(tally.codes) >= kinds  # some mutants fail, and not all of them in one way
    sums = {kind: sum(n for (_, each), n in tally.counts.items() if each == kind) for _, kind in tally.counts}
    assert sums["mutants"] >= 0.9 * count
    assert sums["in both forms"] >= 0.9 * sums["flights"]


def test_only_what_takes_long_is_slow() -> None:
    with pytest.raises(SlowError), at_most(0.05):
        busy(1.0)
    with at_most(30.0):
        WATCH.start()
        time.sleep(2.5 * WATCH.step)


def busy(seconds: float) -> None:
    """Take so much of the processor's time."""
    end = time.process_time() + seconds
    while time.process_time() < end:
        pass


def test_departures_are_found() -> None:
    one, other = "3 repair constant 0 F1 5 ab", "3 repair constant 0 F1 5 cd"
    assert departures([one], [one]) == []
    assert len(departures([one], [other])) == 1


@pytest.mark.once
def test_a_fault_of_every_kind_is_drawn() -> None:
    chance = random.Random(1)
    drawn = set()
    for file in FILES:
        mission, _ = read_mission(file)
        assert mission is not None
        sites = sites_in(mission.agent)
        drawn |= {edit.kind for _ in range(20) if (edit := edit_of(sites, chance)) is not None}
    assert drawn == set(EditKind) - set(OUTSIDE) - set(REPAIRS)
