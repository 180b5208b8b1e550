"""Profiles: the level of each resource over time, each of its uses as early as it can be."""

from dataclasses import dataclass
from math import copysign, inf, isinf

from runtime.constraints.domains.tags import HALF_INF
from runtime.plan.database import PlanDatabase
from runtime.plan.readout.state import bound_data
from runtime.plan.tags import INITIAL, LIMITS, MAXIMUM, MINIMUM


@dataclass(frozen=True, slots=True)
class LevelProfile:
    """Level of a resource: its limits (inf: none), and from each instant on the two numbers that it lies between."""

    lower: float
    upper: float
    steps: tuple[tuple[int, float, float], ...]  # the first one is how it begins

    def as_data(self) -> dict[str, object]:
        """The same for programs; null where there is no limit, infinite levels as texts."""
        limits = [None if isinf(each) else each for each in (self.lower, self.upper)]
        return {"limits": limits, "steps": [[at, bound_data(low), bound_data(high)] for at, low, high in self.steps]}


def level_profiles(database: PlanDatabase, begin: int) -> dict[str, LevelProfile]:
    """The profiles of all resources by name, from `begin` or from the first use on."""
    resources = database.plan.resources
    return {
        name: _profile(database, o, begin)
        for o, name in enumerate(database.objects.names)
        if o < len(resources.is_resource) and resources.is_resource[o]
    }


@dataclass(frozen=True, slots=True)
class _Amount:
    """A sum of numbers; infinite ones are counted, those below zero negatively, so that they can be taken back."""

    finite: float = 0.0
    infinite: int = 0

    def plus(self, number: float) -> "_Amount":
        if isinf(number):
            return _Amount(self.finite, self.infinite + (1 if number > 0.0 else -1))
        return _Amount(self.finite + number, self.infinite)

    def and_also(self, other: "_Amount") -> "_Amount":
        return _Amount(self.finite + other.finite, self.infinite + other.infinite)

    def value(self) -> float:
        return copysign(inf, self.infinite) if self.infinite else self.finite


def _profile(database: PlanDatabase, o: int, begin: int) -> LevelProfile:
    resources = database.plan.resources
    row = o * LIMITS
    before = (resources.lower(row + INITIAL, 0.0), resources.upper(row + INITIAL, 0.0))
    low, high = _Amount().plus(before[0]), _Amount().plus(before[1])
    changes: dict[int, tuple[_Amount, _Amount]] = {}

    def change(at: int, least: float, most: float) -> None:
        if abs(at) < HALF_INF:
            lower, upper = changes.get(at, (_Amount(), _Amount()))
            changes[at] = (lower.plus(least), upper.plus(most))

    for u in range(resources.count):
        if resources.sign[u] and resources.on[u] == o:
            least, most = resources.least[u], resources.most[u]
            added = (least, most) if resources.sign[u] > 0 else (-most, -least)
            change(resources.start_low[u], *added)
            if resources.end[u] >= 0:
                change(resources.end_low[u], -added[0], -added[1])
    for start, least, most in resources.steps.get(o, ()):
        change(start, least - before[0], most - before[1])
        before = (least, most)
    steps = [(min([begin, *changes]), low.value(), high.value())]
    for at in sorted(changes):
        low, high = low.and_also(changes[at][0]), high.and_also(changes[at][1])
        if at == steps[-1][0]:
            steps.pop()
        steps.append((at, low.value(), high.value()))
    return LevelProfile(resources.lower(row + MINIMUM, -inf), resources.upper(row + MAXIMUM, inf), tuple(steps))
