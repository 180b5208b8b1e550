"""Weigh variables by the conflicts that they take part in, and say when to begin a search anew with what they tell.

Among variables of equal priority those come first that have few values and were in the way often ("dom/wdeg",
Boussemart, Hemery, Lecoutre, Sais 2004). The first run knows no weights, so that a search which fails little keeps its
order; of the others every second one, since weights may mislead. Runs grow, so that either order comes to an end.
"""

from array import array

from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import SUPPORT_CONSTRAINT, SUPPORT_EDGE
from runtime.solver.tags import FEW_FAILURES, LARGEST_SIZE, WEIGHT_SCALE
from runtime.solver.widening import widened


class Weights:
    """A weight by the id of each variable; one that is made again on another branch mostly has the same id."""

    def __init__(self, engine: Store) -> None:
        self.engine = engine
        self.clear()

    def clear(self) -> None:
        """Forget everything, for the plan has changed from outside."""
        self.weight = array("q", [1]) * 64
        self.failures = 0  # since the last restart
        self.limit = FEW_FAILURES
        self.restarts = 0

    def rank(self, v: int, size: int) -> int:
        """What sorts variables, smaller first: size over weight, or the size alone in every other run."""
        if not self.restarts & 1:
            return size
        weight = self.weight[v] if v < len(self.weight) else 1
        return min(size, LARGEST_SIZE) * WEIGHT_SCALE // weight

    def add(self, v: int) -> int:
        """Make a variable heavier."""
        if v >= len(self.weight):
            self.weight = widened(self.weight, 2 * v, 1)
        self.weight[v] += 1
        return 0

    def note_failure(self) -> int:
        """A variable's choice has failed: whatever the constraint is about that refused it weighs more from now on."""
        engine = self.engine
        self.failures += 1
        kind = engine.conflict_support & 3
        support = engine.conflict_support >> 2
        if engine.conflict_support < 0:
            return 0
        if kind == SUPPORT_CONSTRAINT:
            for k in range(engine.first[support], engine.first[support] + engine.arity[support]):
                self.add(engine.slot_variable[k])
        elif kind == SUPPORT_EDGE:
            self.add(engine.edge_source[support])
            self.add(engine.edge_target[support])
        elif engine.conflict_variable >= 0:
            self.add(engine.conflict_variable)
        return 0

    def is_due(self) -> bool:
        """Whether enough has failed to begin anew."""
        return self.failures >= self.limit

    def begin_anew(self) -> int:
        """Have the next run last half as long again: some run is long enough to end by itself."""
        self.failures = 0
        self.limit += self.limit // 2
        self.restarts += 1
        return 0
