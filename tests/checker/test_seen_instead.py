"""Where something was to be reached and was not, it is told what came in its place."""

from typing import Any

import pytest

from checker.oracle import PROPERTY, Judgement, Verdict
from checker.rendering import failure_text
from runtime.executive.configuration import TokenPattern
from tests.checker.test_properties import LATE_UP, down, fate


@pytest.mark.parametrize(
    ("pattern", "given", "seen"),
    [
        (down(depth=55.0), {"by": 79}, "`Down` began at 50 and lasted until 80"),
        (LATE_UP, {}, "`Up` began at 80"),
        (down(depth=99.0), {}, "`Down` came with `depth` 40, 55"),
        (down(mode="STOP"), {}, "`Down` came with `mode` FAST, SLOW"),
        (down(depth=(60, 70), mode="STOP"), {}, "`Down` came with `depth` 40, 55 and `mode` FAST, SLOW"),
        (down(depth=99.0, mode="SLOW"), {"since": 40}, "`Down` came with `depth` 55"),
        (down(depth=40.0, mode="SLOW"), {}, ""),  # each of them came, but not together
        (down("depth > 60"), {}, ""),
        (down(), {"since": 60}, "`Down` never came on `dive`"),
        (TokenPattern("dive", "Sideways"), {}, "`Sideways` never came on `dive`"),
        (down(), {}, None),
    ],
)
def test_what_came_in_place_of_what_was_to_be_reached_is_told(
    pattern: TokenPattern, given: dict[str, Any], seen: str | None
) -> None:
    found = fate("reached", pattern, **given)
    assert (found.is_kept, found.seen) == (seen is None, seen or "")
    if not found.is_kept:
        text = failure_text(Judgement(Verdict.FAIL, PROPERTY, broken=found))
        assert text == f"the property `p` is violated at tick {found.tick}" + (f": {seen}" if seen else "")
