"""Make arrays of numbers and longer copies of them. Growth is rare, so it stays uncompiled."""

from array import array


def grown(old: "array[int]", length: int) -> "array[int]":
    """Copy `old` into an array of `length` cells, zeros behind."""
    fresh = blank(length)
    memoryview(fresh)[: len(old)] = memoryview(old)
    return fresh


def blank(length: int) -> "array[int]":
    """An array of `length` zeros."""
    return array("q", bytes(8 * length))


def grown_reals(old: "array[float]", length: int) -> "array[float]":
    """Copy `old` into an array of `length` reals, zeros behind."""
    fresh = blank_reals(length)
    memoryview(fresh)[: len(old)] = memoryview(old)
    return fresh


def blank_reals(length: int) -> "array[float]":
    """An array of `length` zeros."""
    return array("d", bytes(8 * length))
