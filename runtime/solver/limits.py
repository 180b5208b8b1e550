"""Find the horizon and the limits that a model gives its planner: an object of class PlannerConfig."""

from dataclasses import dataclass

from runtime.constraints.codes import HALF_INF
from runtime.plan.database import PlanDatabase

MEMBERS = ("m_horizonStart", "m_horizonEnd", "m_maxPlannerSteps", "m_maxPlannerDepth")
UNLIMITED = 2**62


@dataclass(frozen=True, slots=True)
class Limits:
    """From when to when is planned, and how long the search may be."""

    start: int
    end: int
    steps: int = UNLIMITED
    depth: int = UNLIMITED


def model_limits(database: PlanDatabase) -> Limits | None:
    """What the first object of class PlannerConfig says, where all that it says is known; None if there is none."""
    plan = database.plan
    for o in range(len(database.objects.names)):
        owner = database.program.classes[plan.object_class[o]]
        if owner.name != "PlannerConfig":
            continue
        places = {member.name: place for place, member in enumerate(owner.members)}
        values = []
        for name in MEMBERS:
            v = plan.object_var0[o] + places[name] if name in places else -1
            value = UNLIMITED
            if v >= 0 and plan.engine.lb[v] == plan.engine.ub[v] and plan.engine.ub[v] < HALF_INF:
                value = plan.engine.lb[v]
            values.append(value)
        if UNLIMITED not in values[:2]:
            return Limits(*values)
    return None
