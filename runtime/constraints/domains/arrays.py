"""Make an array longer; rings are laid out anew. Growth is rare, so it stays uncompiled."""

import mmap
from array import array
from typing import Any, cast

IS_LAZY = hasattr(mmap, "MAP_PRIVATE")  # can the system give pages that cost nothing until they are written?
LARGE = 2**22  # bytes from which an array lives in such pages


def grown(old: "array[Any]", code: str, room: int, fill: float) -> "array[Any]":
    """Copy `old` into a longer array."""
    new = array(code, [fill])
    size = room * new.itemsize
    new = lazily_zeroed(code, size) if IS_LAZY and fill == 0 and size >= LARGE else new * room
    memoryview(new)[: len(old)] = memoryview(old)
    return new


def lazily_zeroed(code: Any, size: int) -> "array[Any]":
    """Give an array of zeros, of so many bytes, in pages of its own: private ones, for workers are forked."""
    pages = mmap.mmap(-1, size, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    return cast("array[Any]", memoryview(pages).cast(code))


def next_room(room: int) -> int:
    """How long the arrays of a log become that were `room` long: large ones grow faster where the end costs nothing."""
    return room * (4 if IS_LAZY and room >= 2**18 else 2)


def grown_ring(old: "array[int]", first: int, last: int, room: int) -> "array[int]":
    """Copy a ring's live part to the start of a longer one."""
    new = array("i", [0]) * room
    length = len(old)
    count = (last - first) % length
    for i in range(count):
        new[i] = old[(first + i) % length]
    return new
