"""Arrays of numbers: new ones, longer copies, rings laid out anew."""

import mmap
from array import array
from typing import Any, Literal, TypeVar, cast, overload

_IS_LAZY = hasattr(mmap, "MAP_PRIVATE")  # can the system give pages that cost nothing until they are written?
_Number = TypeVar("_Number", int, float)

# Of an object: the names of rows, their new length, and what new cells hold; of a ring its name, its room, and None.
Growth = tuple[object, str, int, float | None]

_SHORT = 2**9  # cells up to which rows grow fourfold
_LARGE = 2**22  # bytes from which an array lives in such pages
_noted: list[Growth] | None = None  # where growth is noted, if somebody wants to know


@overload
def blank(length: int, code: Literal["b", "h", "i", "q"] = ...) -> "array[int]": ...
@overload
def blank(length: int, code: Literal["d"]) -> "array[float]": ...
def blank(length: int, code: str = "q") -> "array[Any]":
    """Zeros: `length` whole numbers, or what the type code of `array` says."""
    return array(code, bytes(array(code).itemsize * length))


def grown(old: "array[_Number]", length: int, fill: float = 0) -> "array[_Number]":
    """Longer copy of `old`: `length` cells, the new ones hold `fill`."""
    view = memoryview(old)
    code = view.format
    size = length * view.itemsize
    is_lazy = size >= _LARGE and fill == 0 and _IS_LAZY
    new: array[Any] = _lazily_zeroed(code, size) if is_lazy else array(code, [fill]) * length
    memoryview(new)[: len(view)] = view
    return new


def grow_rows(owner: object, names: str, length: int, fill: float = 0) -> None:
    """Lengthen the arrays of an object that have these names, with spaces between them.

    Once it is made, an object gets other arrays in no other way, and by `grow_ring`.
    """
    if _noted is not None:
        _noted.append((owner, names, length, fill))
    for name in names.split():
        setattr(owner, name, grown(getattr(owner, name), length, fill))


def lengthen(owner: object, zeros: str, nones: str = "", need: int = 0) -> None:
    """Lengthen rows of an object, at least to `need`: in new cells is 0, and -1 in those of the arrays named last."""
    room = _next_room(len(getattr(owner, zeros.partition(" ")[0])))
    while room < need:
        room = _next_room(room)
    grow_rows(owner, zeros, room)
    grow_rows(owner, nones, room, -1)


def _lazily_zeroed(code: Any, size: int) -> "array[Any]":
    """Zeros, of so many bytes, in pages of their own: private ones, for workers are forked."""
    try:
        pages = mmap.mmap(-1, size, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    except OSError:
        raise MemoryError from None
    return cast("array[Any]", memoryview(pages).cast(code))


def _next_room(room: int) -> int:
    """How long rows become that were `room` long: short ones faster, for growth is much of a small problem's time."""
    return room * (4 if room < _SHORT else 2)


def next_log_room(room: int) -> int:
    """How long the arrays of a log become: large ones, too, grow faster where their end costs nothing."""
    return room * 4 if _IS_LAZY and room >= 2**18 else _next_room(room)


def grow_ring(owner: object, name: str, room: int) -> None:
    """Lengthen the ring `name_queue` of an object, whose live part moves to the start."""
    if _noted is not None:
        _noted.append((owner, name, room, None))
    old, first, last = (getattr(owner, f"{name}_{part}") for part in ("queue", "first", "last"))
    new = blank(room, "i")
    count = (last - first) % len(old)
    for i in range(count):
        new[i] = old[(first + i) % len(old)]
    for part, value in (("queue", new), ("first", 0), ("last", count), ("mask", room - 1)):
        setattr(owner, f"{name}_{part}", value)


def note_growth(into: list[Growth] | None) -> list[Growth] | None:
    """Note from now on in a list what grows, or nowhere; gives where it was noted before."""
    global _noted
    before, _noted = _noted, into
    return before


def grow_again(growth: Growth) -> None:
    """Repeat what was noted, on the object as it was before."""
    owner, names, length, fill = growth
    if fill is None:
        grow_ring(owner, names, length)
    else:
        grow_rows(owner, names, length, fill)
