"""Profiles: the level of each resource over time, each of its uses as early as it can be."""

from dataclasses import dataclass
from math import inf

from runtime.constraints.domains.tags import HALF_INF
from runtime.plan.database import PlanDatabase
from runtime.plan.tags import INITIAL, LIMITS, MAXIMUM, MINIMUM


@dataclass(frozen=True, slots=True)
class LevelProfile:
    """Level of a resource: its limits (inf: none), and from each instant on the two numbers that it lies between."""

    lower: float
    upper: float
    steps: tuple[tuple[int, float, float], ...]  # the first one is how it begins

    def as_data(self) -> dict[str, object]:
        """The same for programs; null where there is no limit."""
        limits = [None if abs(each) == inf else each for each in (self.lower, self.upper)]
        return {"limits": limits, "steps": [list(step) for step in self.steps]}


def level_profiles(database: PlanDatabase, begin: int) -> dict[str, LevelProfile]:
    """The profiles of all resources by name, from `begin` or from the first use on."""
    resources = database.plan.resources
    return {
        name: _profile(database, o, begin)
        for o, name in enumerate(database.objects.names)
        if o < len(resources.is_resource) and resources.is_resource[o]
    }


def _profile(database: PlanDatabase, o: int, begin: int) -> LevelProfile:
    resources = database.plan.resources
    row = o * LIMITS
    low, high = resources.lower(row + INITIAL, 0.0), resources.upper(row + INITIAL, 0.0)
    changes: dict[int, tuple[float, float]] = {}

    def change(at: int, least: float, most: float) -> None:
        if abs(at) < HALF_INF:
            before = changes.get(at, (0.0, 0.0))
            changes[at] = (before[0] + least, before[1] + most)

    for u in range(resources.count):
        if resources.sign[u] and resources.on[u] == o:
            least, most = resources.least[u], resources.most[u]
            added = (least, most) if resources.sign[u] > 0 else (-most, -least)
            change(resources.start_low[u], *added)
            if resources.end[u] >= 0:
                change(resources.end_low[u], -added[0], -added[1])
    before = (low, high)
    for start, least, most in resources.steps.get(o, ()):
        change(start, least - before[0], most - before[1])
        before = (least, most)
    steps = [(min([begin, *changes]), low, high)]
    for at in sorted(changes):
        low, high = low + changes[at][0], high + changes[at][1]
        if at == steps[-1][0]:
            steps.pop()
        steps.append((at, low, high))
    return LevelProfile(resources.lower(row + MINIMUM, -inf), resources.upper(row + MAXIMUM, inf), tuple(steps))
