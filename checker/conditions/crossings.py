"""Crossings: places where changing one parameter alone turns failing into passing, found by halving.

From a failing to a passing point the parameters are changed one after the other; somewhere on that path the verdict
flips, and there the one parameter is halved. So an edge that one parameter sets is met at the same value everywhere,
and one that several set together at values that tell of their term.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from checker.conditions.flights import Ended, Flights, SpentError
from checker.conditions.space import Point

_COARSE = 2.0**-10  # of an axis' range
FINE = 1e-5  # floats of the engine are no sharper
_ENOUGH = 8  # walks that begin or end where a rule was wrong
_NEAREST = 5
_NOTHING_NEW = 14  # crossings in a row that meet known edges: there are no others
_CHANCE = 0.25  # the weight of a crossing where there are so few values that edges may agree by chance


@dataclass(frozen=True, slots=True)
class Crossing:
    """`failing` and `passing` are neighbours that differ in axis number `axis` alone."""

    axis: int
    failing: Point
    passing: Point


def find_crossings(
    flights: Flights, failing: Sequence[Point], passing: Sequence[Point], share: float
) -> list[Crossing]:
    """Walk from failing to passing points until nothing new is met, or a share of the budget is spent."""
    chance = np.random.default_rng(flights.example.seed)
    limit = flights.count + int(share * (flights.budget - flights.count))
    fails, passes = list(dict.fromkeys(failing)), list(dict.fromkeys(passing))
    found: list[Crossing] = []
    turn, known = 0, 0.0
    try:
        while flights.count < limit and fails and passes and known < _NOTHING_NEW and turn < flights.budget:
            start = fails[turn % len(fails)]
            goal = _goal(start, passes, flights, chance, nearest=turn % 2 == 0)
            crossing = _cross(flights, start, goal, chance.permutation(len(start)).tolist(), found)
            if crossing is not None:
                weight = _CHANCE if flights.space.parameters[crossing.axis].is_stepped() else 1.0
                known = known + weight if any(_meet(crossing, one) for one in found) else 0.0
                found += [crossing] if crossing not in found else []
                if flights.label(crossing.failing) is Ended.FAILS and turn % 3 == 0:
                    fails.append(crossing.failing)
            mixed = _mixed(flights, fails, passes, chance)
            (fails if flights.label(mixed) is Ended.FAILS else passes if not flights.fails(mixed) else []).append(mixed)
            turn += 1
    except SpentError:
        pass
    return found


def mend_crossings(
    flights: Flights, known: Sequence[Crossing], starts: Sequence[Point], goals: Sequence[Point]
) -> list[Crossing]:
    """Further crossings on the ways between points that a rule took for something else, and others."""
    chance = np.random.default_rng(len(known))
    found = list(known)
    with suppress(SpentError):
        for turn in range(_ENOUGH):
            start, goal = starts[turn % len(starts)], goals[turn % len(goals)]
            crossing = _cross(flights, start, goal, chance.permutation(len(start)).tolist(), found)
            if crossing is not None and crossing not in found:
                found.append(crossing)
    return found


def _cross(
    flights: Flights, start: Point, goal: Point, order: Sequence[int], known: Sequence[Crossing] = ()
) -> Crossing | None:
    """The flip on the way from a failing point to a passing one; None where either is not what it is taken for.

    A `known` flip on the same axis is tried first: where it is met again, two flights do instead of halving.
    """
    way = [start]
    for axis in order:
        if way[-1][axis] != goal[axis]:
            way.append(_with(way[-1], axis, goal[axis]))
    if len(way) < 2 or not flights.fails(start) or flights.fails(goal):
        return None
    fails, passes = 0, len(way) - 1
    while passes - fails > 1:
        middle = (fails + passes) // 2
        if flights.fails(way[middle]):
            fails = middle
        else:
            passes = middle
    axis = next(number for number, value in enumerate(way[fails]) if value != way[passes][number])
    crossing = Crossing(axis, way[fails], way[passes])
    for one in known:
        if one.axis == axis and (inner := _inside(crossing, one)) is not None:
            at_failing, at_passing = flights.fails(inner.failing), flights.fails(inner.passing)
            if at_failing and not at_passing:
                return inner
            crossing = (
                Crossing(axis, inner.passing, crossing.passing)
                if at_failing
                else Crossing(axis, crossing.failing, inner.failing)
            )
    return sharpen(flights, crossing, _COARSE)


def _inside(crossing: Crossing, known: Crossing) -> Crossing | None:
    """The ends of a known flip on the line of a crossing; None where they do not lie between its ends."""
    axis = crossing.axis
    start, end = crossing.failing[axis], crossing.passing[axis]
    one, other = known.failing[axis], known.passing[axis]
    low, high = sorted((start, end))
    if (one > other) is not (start > end) or not low <= min(one, other) < max(one, other) <= high:
        return None
    return Crossing(axis, _with(crossing.failing, axis, one), _with(crossing.failing, axis, other))


def _meet(one: Crossing, other: Crossing) -> bool:
    """Whether two crossings may be of one edge."""
    if one.axis != other.axis:
        return False
    axis = one.axis
    low, high = sorted((one.failing[axis], one.passing[axis]))
    ends = sorted((other.failing[axis], other.passing[axis]))
    is_same_side = (one.failing[axis] > one.passing[axis]) is (other.failing[axis] > other.passing[axis])
    return is_same_side and max(low, ends[0]) <= min(high, ends[1])


def sharpen(flights: Flights, crossing: Crossing, resolution: float) -> Crossing:
    """Halve a crossing down to `resolution` of the range."""
    axis, failing, passing = crossing.axis, crossing.failing, crossing.passing
    while (middle := flights.space.parameters[axis].between(failing[axis], passing[axis], resolution)) is not None:
        point = _with(failing, axis, middle)
        if flights.fails(point):
            failing = point
        else:
            passing = point
    return Crossing(axis, failing, passing)


def _goal(
    start: Point, passes: Sequence[Point], flights: Flights, chance: np.random.Generator, *, nearest: bool
) -> Point:
    """A passing point: one of the nearest, or any."""
    if not nearest:
        return passes[int(chance.integers(len(passes)))]
    widths = [axis.width for axis in flights.space.parameters]

    def distance(point: Point) -> float:
        return sum(abs(a - b) / width for a, b, width in zip(point, start, widths, strict=True))

    return sorted(passes, key=distance)[int(chance.integers(min(_NEAREST, len(passes))))]


def _mixed(flights: Flights, fails: Sequence[Point], passes: Sequence[Point], chance: np.random.Generator) -> Point:
    """A point that has some values of a failing one and the others of a passing one, or of nowhere."""
    one, other = fails[int(chance.integers(len(fails)))], passes[int(chance.integers(len(passes)))]
    values = []
    for axis, a, b in zip(flights.space.parameters, one, other, strict=True):
        values.append((a, a, b, axis.at(float(chance.random())))[int(chance.integers(4))])
    return tuple(values)


def _with(point: Point, axis: int, value: float) -> Point:
    return (*point[:axis], value, *point[axis + 1 :])
