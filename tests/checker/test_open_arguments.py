"""Of an argument that was never decided a property looks at all its values."""

from math import inf
from typing import Any

import pytest

from runtime.executive.configuration import TokenPattern
from runtime.executive.record import ValueRange
from tests.checker.test_properties import down, fate, token


@pytest.mark.parametrize(
    ("kind", "where", "parameters", "margin"),
    [
        ("always", "depth >= 40", {}, 2.0),
        ("always", "depth >= 44", {}, -2.0),
        ("always", "100 - 2 * depth / 4 > 70 and depth < 60", {}, 5.0),
        ("always", "depth >= 44 or 60 > depth", {}, 10.0),
        ("always", "depth * depth > 1", {}, -inf),  # ends of a range don't tell
        ("always", "depth == 42", {}, -inf),
        ("always", "", {"depth": (40.0, 60.0)}, 2.0),
        ("always", "", {"depth": (45.0, 60.0)}, -3.0),
        ("never", "depth > 45", {}, 3.0),  # a token matches if all of its values do
        ("never", "depth > 40", {}, -2.0),
    ],
)
def test_of_an_argument_that_was_never_decided_all_values_count(
    kind: str, where: str, parameters: dict[str, Any], margin: float
) -> None:
    one = token("dive", "Dive.Down", 10, 30, ValueRange(42.0, 50.0), "FAST")
    found = fate(kind, down(where, **parameters), tokens=(one,))
    assert (found.is_kept, found.margin) == (margin >= 0.0, margin)
    assert found.seen == ("" if found.is_kept else "`depth` was never decided (42 to 50)")


def test_a_bound_that_rounding_made_of_0_is_told_as_0() -> None:
    one = token("dive", "Dive.Down", 10, 30, ValueRange(-5e-324, 2.5), "FAST")
    assert fate("always", down("depth >= 40"), tokens=(one,)).seen == "`depth` was never decided (0 to 2.5)"


def test_an_argument_that_a_token_does_not_have_is_none_that_was_never_decided() -> None:
    found = fate("always", TokenPattern("dive", "", (("depth", 42.0),)), tokens=(token("dive", "Dive.Up", 10, 30),))
    assert not found.is_kept and found.seen == ""
