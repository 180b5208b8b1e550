"""Make an array of numbers longer; growth is rare, so it stays uncompiled."""

from array import array


def widened(old: "array[int]", room: int, fill: int) -> "array[int]":
    """A copy of `old` with `room` cells."""
    new = array("q", [fill]) * room
    memoryview(new)[: len(old)] = memoryview(old)
    return new
