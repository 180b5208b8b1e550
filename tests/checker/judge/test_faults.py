"""The judge notices engines and executives that are broken on purpose, wherever their missions break the model."""

from collections import Counter

import pytest

from runtime.build_form import build_form
from tests.checker.judge.fault_study import MISSIONS, broken_flights


@pytest.mark.slow
@pytest.mark.skipif(build_form() == "compiled", reason="functions of the compiled engine cannot be replaced")
@pytest.mark.parametrize(
    ("name", "rounds", "noticed", "ended", "raised"), [("walking", 2, 7, 3, 5), ("cooking", 1, 8, 2, 2)]
)
def test_broken_engines_are_noticed(name: str, rounds: int, noticed: int, ended: int, raised: int) -> None:
    load, spans, seconds = MISSIONS[name]
    flights = list(broken_flights(name, load(), range(rounds), spans, seconds))
    seen = Counter(one.fate for one in flights)
    assert seen["noticed"] >= noticed, seen
    assert seen["noticed"] + seen["ended"] >= noticed + ended, seen
    # A mission that a fault keeps from ending is an ERROR, and as loud as an abort.
    assert seen["noticed"] + seen["ended"] + seen["raised"] >= noticed + ended + raised, seen
    # Where the model leaves a choice, a fault may lead to another mission that is right.
    silent = [(one.fault.kind, one.fault.name) for one in flights if one.fate == "silent"]
    assert len(silent) <= 1 + seen["noticed"] / 20, silent
