"""Mutants of missions fly alike compiled and interpreted, determined or not, and the judge agrees."""

import random

import pytest

from tests.executive.mutants.campaign import departures, flown
from tests.executive.mutants.flights import FILES
from tests.executive.mutants.mutations import changes, mutated

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


def test_every_kind_of_fault_is_made() -> None:
    texts = [model.read_text() for file in FILES for model in sorted(file.parent.glob("*.nddl"))]
    chance = random.Random(1)
    found = {kind for text in texts for kind in changes(text, chance)}
    assert found == {
        "constant",
        "off by one",
        "limit",
        "relation",
        "comparison",
        "sign",
        "swapped arguments",
        "dropped constraint",
        "dropped branch",
    }
    for text in texts:
        other, kind = mutated(text, chance)
        assert (other != text) == bool(kind)
