"""Limits of the search that a model gives: an object that is a PlannerConfig."""

from dataclasses import dataclass

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
    classes = database.program.classes
    for o in range(len(database.objects.names)):
        if all(classes[c].name != "PlannerConfig" for c in database.prototypes.ancestry(plan.object_class[o])):
            continue
        numbers = {member.name: number for number, member in enumerate(classes[plan.object_class[o]].members)}
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
