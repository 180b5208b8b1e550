"""Ticks stand on round numbers inside the axis."""

import pytest

from runtime.view.axis import ticks, whole_ticks


@pytest.mark.parametrize(
    ("first", "last", "least", "expected"),
    [
        (0, 100, 20, [0, 20, 40, 60, 80, 100]),
        (0, 100, 21, [0, 50, 100]),
        (-7, 12, 4, [-5, 0, 5, 10]),
        (3, 5, 0.1, [3, 4, 5]),
        (7, 7, 0.0, [7]),
    ],
)
def test_whole_ticks_are_multiples_of_one_two_or_five(first: int, last: int, least: float, expected: list[int]) -> None:
    assert list(whole_ticks(first, last, least)) == expected


def test_ticks_of_real_axes_carry_no_noise() -> None:
    assert ticks(-0.3, 0.3, 0.1) == [-0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3]
    assert ticks(0.0, 1.0, 0.3) == [0.0, 0.5, 1.0]
