"""The test that users write for their constraints finds what is wrong with them."""

from pathlib import Path

import pytest

from runtime.user.constraint import Constraint
from runtime.user.fault import UserCodeError
from runtime.user.library import load_library
from runtime.user.sound import UnsoundError, check_sound
from runtime.user.view import Value, View

BATHYMETRY = Path(__file__).parents[2] / "models" / "bathymetry"


class Below(Constraint):
    """x <= y, right or wrong."""

    name = "below"
    signature = "x:number y:number"
    meaning = "x is no more than y"

    def __init__(self, slack: float, *, looks_back: bool = True, needs_bounds: bool = False) -> None:
        self.slack = slack
        self.looks_back = looks_back
        self.needs_bounds = needs_bounds

    def propagate(self, view: View) -> bool:
        """Narrow one bound or two."""
        if self.needs_bounds:
            int(view.upper(1))
        if not view.reduce_to(0, view.upper(1) - self.slack):
            return False
        return not self.looks_back or view.raise_to(1, view.lower(0))


SAMPLES: list[tuple[Value, ...]] = [(1, 2), (3, 3), (0.5, 7.25), (-4.0, -4.0)]


def test_a_sound_constraint_passes() -> None:
    check_sound(Below(0), SAMPLES, wrong=[(3, 2), (0.5, 0.25)])


def test_a_lost_solution_is_shown() -> None:
    with pytest.raises(UnsoundError, match=r"`below` over 3, 3 was refused, but \(3, 3\) is a solution"):
        check_sound(Below(1), SAMPLES)


def test_a_wrong_value_that_passes_is_shown() -> None:
    class Lax(Below):
        def propagate(self, view: View) -> bool:
            return True

    with pytest.raises(UnsoundError, match=r"`below` accepts \(3, 2\), which is wrong"):
        check_sound(Lax(0), SAMPLES, wrong=[(3, 2)])


def test_code_that_does_not_stand_infinite_bounds_is_found() -> None:
    with pytest.raises(UserCodeError, match="OverflowError: cannot convert float infinity to integer"):
        check_sound(Below(0, needs_bounds=True), [(1.0, 2.0)])


def test_a_test_that_denies_a_sample_is_found() -> None:
    class Never(Below):
        def holds(self, values: object) -> bool:
            return False

    with pytest.raises(UnsoundError, match="`holds` denies the sample"):
        check_sound(Never(0), SAMPLES)


def test_the_chart_of_the_example_is_sound() -> None:
    (chart,) = load_library(BATHYMETRY, ["chart.py"], ()).constraints
    places = [(10.0, 20.0), (80.0, 60.0), (165.0, 90.0), (250.0, 150.0), (0.0, 0.0)]
    samples = [(chart.chart.depth(x, y), x, y) for x, y in places]  # type: ignore[attr-defined]
    check_sound(chart, samples, wrong=[(10.0, 80.0, 60.0), (20.0, -50.0, 3.0)])
