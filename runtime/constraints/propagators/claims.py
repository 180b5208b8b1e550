"""Claims: what constraints demand of numbers, in exact arithmetic over any `Algebra`; no propagator uses them."""

from collections.abc import Sequence
from itertools import combinations, pairwise
from math import prod
from typing import Any

from runtime.constraints.propagators.row import Algebra

Numbers = Sequence[Any]


def all_equal(z: Algebra, x: Numbers) -> Any:
    """All numbers are equal."""
    return z.every([a == b for a, b in pairwise(x)])


def all_different(z: Algebra, x: Numbers) -> Any:
    """No two numbers are equal."""
    return z.every([a != b for a, b in combinations(x, 2)])


def greatest(z: Algebra, result: Any, x: Numbers) -> Any:
    """The result is the greatest of some numbers."""
    return z.every([*(result >= a for a in x), z.some([result == a for a in x])])


def least(z: Algebra, result: Any, x: Numbers) -> Any:
    """The result is the least of some numbers."""
    return z.every([*(result <= a for a in x), z.some([result == a for a in x])])


def product(x: Numbers) -> Any:
    """Multiply."""
    return prod(x[1:], start=x[0])


def total(x: Numbers) -> Any:
    """Add."""
    return sum(x[1:], start=x[0])


def absolute(z: Algebra, x: Numbers) -> Any:
    """The first number is the absolute value of the second."""
    return x[0] == z.choose(x[1] >= 0, x[1], -x[1])


def root(z: Algebra, result: Any, square: Any) -> Any:
    """The result is the square root of a number."""
    return z.every([result >= 0, z.real(result) * z.real(result) == square])


def square_root(z: Algebra, x: Numbers) -> Any:
    """The first number is the square root of the second."""
    return root(z, x[0], x[1])


def rounded_down(z: Algebra, x: Numbers) -> Any:
    """The first number is the second rounded down."""
    return x[0] == z.floor(x[1])


def rounded_up(z: Algebra, x: Numbers) -> Any:
    """The first number is the second rounded up."""
    return x[0] == -z.floor(-x[1])


def count(z: Algebra, x: Numbers, *, of_zeroes: bool) -> Any:
    """How many numbers are 0, or are not 0."""
    return total([z.choose((a == 0) == of_zeroes, 1, 0) for a in x])


def distance(z: Algebra, x: Numbers) -> Any:
    """The first number is the distance of two points."""
    east, north = z.real(x[1]) - z.real(x[3]), z.real(x[2]) - z.real(x[4])
    return root(z, x[0], east * east + north * north)


def remainder(z: Algebra, x: Numbers) -> Any:
    """The first number is the rest of a division of whole numbers, with the sign of the dividend."""
    if not (z.is_whole(x[1]) and z.is_whole(x[2])):
        return None
    size = z.choose(x[2] > 0, x[2], z.choose(x[2] < 0, -x[2], 1))
    return z.every([x[2] != 0, x[0] == z.choose(x[1] >= 0, x[1] % size, -(-x[1] % size))])
