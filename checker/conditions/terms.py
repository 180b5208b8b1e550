"""Terms of several parameters: crossings in, the term whose value lies between passing and failing at most of them out.

A term is a weighted sum of monomials. Its weights are fitted to as many crossings as there are weights, and it is kept
if others agree: random sample consensus (Fischler and Bolles, 1981). Weights are rounded to simple
numbers as long as the term explains as much. Squares, and sums of products, are tried where linear terms and products
leave crossings unexplained, and have to explain more, the more weights they have.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from checker.conditions.condition import Extreme, Feature, Literal
from checker.conditions.crossings import FINE, Crossing
from checker.conditions.flights import Flights
from checker.conditions.space import Point, Range
from checker.simplest import shortest_decimal, simplest_between

_MOST_FITS = 800
_CURVED_FITS = 40  # for two weights, twice as many for each further one
_AGREEING = 2  # crossings beyond those that a term was fitted to
_SIMPLE = 0.02  # of a weight: the simplest ratio so near is tried
_DECIMAL = (0.005, 0.001, 0.0001)  # of a weight: and then the shortest decimals so near
_AS_GOOD = 0.9  # the share of crossings that a simpler term has to explain
_PRICE = 0.4  # of a weight of a curved term
_LARGEST_POWER = 3
_SLACK = 2.0  # of a term, in terms of what is sharp for one parameter
_SAME = 1e-12  # of a term's size: values nearer to each other are one
_NEGLIGIBLE = 0.01  # a weight so small, where monomials are scaled to one spread, stands for none
_Powers = tuple[int, ...]  # of the chosen parameters, in their order
_Weights = tuple[float, ...]
_Monomials = tuple[tuple[float, tuple[tuple[str, int], ...]], ...]

# Monomials by the number of parameters. The last ones of two are ellipses with a centre of their own.
_CURVED: dict[int, tuple[tuple[_Powers, ...], ...]] = {
    2: (
        ((2, 0), (0, 2)),
        ((2, 0), (0, 1)),
        ((1, 0), (0, 2)),
        ((-1, 0), (0, 1)),
        ((1, 0), (0, -1)),
        ((-1, 0), (0, -1)),
        ((1, 1), (1, 0)),
        ((1, 1), (0, 1)),
        ((1, 1), (1, 0), (0, 1)),
        ((2, 0), (1, 0), (0, 1)),
        ((0, 2), (1, 0), (0, 1)),
        ((2, 0), (0, 2), (1, 0), (0, 1)),
    ),
    3: (
        ((1, 1, 0), (0, 0, 1)),
        ((1, 0, 1), (0, 1, 0)),
        ((0, 1, 1), (1, 0, 0)),
        ((1, -1, 0), (0, 0, 1)),
        ((-1, 1, 0), (0, 0, 1)),
        ((1, 0, -1), (0, 1, 0)),
        ((-1, 0, 1), (0, 1, 0)),
        ((0, 1, -1), (1, 0, 0)),
        ((0, -1, 1), (1, 0, 0)),
        ((2, 0, 0), (0, 2, 0), (0, 0, 2)),
    ),
}


@dataclass(frozen=True, slots=True)
class _Fit:
    """A term that was fitted, the numbers of the crossings that it explains, and on which side of it missions fail."""

    feature: Feature
    explained: tuple[int, ...]
    is_above: bool
    worth: float


class _Sides:
    """Monomials of chosen parameters at both ends of each crossing: a row for each crossing."""

    def __init__(self, crossings: Sequence[Crossing], chosen: Sequence[int], monomials: Sequence[_Powers]) -> None:
        self.crossings = crossings
        self.failing = _values([one.failing for one in crossings], chosen, monomials)
        self.passing = _values([one.passing for one in crossings], chosen, monomials)
        self.middle = (self.failing + self.passing) / 2.0
        self.is_usable = np.isfinite(self.middle).all(axis=1) & np.array([one.axis in chosen for one in crossings])
        rows = self.middle[self.is_usable]
        self.spread = np.ptp(rows, axis=0) if len(rows) else np.ones(len(monomials))

    def explained(self, weights: _Weights) -> tuple[tuple[int, ...], bool]:
        """The most crossings that one edge of the weighted sum explains, and whether missions fail above it."""
        rows = np.flatnonzero(self.is_usable)
        every_fails, every_passes = self.failing[rows] @ np.array(weights), self.passing[rows] @ np.array(weights)
        best: tuple[tuple[int, ...], bool] = ((), True)
        for is_above in (True, False):
            own = (every_fails > every_passes) if is_above else (every_fails < every_passes)
            if int(own.sum()) <= len(best[0]):
                continue
            fails, passes = every_fails[own], every_passes[own]
            low, high = np.minimum(fails, passes), np.maximum(fails, passes)
            near = _SAME * float(np.max(np.abs(low)) + np.max(np.abs(high)))
            meets = (low[None, :] <= low[:, None] + near) & (low[:, None] <= high[None, :] + near)
            group = meets[int(np.argmax(meets.sum(axis=1)))]
            if int(group.sum()) > len(best[0]):
                best = (tuple(rows[own][group].tolist()), is_above)
        return best

    def weights(self, numbers: Sequence[int]) -> _Weights | None:
        """What makes the sum equal at some crossings, the first weight 1; None where nothing does so best."""
        if not (self.spread > 0.0).all():
            return None
        points = self.middle[list(numbers)] / self.spread
        _, singular, rows = np.linalg.svd(np.column_stack([points, -np.ones(len(points))]))
        if len(singular) < points.shape[1] or singular[points.shape[1] - 1] < 1e-9 * singular[0]:
            return None
        normal = rows[-1][:-1]
        if float(np.min(np.abs(normal))) < max(_NEGLIGIBLE * float(np.max(np.abs(normal))), 1e-9):
            return None
        scaled = normal / self.spread
        return tuple((scaled / scaled[0]).tolist())


def best_term(flights: Flights, crossings: Sequence[Crossing], size: int) -> tuple[Literal, list[Crossing]] | None:
    """The term of `size` parameters that explains the most crossings, with these."""
    axes = flights.space.parameters
    sets = list(combinations(range(len(axes)), size))
    plain = [each for each in sets if not any(axes[number].is_redrawn for number in each)]
    chance = np.random.default_rng(len(crossings))
    units = [_unit(number, size) for number in range(size)]
    fits = [_linear_fit(crossings, chosen, flights, units, 0.0, _MOST_FITS, chance) for chosen in sets]
    fits += [_product_fit(crossings, chosen, flights, chance) for chosen in sets]
    best = _best(fits)
    if best is None or len(best.explained) < len(crossings):
        for monomials in _CURVED[size]:
            most = _CURVED_FITS * 2 ** (len(monomials) - 2)
            fits += [_linear_fit(crossings, each, flights, monomials, _PRICE, most, chance) for each in plain]
        best = _best(fits)
    if best is None:
        return None
    explained = [crossings[number] for number in best.explained]
    return _literal(best, explained, flights), explained


def _best(fits: Sequence[_Fit | None]) -> _Fit | None:
    return max((fit for fit in fits if fit is not None), key=lambda fit: fit.worth, default=None)


def _fit(
    feature: Feature, crossings: Sequence[Crossing], group: tuple[int, ...], weights: int, price: float, *, above: bool
) -> _Fit | None:
    """A term that explains a group of crossings; None where that may be chance."""
    if len(group) < weights + _AGREEING or len({crossings[number].axis for number in group}) < 2:
        return None
    return _Fit(feature, group, above, len(group) / (1.0 + price * (weights - 1)))


def _linear_fit(
    crossings: Sequence[Crossing],
    chosen: Sequence[int],
    flights: Flights,
    monomials: Sequence[_Powers],
    price: float,
    most: int,
    chance: np.random.Generator,
) -> _Fit | None:
    """The best weighted sum of monomials, its weights as simple as they may be."""
    sides = _Sides(crossings, chosen, monomials)
    group: tuple[int, ...] = ()
    found: _Weights | None = None
    for subset in _subsets(sides, len(monomials), most, chance):
        weights = sides.weights(subset)
        explained = sides.explained(weights)[0] if weights is not None else ()
        if len(explained) > len(group):
            group, found = explained, weights
    if found is None:
        return None
    own = [one for one in (sides.weights(group), found) if one is not None]
    tried = [(one, *sides.explained(one)) for one in (*_rounded(own), *own)]
    enough = _AS_GOOD * max(len(explained) for _, explained, _ in tried)
    weights, group, is_above = next(one for one in tried if len(one[1]) >= enough)
    names = [flights.space.names[axis] for axis in chosen]
    products = [tuple((name, power) for name, power in zip(names, one, strict=True) if power) for one in monomials]
    feature = _of_extreme(tuple(zip(weights, products, strict=True)), is_above, flights.space.parameters)
    return None if feature is None else _fit(feature, crossings, group, len(monomials), price, above=is_above)


def _rounded(fitted: Sequence[_Weights]) -> list[_Weights]:
    """Simpler weights, the simplest first: whole numbers in a simple ratio, then decimals."""
    found = [_whole([_simple(weight, _SIMPLE) for weight in one]) for one in fitted]
    for level in _DECIMAL:
        for one in fitted:
            spans = [sorted((weight * (1.0 - level), weight * (1.0 + level))) for weight in one]
            found.append(tuple(shortest_decimal(low, high) for low, high in spans))
    return found


def _whole(weights: Sequence[Fraction]) -> _Weights:
    """Weights times the least number that makes all of them whole."""
    scale = math.lcm(*(each.denominator for each in weights))
    divisor = math.gcd(*(int(each * scale) for each in weights))
    return tuple(float(each * scale / divisor) for each in weights)


def _product_fit(
    crossings: Sequence[Crossing], chosen: Sequence[int], flights: Flights, chance: np.random.Generator
) -> _Fit | None:
    """The best product of powers: linear in the logarithms of the sizes, whatever the signs."""
    size = len(chosen)
    plain = _Sides(crossings, chosen, [_unit(number, size) for number in range(size)])
    names = [flights.space.names[axis] for axis in chosen]
    best: _Fit | None = None
    seen: set[_Powers] = set()
    for subset in _subsets(plain, size, _MOST_FITS, chance):
        points = plain.middle[list(subset)]
        powers = _exponents(np.log(np.abs(points))) if (points != 0.0).all() else None
        if powers is None or powers in seen:
            continue
        seen.add(powers)
        group, is_above = _Sides(crossings, chosen, [powers]).explained((1.0,))
        feature = _of_extreme(((1.0, tuple(zip(names, powers, strict=True))),), is_above, flights.space.parameters)
        if feature is not None:
            best = _best([best, _fit(feature, crossings, group, size, 0.0, above=is_above)])
    return best


def _of_extreme(monomials: _Monomials, is_above: bool, axes: Sequence[Range]) -> Feature | None:
    """The feature; where parameters are redrawn of those draws that fail first, None where these differ in kind.

    That is known where values are not below 0; elsewhere it is a guess, which fresh missions refute.
    """
    redrawn = {axis.name for axis in axes if axis.is_redrawn}
    ways = {
        (coefficient * power > 0.0) is is_above
        for coefficient, powers in monomials
        for name, power in powers
        if name in redrawn
    }
    if len(ways) > 1:
        return None
    extreme = Extreme.ONLY if not ways else Extreme.GREATEST if ways.pop() else Extreme.LEAST
    return Feature(monomials, extreme)


def _exponents(logarithms: NDArray[np.float64]) -> _Powers | None:
    """Whole powers of a product that is the same at some points; None where they are large."""
    _, singular, rows = np.linalg.svd(np.column_stack([logarithms, -np.ones(len(logarithms))]))
    normal = rows[-1][:-1]
    largest = float(np.max(np.abs(normal)))
    if singular[-1] < 1e-9 * singular[0] or float(np.min(np.abs(normal))) < max(0.01 * largest, 1e-9):
        return None
    simple = [_simple(float(each / normal[0]), _SIMPLE) for each in normal]
    scale = math.lcm(*(each.denominator for each in simple))
    whole = [int(each * scale) for each in simple]
    divisor = math.gcd(*whole)
    powers = tuple(each // divisor for each in whole)
    return powers if max(map(abs, powers)) <= _LARGEST_POWER else None


def _subsets(sides: _Sides, size: int, most: int, chance: np.random.Generator) -> list[tuple[int, ...]]:
    """Some crossings at a time, by number: all choices where they are few."""
    rows = np.flatnonzero(sides.is_usable)
    if math.comb(len(rows), size) <= most:
        return [tuple(int(rows[number]) for number in each) for each in combinations(range(len(rows)), size)]
    drawn = [chance.choice(rows, size, replace=False) for _ in range(most)]
    return [tuple(each.tolist()) for each in drawn]


def _values(points: Sequence[Point], chosen: Sequence[int], monomials: Sequence[_Powers]) -> NDArray[np.float64]:
    """Each monomial at each point; nan where it has no value."""
    own = np.array([[point[axis] for axis in chosen] for point in points], dtype=float).reshape(-1, 1, len(chosen))
    powers = np.array(monomials, dtype=float)[None, :, :]
    with np.errstate(divide="ignore", invalid="ignore"):
        found: NDArray[np.float64] = np.where(powers == 0.0, 1.0, own**powers).prod(axis=2)
    found[~np.isfinite(found)] = np.nan
    return found


def _unit(number: int, size: int) -> _Powers:
    return tuple(int(number == other) for other in range(size))


def _simple(value: float, rounding: float) -> Fraction:
    near = abs(value) * rounding
    return simplest_between(Fraction(value - near), Fraction(value + near))


def _literal(fit: _Fit, explained: Sequence[Crossing], flights: Flights) -> Literal:
    """The edge of a term, between failing and passing at all crossings that it explains."""
    row, feature = flights.space.as_row, fit.feature
    ends = [sorted((feature.value(row(one.failing)), feature.value(row(one.passing)))) for one in explained]
    low, high = max(end[0] for end in ends), min(end[1] for end in ends)
    if all(axis.is_stepped() for axis in flights.space.parameters if axis.name in feature.parameters):
        return Literal(feature, fit.is_above, high if fit.is_above else low, holds_at_edge=True)
    values = [value for point in flights.known if not math.isnan(value := feature.value(row(point)))]
    slack = _SLACK * FINE * (max(values) - min(values))
    return Literal(feature, fit.is_above, shortest_decimal(low - slack, high + slack))
