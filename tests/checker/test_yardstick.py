"""Faults are put into small missions of different structure: most are found, and each is one fault to a user."""

import os
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

import pytest

from checker.counterfactual.effort import Bounds
from checker.mission import read_mission
from checker.models import load_models
from checker.yardstick import TOP, Fate, MutantReport, measure, open_flyer, prepare

UNSEEN = Path(__file__).resolve().parent / "unseen"
MISSIONS = 1
SEED = 2


def reports(name: str, limit: int) -> Iterator[MutantReport]:
    """The first faults of a mission, each flown and sought."""
    mission, found = read_mission(UNSEEN / name / "mission.toml")
    assert mission is not None, found
    models = load_models(mission)
    assert not models.has_errors, models.diagnostics
    with open_flyer(mission, models) as flyer:
        ground = prepare(mission, models, MISSIONS, flyer)
        assert len(ground.seeds) == MISSIONS
        yield from islice(measure(ground, flyer, SEED, Bounds), limit)


WHOLE = bool(os.environ.get("NDDLC_VARIANTS"))
# Two planners and a store; draws that multiply, a loop and guards; a reactor in Python whose reports have rules.
OLDER = (("quay", 5), ("kiln", 9), ("gale", 6))
# A battery and passes that are waited for; a planner that a planner asks; branches and relations to what is over.
NEWER = (("glider", 6), ("mooring", 10), ("sol", 9))
# A short form of both.
SOME = (("quay", 3), ("gale", 4), ("mooring", 4), ("sol", 4))


@pytest.mark.once
@pytest.mark.parametrize("missions", [OLDER, NEWER] if WHOLE else [SOME])
def test_most_faults_are_found_and_each_is_one_to_a_user(missions: tuple[tuple[str, int], ...]) -> None:
    found = [one for name, limit in missions for one in reports(name, limit)]
    failing = [one for one in found if one.fate is Fate.FAILS]
    told = [(one.edit.line, one.edit.old, one.edit.new.strip(), one.place) for one in failing]
    assert len(failing) >= (9 if WHOLE else 6), told
    assert sum(1 <= one.place <= TOP for one in failing) >= 0.9 * len(failing), told
    assert sum(one.place == 1 for one in failing) >= 0.8 * len(failing), told
    assert all(one.faults == 1 for one in failing), told
