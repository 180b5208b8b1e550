"""Saddles: an edge of a product of two differences, such as `(SNOW - 0.3) * (HOOKING - 9) > 0`, taken apart.

Where such an edge runs through the saddle, inside of both ranges, it has two parts, of which the crossings that it was
fitted to may lie in one alone. So the limits of both parameters stand for it: which parts hold is then for the rules.
"""

from collections.abc import Sequence

from checker.conditions.condition import Extreme, Literal, axis_feature
from checker.conditions.space import Range
from checker.simplest import shortest_decimal

_LEVEL = 0.1  # of the product at its greatest: so near to 0 an edge runs through the saddle
_FINE = 0.005  # of a range


def taken_apart(literal: Literal, axes: Sequence[Range]) -> list[Literal]:
    """The limits of two parameters in place of an edge through a saddle; other edges as they are."""
    weights = {tuple(sorted(powers)): coefficient for coefficient, powers in literal.feature.monomials}
    names = literal.feature.parameters
    ranges = {axis.name: axis for axis in axes if axis.name in names}
    if literal.feature.extreme is not Extreme.ONLY or len(names) != len(ranges) or len(ranges) != 2:
        return [literal]
    one, other = sorted(ranges)
    product, first, second = (((one, 1), (other, 1)), ((one, 1),), ((other, 1),))
    if product not in weights or not weights.keys() <= {product, first, second}:
        return [literal]
    scale = weights[product]
    at = {one: -weights.get(second, 0.0) / scale, other: -weights.get(first, 0.0) / scale}
    if not all(ranges[name].lower < value < ranges[name].upper for name, value in at.items()):
        return [literal]
    level = literal.edge / scale + at[one] * at[other]
    greatest = 1.0
    for name, value in at.items():
        greatest *= max(value - ranges[name].lower, ranges[name].upper - value)
    if abs(level) > _LEVEL * greatest:
        return [literal]
    margin = {name: _FINE * ranges[name].width for name in at}
    return [
        Literal(axis_feature(name), True, shortest_decimal(value - margin[name], value + margin[name]))
        for name, value in at.items()
    ]
