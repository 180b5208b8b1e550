"""Limits of the search that a model gives: an object that is a PlannerConfig."""

from dataclasses import dataclass

from compiler.program import ClassCode
from runtime.constraints.domains.tags import HALF_INF
from runtime.plan.database import PlanDatabase

_MEMBERS = ("m_horizonStart", "m_horizonEnd", "m_maxPlannerSteps", "m_maxPlannerDepth")
_UNLIMITED = 2**62


@dataclass(frozen=True, slots=True)
class Limits:
    """From when to when is planned, and how long the search may be."""

    start: int
    end: int
    steps: int = _UNLIMITED
    depth: int = _UNLIMITED


def model_limits(database: PlanDatabase) -> Limits | None:
    """The limits of the first object of class PlannerConfig whose horizon is known; None if there is none."""
    plan = database.plan
    classes = {each.name: each for each in database.program.classes}
    for o in range(len(database.objects.names)):
        owner = database.program.classes[plan.object_class[o]]
        if not _is_configuration(owner, classes):
            continue
        numbers = {member.name: number for number, member in enumerate(owner.members)}
        values = []
        for name in _MEMBERS:
            v = plan.object_var0[o] + numbers[name] if name in numbers else -1
            value = _UNLIMITED
            if v >= 0 and plan.engine.lb[v] == plan.engine.ub[v] and plan.engine.ub[v] < HALF_INF:
                value = plan.engine.lb[v]
            values.append(value)
        if _UNLIMITED not in values[:2]:
            return Limits(*values)
    return None


def _is_configuration(owner: ClassCode, classes: dict[str, ClassCode]) -> bool:
    """Whether a class is PlannerConfig or extends it."""
    name: str | None = owner.name
    while name is not None and name != "PlannerConfig":
        name = classes[name].base if name in classes else None
    return name is not None
