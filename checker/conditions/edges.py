"""Edges of failing: crossings in, literals out: limits of one parameter, and of linear and product terms of several.

A term is believed where its value at every crossing that it explains lies between passing and failing there. Terms of
two and three parameters are fitted to few crossings (linear in the values, or in their logarithms: products and
quotients) and kept if others agree: random sample consensus (Fischler and Bolles, 1981).
"""

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from itertools import combinations

import numpy as np

from checker.conditions.condition import Extreme, Feature, Literal, axis_feature
from checker.conditions.crossings import FINE, Crossing, sharpen
from checker.conditions.flights import Flights, SpentError
from checker.conditions.space import Point
from checker.simplest import shortest_decimal, simplest_between

_MOST_FITS = 4000
_AGREEING = 2  # crossings beyond those that a term was fitted to
_ROUNDING = 0.02  # of a coefficient: the simplest number so near is tried
_LARGEST_POWER = 3
_SLACK = 2.0  # of a term, in terms of what is sharp for one parameter


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
        while len(rest) >= size + _AGREEING and (term := _best_term(flights, rest, size)) is not None:
            literal, explained = term
            found.append(literal)
            rest = [one for one in rest if one not in explained]
            left = [one for one in left if one not in explained]
    for one in left:  # what nothing else explains may still be a limit that was met once
        found.append(_axis_literal(flights, one.axis, [one]))
    return list(dict.fromkeys(found))


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


def _best_term(flights: Flights, crossings: Sequence[Crossing], size: int) -> tuple[Literal, list[Crossing]] | None:
    """The term of `size` parameters that explains the most crossings, with these."""
    best: tuple[Literal, list[Crossing]] | None = None
    seen: set[Feature] = set()
    for feature in _terms(flights, crossings, size):
        if feature in seen:
            continue
        seen.add(feature)
        literal, explained = _explained(feature, crossings, flights)
        active = {one.axis for one in explained}
        if literal is None or len(explained) < size + _AGREEING or len(active) < 2:
            continue
        if best is None or len(explained) > len(best[1]):
            best = (literal, explained)
    return best


def _terms(flights: Flights, crossings: Sequence[Crossing], size: int) -> Iterator[Feature]:
    """Terms fitted to as many crossings as they have parameters, with simple coefficients."""
    axes = flights.space.parameters
    usable = [number for number, axis in enumerate(axes) if not axis.is_redrawn]
    chance = np.random.default_rng(len(crossings))
    for chosen in combinations(usable, size):
        concerned = [one for one in crossings if one.axis in chosen]
        subsets = list(combinations(range(len(concerned)), size))
        if len(subsets) > _MOST_FITS:
            subsets = [subsets[int(number)] for number in chance.choice(len(subsets), _MOST_FITS, replace=False)]
        middles = [_middle(one) for one in concerned]
        for subset in subsets:
            points = [[middles[number][axis] for axis in chosen] for number in subset]
            linear = _solved(points)
            if linear is not None:
                yield _linear([axes[axis].name for axis in chosen], linear)
            if all(value > 0.0 for point in points for value in point):
                powers = _solved([[math.log(value) for value in point] for point in points])
                if powers is not None and (product := _product([axes[axis].name for axis in chosen], powers)):
                    yield product


def _solved(points: Sequence[Sequence[float]]) -> list[float] | None:
    """The normal of the plane through the points, its first component 1; None where there is no single one."""
    matrix = np.array([[*point, -1.0] for point in points])
    _, singular, rows = np.linalg.svd(matrix)
    if singular[-1] < 1e-9 * singular[0]:
        return None
    normal = rows[-1][:-1]
    largest = float(np.max(np.abs(normal)))
    if largest < 1e-9 or float(np.min(np.abs(normal))) < 0.01 * largest:
        return None
    return [float(value / normal[0]) for value in normal]


def _linear(names: Sequence[str], weights: Sequence[float]) -> Feature:
    simple = [_simple(weight) for weight in weights]
    scale = math.lcm(*(each.denominator for each in simple))
    whole = [each * scale for each in simple]
    divisor = math.gcd(*(each.numerator for each in whole))
    return Feature(tuple((float(each / divisor), ((name, 1),)) for each, name in zip(whole, names, strict=True)))


def _product(names: Sequence[str], powers: Sequence[float]) -> Feature | None:
    simple = [_simple(power) for power in powers]
    scale = math.lcm(*(each.denominator for each in simple))
    whole = [int(each * scale) for each in simple]
    divisor = math.gcd(*whole)
    whole = [each // divisor for each in whole]
    if max(map(abs, whole)) > _LARGEST_POWER:
        return None
    return Feature(((1.0, tuple(zip(names, whole, strict=True))),))


def _simple(value: float) -> Fraction:
    near = abs(value) * _ROUNDING
    return simplest_between(Fraction(value - near), Fraction(value + near))


def _middle(crossing: Crossing) -> Point:
    return tuple((a + b) / 2.0 for a, b in zip(crossing.failing, crossing.passing, strict=True))


def _explained(
    feature: Feature, crossings: Sequence[Crossing], flights: Flights
) -> tuple[Literal | None, list[Crossing]]:
    """The most crossings of a term's parameters that one edge explains, and that edge."""
    row = flights.space.as_row
    names = flights.space.names
    best: list[tuple[float, float, Crossing]] = []
    best_side = True
    for is_above in (True, False):
        stretches = []
        for one in crossings:
            if names[one.axis] not in feature.parameters:
                continue
            fails, passes = feature.value(row(one.failing)), feature.value(row(one.passing))
            if not (math.isnan(fails) or math.isnan(passes)) and (fails > passes) is is_above:
                stretches.append((min(fails, passes), max(fails, passes), one))
        for low, _, _ in stretches:
            group = [each for each in stretches if each[0] <= low <= each[1]]
            if len(group) > len(best):
                best, best_side = group, is_above
    if not best:
        return None, []
    low, high = max(each[0] for each in best), min(each[1] for each in best)
    values = [value for point in flights.known if not math.isnan(value := feature.value(row(point)))]
    slack = _SLACK * FINE * (max(values) - min(values))
    is_stepped = all(axis.is_stepped() for axis in flights.space.parameters if axis.name in feature.parameters)
    if is_stepped:
        return Literal(feature, best_side, high if best_side else low, holds_at_edge=True), [one for *_, one in best]
    return Literal(feature, best_side, shortest_decimal(low - slack, high + slack)), [one for *_, one in best]
