"""Make an array longer; rings are laid out anew. Growth is rare, so it stays uncompiled."""

from array import array
from typing import Any


def grown(old: "array[Any]", code: str, room: int, fill: float) -> "array[Any]":
    """Copy `old` into a longer array."""
    new = array(code, [fill]) * room
    memoryview(new)[: len(old)] = memoryview(old)
    return new


def grown_ring(old: "array[int]", first: int, last: int, room: int) -> "array[int]":
    """Copy a ring's live part to the start of a longer one."""
    new = array("i", [0]) * room
    length = len(old)
    count = (last - first) % length
    for i in range(count):
        new[i] = old[(first + i) % length]
    return new
