"""DistanceReader between times: what demands say of them, with the sums of named constants and locals worked out."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import ceil, floor
from typing import TypeVar

from checker.proofs.claims import Number
from checker.proofs.demands import Demand
from checker.proofs.operands import name_of
from checker.proofs.solving import fraction

POINTS = (".start", ".end")
_LENGTH = ".duration"
_ORDERS = {"leq": 0, "precedes": 0, "lt": 1, "strictlyPrecedes": 1}  # how much later the second is, at least


@dataclass(frozen=True, slots=True)
class TimeDistance:
    """`lower <= b - a <= upper` in ticks, None for no bound; `a` and `b` are points of a network, 0 its beginning."""

    a: int
    b: int
    lower: int | None
    upper: int | None
    demand: Demand


@dataclass(slots=True)
class _Sum:
    """A constant and variables, each with its factor; variables that are not known are names."""

    constant: Fraction = Fraction(0)
    points: dict[int, Fraction] = field(default_factory=dict)
    unknown: dict[str, Fraction] = field(default_factory=dict)

    def add(self, other: "_Sum", factor: Fraction | int = 1) -> "_Sum":
        """This and `factor` times the other."""
        return _Sum(
            self.constant + factor * other.constant,
            _added(self.points, other.points, factor),
            _added(self.unknown, other.unknown, factor),
        )

    @property
    def is_known(self) -> bool:
        return not self.points and not self.unknown


_Name = TypeVar("_Name", int, str)


def _added(
    one: Mapping[_Name, Fraction], other: Mapping[_Name, Fraction], factor: Fraction | int
) -> dict[_Name, Fraction]:
    found = dict(one)
    for name, times in other.items():
        found[name] = found.get(name, Fraction(0)) + factor * times
    return {name: times for name, times in found.items() if times}


class DistanceReader:
    """Reads demands on the times of one reactor's plan; `left_out` counts those that are no distances.

    `points` are its times by name, `value` gives the value of a variable that is the same for all values of the
    sampled parameters.
    """

    def __init__(
        self,
        points: dict[str, int],
        value: Callable[[str], Fraction | None],
        optional: Collection[str],
    ) -> None:
        self.points, self.value = points, value
        self.optional = optional  # tokens that fill the ticks a request took, and need not have been there
        self.left_out = 0
        self._solved: dict[str, _Sum] = {}
        self._same: dict[int, int] = {}

    def read(self, demands: Sequence[Demand]) -> list[TimeDistance]:
        """What they demand of distances between times."""
        used = self._solve(demands)
        found: list[TimeDistance] = []
        left: list[_Sum] = []
        for demand in demands:
            if demand in used or not any(self._speaks(each) for each in demand.numbers):
                continue
            parts = list(self._parts(demand))
            self.left_out += not parts
            for each, lower, upper in parts:
                distance = self._distance(each, lower, upper, demand)
                if distance is not None:
                    found.append(distance)
                    if distance.lower == distance.upper == 0:
                        self._same[self._first(distance.b)] = self._first(distance.a)
                elif not each.is_known:
                    left.append(each)
        self.left_out += sum(not self._merged(each).is_known for each in left)
        return found

    def _solve(self, demands: Sequence[Demand]) -> set[Demand]:
        """Work out variables that are sums of others; the demands that say so."""
        used: set[Demand] = set()
        grows = True
        while grows:
            grows = False
            for demand in demands:
                if demand in used:
                    continue
                for numbers in self._equalities(demand):
                    form = self._total(numbers)
                    if len(form.unknown) == 1:
                        (name, factor), *_ = form.unknown.items()
                        self._solved[name] = _Sum().add(_Sum(form.constant, form.points), -1 / factor)
                        used.add(demand)
                        grows = True
        return used

    def _equalities(self, demand: Demand) -> Iterator[list[tuple[Number, Fraction | int]]]:
        """The sum that is zero by a demand: its numbers, each with its factor."""
        n = demand.numbers
        match demand.name:
            case "addEq":
                yield [(n[0], 1), (n[1], 1), (n[2], -1)]
            case "eqSum":
                yield [(n[0], 1), *((each, -1) for each in n[1:])]
            case "neg":
                yield [(n[0], 1), (n[1], 1)]
            case "temporalDistance":
                yield [(n[2], 1), (n[0], -1), (n[1], -1)]
            case "eq" | "concurrent" if len(n) == 2:
                yield [(n[0], 1), (n[1], -1)]
            case "mulEq" | "eqProduct" if len(n) == 3:
                one, other, result = n if demand.name == "mulEq" else (*n[1:], n[0])
                for factor, each in ((one, other), (other, one)):
                    known = self._term(factor)
                    if known.is_known:
                        yield [(each, known.constant), (result, -1)]
                        return

    def _parts(self, demand: Demand) -> Iterator[tuple[_Sum, Fraction | int | None, Fraction | int | None]]:
        """Sums of points with their bounds; none where the demand is of another kind."""
        n = demand.numbers
        if demand.name == "gap":
            lower, upper = (None if each is None else each.as_long() for each in n[2:4])
            if lower is not None and name_of(n[0]).removesuffix(POINTS[0]) in self.optional:
                lower = min(lower, 0)
            yield self._total([(n[1], 1), (n[0], -1)]), lower, upper
        elif demand.name in _ORDERS and len(n) == 2:
            yield self._total([(n[1], 1), (n[0], -1)]), _ORDERS[demand.name], None
        else:
            for numbers in self._equalities(demand):
                yield self._total(numbers), 0, 0

    def _distance(
        self, form: _Sum, lower: Fraction | int | None, upper: Fraction | int | None, demand: Demand
    ) -> TimeDistance | None:
        """`lower <= form <= upper` as a distance; None where it is none."""
        if form.unknown or len(form.points) not in (1, 2):
            return None
        (b, factor), *rest = sorted(form.points.items(), key=lambda one: -one[1])
        a = rest[0][0] if rest else 0
        if rest and rest[0][1] != -factor:
            return None
        ends = [None if end is None else (end - form.constant) / factor for end in (lower, upper)]
        low, high = ends if factor > 0 else reversed(ends)
        return TimeDistance(a, b, None if low is None else ceil(low), None if high is None else floor(high), demand)

    def _merged(self, form: _Sum) -> _Sum:
        """The sum with each of the points that are one replaced by the first of them."""
        found = _Sum(form.constant, {}, form.unknown)
        for point, factor in form.points.items():
            found = found.add(_Sum(points={self._first(point): factor}))
        return found

    def _first(self, point: int) -> int:
        while point in self._same and self._same[point] != point:
            point = self._same[point]
        return point

    def _total(self, numbers: Sequence[tuple[Number, Fraction | int]]) -> _Sum:
        total = _Sum()
        for each, factor in numbers:
            total = total.add(self._term(each), factor)
        return total

    def _term(self, number: Number) -> _Sum:
        """A number as a sum: a time, a duration as the distance of two, a value, or a variable worked out before."""
        name = name_of(number)
        if not name:
            known = fraction(number)
            return _Sum(unknown={str(number): Fraction(1)}) if known is None else _Sum(known)
        if name in self.points:
            return _Sum(points={self.points[name]: Fraction(1)})
        if name.endswith(_LENGTH):
            start, end = (self.points.get(name.removesuffix(_LENGTH) + each) for each in POINTS)
            if start is not None and end is not None:
                return _Sum(points={end: Fraction(1), start: Fraction(-1)})
        known = None if name.endswith((*POINTS, _LENGTH)) else self.value(name)
        if known is not None:
            return _Sum(known)
        solved = self._solved.get(name)
        return _Sum(unknown={name: Fraction(1)}) if solved is None else solved

    def _speaks(self, number: Number) -> bool:
        """Whether a number is a time or a duration, or worked out of such."""
        return number is not None and bool(self._term(number).points)
