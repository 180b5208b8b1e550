"""Garbage collection: have it look seldom while missions are flown and their results are taken."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager

_MANY = 1_000_000  # objects that are made, and not gone again, between two looks of the garbage collector


@contextmanager
def seldom_collected() -> Iterator[None]:
    """Of a mission much stays until its end, of its result all, and next to nothing is a cycle."""
    before = gc.get_threshold()
    gc.set_threshold(max(before[0], _MANY) if before[0] else 0, *before[1:])
    try:
        yield
    finally:
        gc.set_threshold(*before)
