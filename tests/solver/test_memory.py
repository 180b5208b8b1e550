"""Nothing is held of what was planned and undone, posted and rewound, restricted and retracted."""

from collections.abc import Callable

import pytest

from tests.constraints.reference import RUNS
from tests.solver.lasting import plan_and_undo, post_and_undo, resident, tick

SPARE = 2 * 2**20  # what the system's own bookkeeping may need over a long run


@pytest.mark.parametrize(("life", "turns"), [(post_and_undo, RUNS), (plan_and_undo, RUNS), (tick, max(200, RUNS // 5))])
def test_turns_leave_nothing_behind(life: Callable[[int], list[tuple[int, int]]], turns: int) -> None:
    found = life(turns)
    assert found[-1][0] == found[2][0], "arrays grow"
    assert resident() == 0 or found[-1][1] <= found[2][1] + SPARE, "the process grows"
