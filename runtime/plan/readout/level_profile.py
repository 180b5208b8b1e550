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


class _Level:
    """A sum of amounts, some of them infinite, that can be taken back."""

    def __init__(self) -> None:
        self._finite, self._infinite = 0.0, 0.0

    def add(self, amount: float) -> None:
        if isinf(amount):
            self._infinite += copysign(1.0, amount)
        else:
            self._finite += amount

    def value(self) -> float:
        return copysign(inf, self._infinite) if self._infinite else self._finite


def _profile(database: PlanDatabase, o: int, begin: int) -> LevelProfile:
    resources = database.plan.resources
    row = o * LIMITS
    low, high = _Level(), _Level()
    before = (resources.lower(row + INITIAL, 0.0), resources.upper(row + INITIAL, 0.0))
    low.add(before[0])
    high.add(before[1])
    changes: dict[int, list[tuple[float, float]]] = {}

    def change(at: int, least: float, most: float) -> None:
        if abs(at) < HALF_INF:
            changes.setdefault(at, []).append((least, most))

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
        for least, most in changes[at]:
            low.add(least)
            high.add(most)
        if at == steps[-1][0]:
            steps.pop()
        steps.append((at, low.value(), high.value()))
    return LevelProfile(resources.lower(row + MINIMUM, -inf), resources.upper(row + MAXIMUM, inf), tuple(steps))
