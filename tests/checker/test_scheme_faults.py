"""Faults of models written for measuring: what a property speaks of, why a token came then, what is unread."""

import pytest

from checker.yardstick import TOP, Fate
from tests.checker.scheme_study import reports

pytestmark = pytest.mark.once


@pytest.mark.parametrize(
    ("model", "line"),
    [
        ("theatre", "if (mood == Mood.night) {"),  # a property forbids Fade where lamps > 30; the branch sets these
        ("orchard", "probe.start >= open.duration + SOAK_MIN;"),  # the probe ends before the water it comes after
        ("ward", "duration == ceil(milligrams) + needle;"),  # nothing reads the rate of the drip
    ],
)
def test_the_changed_line_is_among_the_first_causes(model: str, line: str) -> None:
    (found,) = reports(model, (line,))
    assert found.fate is Fate.FAILS
    assert 1 <= found.place <= TOP
