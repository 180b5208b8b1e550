"""Restarts, and variable order by dom/wdeg (Boussemart, Hemery, Lecoutre, Sais 2004).

The first run orders by domain size only, so that a search with few failures keeps its order; then every second run
uses weights, since they may mislead. Runs grow geometrically, so that either order comes to an end.
"""

from array import array

from runtime.constraints.domains.arrays import grow_rows
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import SUPPORT_CONSTRAINT, SUPPORT_EDGE
from runtime.solver.tags import FEW_FAILURES, LARGEST_SIZE, WEIGHT_SCALE


class Restarts:
    """A failure weight per variable id, and the length of the runs. Ids are mostly equal on other branches."""

    def __init__(self, engine: Store) -> None:
        self.engine = engine
        self.weight = array("q", [1]) * 64
        self.failures = 0  # since the last restart
        self.limit = FEW_FAILURES  # of failures, for a restart
        self.count = 0

    def clear(self) -> None:
        """Forget all weights, if there are any: the plan was changed from outside."""
        if self.failures or self.count:
            for v in range(len(self.weight)):
                self.weight[v] = 1
            self.failures = self.count = 0
            self.limit = FEW_FAILURES

    def rank(self, v: int, size: int) -> int:
        """Sort key of variables: size over weight, or the size alone in every other run."""
        if not self.count & 1:
            return size
        weight = self.weight[v] if v < len(self.weight) else 1
        return min(size, LARGEST_SIZE) * WEIGHT_SCALE // weight

    def _add(self, v: int) -> None:
        """Increase the weight of a variable."""
        if v >= len(self.weight):
            grow_rows(self, "weight", 2 * v, 1)
        self.weight[v] += 1

    def note_failure(self) -> int:
        """Increase the weights of the variables of the constraint in conflict."""
        engine = self.engine
        self.failures += 1
        kind = engine.conflict_support & 3
        support = engine.conflict_support >> 2
        if engine.conflict_support < 0:
            return 0
        if kind == SUPPORT_CONSTRAINT:
            for k in range(engine.first[support], engine.first[support] + engine.arity[support]):
                self._add(engine.slot_variable[k])
        elif kind == SUPPORT_EDGE:
            self._add(engine.edge_source[support])
            self._add(engine.edge_target[support])
        elif engine.conflict_variable >= 0:
            self._add(engine.conflict_variable)
        return 0

    def restart(self) -> None:
        """Begin the next run, half as long again."""
        self.failures = 0
        self.limit += self.limit // 2
        self.count += 1
