"""The nearest known name is the one that a slip of the finger turns into the unknown one."""

import pytest

from nddl_lang.semantics.nearest import nearest

KNOWN = ["speed", "speedLimit", "horizon", "addEq", "temporalDistance", "a", "Lamp"]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("sped", "speed"),
        ("psede", None),
        ("spede", "speed"),
        ("SPEED", "speed"),
        ("adEQ", "addEq"),
        ("temporaldistance", "temporalDistance"),
        ("temproalDistnce", "temporalDistance"),
        ("hirizan", "horizon"),
        ("Lmap", "Lamp"),
        ("b", "a"),
        ("altitude", None),
        ("speedlimits", "speedLimit"),
    ],
)
def test_a_slip_is_recognised(name: str, expected: str | None) -> None:
    assert nearest(name, KNOWN) == expected


def test_of_equally_near_names_the_first_is_taken() -> None:
    assert nearest("gx", ["gy", "gz"]) == "gy"
    assert nearest("gx", ["gz", "gy"]) == "gz"
