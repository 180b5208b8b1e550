"""Arrays grow: what was in them stays, the rest is filled, and a forked worker has its own."""

import os
from array import array

import pytest

from runtime.constraints.domains.arrays import _IS_LAZY, _LARGE, grown, next_log_room


@pytest.mark.parametrize(("code", "fill"), [("q", 0), ("i", 0), ("i", -1), ("b", 0), ("d", 0.0), ("Q", 0)])
@pytest.mark.parametrize("room", [10, _LARGE + 1000])
def test_an_array_keeps_what_it_had(code: str, fill: float, room: int) -> None:
    old = array(code, [1, 2, 3])
    new = grown(old, room, fill)
    assert (len(new), list(new[:4]), new[room - 1]) == (room, [1, 2, 3, fill], fill)
    new[room - 1] = 7
    again = grown(new, next_log_room(room), fill)
    assert (again[1], again[room - 1], again[room], len(again)) == (2, 7, fill, next_log_room(room))


@pytest.mark.skipif(not _IS_LAZY, reason="no forks there")
def test_what_a_forked_worker_writes_is_its_own() -> None:
    large = grown(array("q", [5]), _LARGE)
    child = os.fork()
    if child == 0:
        large[0] = 6
        os._exit(0)
    assert os.waitpid(child, 0)[1] == 0
    assert large[0] == 5
