"""Resource flaws: the first instant where uses might exceed a resource, and precedences between two uses.

A use with an end takes at its start and gives at its end; a reservoir's event does one of the two. A taker is put after
a giver (or the other way round, where the level is too high): precedences are pairs of timepoints.
"""

from math import inf

from runtime.constraints.domains.arrays import blank, lengthen
from runtime.constraints.domains.tags import FLOAT_TOLERANCE
from runtime.constraints.stn.distances import Distances
from runtime.constraints.stn.heap import Heap
from runtime.plan.lifecycle import fire
from runtime.plan.resources.envelope import Envelope
from runtime.plan.store.plan import Plan
from runtime.plan.tags import INITIAL, LIMITS, MAXIMUM, MINIMUM
from runtime.solver.tags import NONE


class Uses:
    """The timepoints of one resource at a time, over arrays that are used again."""

    def __init__(self, plan: Plan, distances: Distances) -> None:
        self.plan = plan
        self.engine = plan.engine
        self.resources = plan.resources
        self.distances = distances
        self.envelope = Envelope(plan.engine, plan.resources)
        self.events = Heap()
        self.found_at = 0
        self.found_low = 0
        self.found_amount = 0.0
        # The timepoints of one resource: when something is taken (1) or given (0), and whose it is.
        self.count = 0
        self.point = blank(64)
        self.takes = blank(64)
        self.amount_least = blank(64, "d")
        self.amount_most = blank(64, "d")

    def gather(self, o: int) -> int:
        """Collect the timepoints at which resource `o` is used."""
        uses = self.resources
        self.count = 0
        for u in range(uses.count):
            if uses.sign[u] != 0 and uses.on[u] == o:
                self.add(uses.start[u], 1 if uses.sign[u] < 0 else 0, uses.least[u], uses.most[u])
                if uses.end[u] >= 0:
                    self.add(uses.end[u], 0, uses.least[u], uses.most[u])
        return self.count

    def add(self, point: int, takes: int, least: float, most: float) -> None:
        """Collect one timepoint."""
        at = self.count
        if at == len(self.point):
            lengthen(self, "point takes amount_least amount_most")
        self.point[at] = point
        self.takes[at] = takes
        self.amount_least[at] = least
        self.amount_most[at] = most
        self.count = at + 1

    # ---- flaws ----

    def find_flaw(self, o: int, is_worst: bool) -> bool:
        """The first instant at which resource `o` might be exceeded; of a grounded one, if asked, the worst instant."""
        if self.resources.is_grounded(o):
            return self._sweep(o, is_worst)
        if not self.envelope.find(o):
            return False
        self.found_at = self.envelope.at
        self.found_low = self.envelope.is_low
        self.found_amount = self.envelope.amount
        return True

    def _sweep(self, o: int, is_worst: bool) -> bool:
        """Sweep over the grounded profile for the first instant out of bounds, or for the first of the worst."""
        engine = self.engine
        events = self.events
        events.clear()
        self.gather(o)
        for k in range(self.count):
            events.push(engine.lb[self.point[k]], k, k)
        for k, step in enumerate(self.resources.steps.get(o, ())):
            events.push(step[0], self.count + k, -k - 1)
        low = self.resources.lower(o * LIMITS + INITIAL, 0.0)
        high = self.resources.upper(o * LIMITS + INITIAL, 0.0)
        minimum = self.resources.lower(o * LIMITS + MINIMUM, -inf)
        maximum = self.resources.upper(o * LIMITS + MAXIMUM, inf)
        capacity_low = low
        capacity_high = high
        self.found_amount = 0.0
        while events.length:
            time = events.top_key()
            while events.length and events.top_key() == time:
                k = events.top_item()
                events.pop()
                if k < 0:
                    _, lower, upper = self.resources.steps[o][-k - 1]
                    low += lower - capacity_low
                    high += upper - capacity_high
                    capacity_low = lower
                    capacity_high = upper
                elif self.takes[k]:
                    low -= self.amount_most[k]
                    high -= self.amount_least[k]
                else:
                    low += self.amount_least[k]
                    high += self.amount_most[k]
            amount = max(minimum - low, high - maximum)
            if amount > FLOAT_TOLERANCE and amount > self.found_amount + FLOAT_TOLERANCE:
                self.found_at = time
                self.found_low = 1 if minimum - low >= high - maximum else 0
                self.found_amount = amount
                if not is_worst:
                    return True
        return self.found_amount > 0.0

    # ---- precedences ----

    def may_order(self, o: int, first: int, second: int) -> bool:
        """Whether one timepoint of `o` may be put before another: neither impossible nor known already."""
        engine = self.engine
        if first == second or engine.lb[first] > engine.ub[second] or engine.ub[first] <= engine.lb[second]:
            return False
        if not self.distances.admits(second, first, 0):
            return False
        is_plain = self.resources.is_grounded(o)
        return self.distances.admits(first, second, -1) or not (is_plain or self._is_seen(first, second))

    def _is_seen(self, first: int, second: int) -> bool:
        """Whether the envelope sees a precedence of the network: it follows no edges with a positive weight."""
        v = first
        while v != second and self.engine.edge_weight[self.distances.via[v]] <= 0:
            v = self.engine.edge_source[self.distances.via[v]]
        if v == second:
            return True
        self.envelope.make_room(0)
        self.envelope.walk_back(second)
        return self.envelope.marks[first] == self.envelope.mark

    def order(self, first: int, second: int, together: int) -> bool:
        """Post that one timepoint precedes another, or that both coincide."""
        if not self.engine.add_edge(second, first, 0, NONE, NONE):
            return False
        if together and not self.engine.add_edge(first, second, 0, NONE, NONE):
            return False
        return fire(self.plan)
