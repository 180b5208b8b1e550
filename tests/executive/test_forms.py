"""Mutants of missions fly alike compiled and interpreted, determined or not, and the judge agrees."""

import random

import pytest

from checker.mutation.edits import EditKind
from tests.executive.mutants.campaign import departures, flown
from tests.executive.mutants.flights import FILES, edit_of

COUNT = 60
MISSIONS = 2


@pytest.mark.slow
def test_mutants_fly_alike_in_both_forms() -> None:
    compiled, interpreted = (flown(form, 0, COUNT, MISSIONS, seconds) for form, seconds in (("", 20), ("1", 600)))
    assert [line for line in [*compiled, *interpreted] if line.startswith("WRONG")] == []
    assert departures(compiled, interpreted) == []
    codes = {line.split()[4] for line in compiled if len(line.split()) > 5}
    assert codes >= {"ended", "F1"}
    assert len({line.split()[0] for line in compiled}) == COUNT


def test_departures_are_found() -> None:
    one, other = "3 repair constant 0 F1 5 ab", "3 repair constant 0 F1 5 cd"
    assert departures([one], [one]) == []
    assert len(departures([one], [other])) == 1


@pytest.mark.once
def test_a_fault_of_every_kind_is_drawn() -> None:
    chance = random.Random(1)
    models = [model for file in FILES for model in sorted(file.parent.glob("*.nddl"))]
    drawn = [edit for _ in range(20) for model in models if (edit := edit_of(model, chance)) is not None]
    assert {edit.kind for edit in drawn} == set(EditKind) - {
        EditKind.MISSION,
        EditKind.GOAL,
        EditKind.VALUE,
    }  # whose lines these models lack
