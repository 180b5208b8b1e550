"""Edges of failing: crossings in, literals out: limits of one parameter, and of terms of several (terms.py).

A limit is believed where it lies between passing and failing at every crossing that it explains.
"""

from collections.abc import Sequence
from contextlib import suppress

from checker.conditions.condition import Extreme, Literal, axis_feature
from checker.conditions.crossings import FINE, Crossing, sharpen
from checker.conditions.flights import Flights, SpentError
from checker.conditions.saddles import taken_apart
from checker.conditions.terms import best_term
from checker.simplest import shortest_decimal


def find_edges(flights: Flights, crossings: Sequence[Crossing]) -> list[Literal]:
    """The limits that explain the crossings: of one parameter first, then of terms of several."""
    axes = flights.space.parameters
    found: list[Literal] = []
    left = list(crossings)
    for axis in range(len(axes)):
        for is_above in (True, False):
            own = [one for one in left if one.axis == axis and (one.failing[axis] > one.passing[axis]) is is_above]
            while own:
                group = max((_agreeing(one, own) for one in own), key=len)
                own = [one for one in own if one not in group]
                others = {tuple(v for i, v in enumerate(one.failing) if i != axis) for one in group}
                if len(others) > 1 or len(axes) == 1 or not _other_axes(left, axis):
                    found.append(_axis_literal(flights, axis, group))
                    left = [one for one in left if one not in group]
    for size in (2, 3):
        rest = list(crossings) if _may_coincide(flights, crossings) else left
        while rest and (term := best_term(flights, rest, size)) is not None:
            literal, explained = term
            found.append(literal)
            rest = [one for one in rest if one not in explained]
            left = [one for one in left if one not in explained]
    for one in left:  # what nothing else explains may still be a limit that was met once
        found.append(_axis_literal(flights, one.axis, [one]))
    return list(dict.fromkeys(each for one in found for each in taken_apart(one, axes)))


def _may_coincide(flights: Flights, crossings: Sequence[Crossing]) -> bool:
    """Whether flips may be at one value by chance: where there are only some values."""
    return any(flights.space.parameters[one.axis].is_stepped() for one in crossings)


def _other_axes(crossings: Sequence[Crossing], axis: int) -> bool:
    return any(one.axis != axis for one in crossings)


def _agreeing(chosen: Crossing, crossings: Sequence[Crossing]) -> list[Crossing]:
    """The crossings of an axis whose stretches meet that of `chosen`."""
    axis = chosen.axis
    low, high = sorted((chosen.failing[axis], chosen.passing[axis]))
    group = []
    for one in crossings:
        ends = sorted((one.failing[axis], one.passing[axis]))
        if max(low, ends[0]) <= min(high, ends[1]):
            group.append(one)
            low, high = max(low, ends[0]), min(high, ends[1])
    return group


def _axis_literal(flights: Flights, axis: int, group: Sequence[Crossing]) -> Literal:
    """The limit of one parameter, sharpened by flights."""
    space = flights.space.parameters[axis]
    narrowest = min(group, key=lambda one: abs(one.failing[axis] - one.passing[axis]))
    with suppress(SpentError):
        narrowest = sharpen(flights, narrowest, FINE)
    failing, passing = narrowest.failing[axis], narrowest.passing[axis]
    is_above = failing > passing
    extreme = Extreme.ONLY
    if space.is_redrawn:
        extreme = Extreme.GREATEST if is_above else Extreme.LEAST
    feature = axis_feature(space.name, extreme)
    if space.is_stepped():
        return Literal(feature, is_above, failing, holds_at_edge=True)
    slack = FINE * space.width
    edge = shortest_decimal(min(failing, passing) - slack, max(failing, passing) + slack)
    point = (*narrowest.failing[:axis], edge, *narrowest.failing[axis + 1 :])
    try:
        return Literal(feature, is_above, edge, flights.fails(point))
    except SpentError:
        return Literal(feature, is_above, edge)
