"""Relief: whether something that is still open may give to a resource, or take from it, before the plan is complete.

EUROPA calls a level out of bounds by what is charged already. A search that says "no plan exists" must not: a token
that is not in the plan yet may bring what is missing, by its rules. Levels are judged when nothing of the kind is open.
"""

from runtime.constraints.propagators.opcodes import OP_EXTERNAL
from runtime.plan.database import PlanDatabase
from runtime.plan.resources.violation import Violation
from runtime.plan.store.plan import Plan
from runtime.plan.tags import (
    BRANCH_WAITING,
    HEAD_OPEN,
    LIST_OPEN,
    LISTS,
    RESOURCE_CONSUMES,
    RESOURCE_PRODUCES,
    TOO_HIGH,
    TOO_LOW,
)
from runtime.solver.flaws.filters import PlanningScope
from runtime.solver.flaws.supports import Supports


class Relief:
    """What may still change the level of reservoirs. `waiting` tells how many guards have not fired."""

    def __init__(self, plan: Plan, supports: Supports) -> None:
        self.plan = plan
        kinds = range(len(supports.reach))
        self.classes = {
            int(plan.predicate_class[p])
            for p in kinds
            if plan.predicate_resource[p] in (RESOURCE_PRODUCES, RESOURCE_CONSUMES)
        }
        # By sign: what a token of each predicate leads to, as whether that helps; and whether a guard may.
        self.brings: dict[int, list[bool]] = {}
        self.is_guarded: dict[int, bool] = {}
        for sign, kind in ((1, RESOURCE_PRODUCES), (-1, RESOURCE_CONSUMES)):
            helpers = [p for p in kinds if plan.predicate_resource[p] == kind]
            # Itself, too: a use that a repair has taken back is open.
            self.brings[sign] = [any(supports.leads_to(p, h) for h in helpers) for p in kinds]
            self.is_guarded[sign] = any(supports.is_guarded(h) for h in helpers)
        self.waiting = 0
        self.within: PlanningScope | None = None  # what alone is decided now, where no plan is made

    @property
    def is_possible(self) -> bool:
        """Whether any token or guard of the model could ever bring relief."""
        return any(any(row) for row in self.brings.values()) or any(self.is_guarded.values())

    def count_guards(self) -> None:
        """Count the guards that have not fired, where no search counts them."""
        rows, scopes = self.plan.rows, range(self.plan.rows.scope_count if any(self.is_guarded.values()) else 0)
        self.waiting = sum(rows.scope_watch[s] >= 0 and rows.scope_branch[s] == BRANCH_WAITING for s in scopes)

    def may_come(self, o: int, sign: int) -> bool:
        """Whether something open may give to resource `o` (sign 1), or take from it (-1)."""
        plan = self.plan
        if plan.object_class[o] not in self.classes:
            return False
        if self.is_guarded[sign] and self.waiting > 0:
            return True
        rows = plan.rows
        brings = self.brings[sign]
        t = rows.head_first[HEAD_OPEN]
        while t >= 0:
            if brings[rows.predicate[t]] and (self.within is None or self.within.admits_token(t)):
                return True
            t = rows.link_after[LISTS * t + LIST_OPEN]
        uses = plan.resources
        for u in range(uses.count):
            if uses.sign[u] == sign and uses.end[u] < 0 and uses.on[u] != o:
                holder = uses.holder[u]
                if not plan.engine.is_singleton(holder) and plan.engine.contains(holder, o):
                    return True
        return False


def may_be_relieved(database: PlanDatabase) -> bool:
    """Whether a plan is inconsistent only in that a level is out of bounds now, which may not last."""
    engine = database.engine
    c = engine.conflict_support >> 2
    if engine.consistent or c < 0 or engine.conflict_variable >= 0 or engine.op[c] != OP_EXTERNAL:
        return False
    violation = engine.externals[c]
    if not isinstance(violation, Violation) or violation.wrong not in (TOO_LOW, TOO_HIGH):
        return False
    relief = Relief(database.plan, Supports(database.program))
    relief.waiting = 1  # nobody has counted
    return relief.may_come(violation.resource, 1 if violation.wrong == TOO_LOW else -1)
