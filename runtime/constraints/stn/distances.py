"""Ask the temporal network whether one more edge would hold, without adding it."""

from runtime.constraints.domains.arrays import blank, grow_rows
from runtime.constraints.domains.store import Store
from runtime.constraints.stn.heap import Heap
from runtime.constraints.stn.network import is_followed


class Distances:
    """A bounded search for the shortest path (Dijkstra, upper bounds as potentials: at the fixpoint they are valid)."""

    def __init__(self, engine: Store, temporal_only: bool) -> None:
        self.engine = engine
        self.temporal_only = temporal_only
        self.heap = Heap()
        self.stamp = 0
        self.stamped = blank(64)
        self.distance = blank(64)
        self.via = blank(64)
        self.by_bounds = False

    def admits(self, source: int, target: int, weight: int) -> bool:
        """Whether `target - source <= weight` is possible: no path of edges back from `target` says otherwise.

        After a refusal `by_bounds` tells whether the bounds said so, else `via` leads from `source` back on the path.
        Such a path has a length below `-weight`. In reduced lengths that is a search within a limit, which mostly is
        empty at once; lower bounds, potentials as well, may tell without it.
        """
        engine = self.engine
        self.by_bounds = engine.lb[target] > engine.ub[source] + weight
        if self.by_bounds:
            return False
        limit = engine.ub[target] - engine.ub[source] - weight
        if limit <= 0 or engine.lb[target] <= engine.lb[source] + weight or source == target:
            return source != target or weight >= 0
        if len(self.stamped) < len(engine.kind):
            grow_rows(self, "stamped distance via", len(engine.kind))
        self.stamp += 1
        heap = self.heap
        heap.clear()
        heap.push(0, 0, target)
        self.stamped[target] = self.stamp
        self.distance[target] = 0
        while heap.length:
            v = heap.top_item()
            length = heap.top_key()
            heap.pop()
            if length > self.distance[v]:
                continue
            if v == source:
                return False
            e = engine.out_head[v]
            while e >= 0:
                u = engine.edge_target[e]
                longer = length + engine.edge_weight[e] + engine.ub[v] - engine.ub[u]
                is_shorter = longer < limit and (self.stamped[u] != self.stamp or longer < self.distance[u])
                if is_shorter and is_followed(engine, e, self.temporal_only):
                    self.stamped[u] = self.stamp
                    self.distance[u] = longer
                    self.via[u] = e
                    heap.push(longer, 0, u)
                e = engine.out_next[e]
        return True
