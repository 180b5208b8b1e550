"""Resource envelope (Muscettola 2002): bounds on a level by the order of uses, and its flaws.

A use that comes after another's end is never charged together with it, whatever their times. The worst case at an
instant is a closure of greatest weight among the uses that may have happened; as known orders are transitive, it is a
maximum flow from takers to givers before them. Order is read off the STN: paths of edges without positive weight, and
bounds.
"""

from math import inf

from runtime.constraints.domains.arrays import blank, grow_rows, lengthen
from runtime.constraints.domains.tags import FLOAT_TOLERANCE, SIDE_LOWER, SIDE_UPPER
from runtime.constraints.engine import Engine
from runtime.plan.resources.profile import Profile
from runtime.plan.resources.resources import Resources
from runtime.plan.tags import NONE

_ROOM = 8  # uses at first: few models have resources, and what there is is restored before each mission


class Envelope:
    """The flaw found last: `resource`, the instant `at`, `is_low` and `amount`; scratch arrays are used again."""

    def __init__(self, engine: Engine, resources: Resources) -> None:
        self.engine = engine
        self.resources = resources
        self.profile = Profile()
        self.resource = NONE
        self.at = 0
        self.is_low = 1
        self.grounded = False
        self.amount = 0.0
        self.marks = blank(_ROOM)
        self.mark = 0
        self.stack = blank(_ROOM)
        self.via = blank(_ROOM)
        self.use_room = _ROOM
        self.takes = blank(_ROOM)  # the timepoint at which use i takes from the level, or gives to it
        self.gives = blank(_ROOM)
        self.instants = blank(_ROOM)
        self.supply = blank(_ROOM, "d")
        self.demand = blank(_ROOM, "d")
        self.from_taker = blank(_ROOM)
        self.from_giver = blank(_ROOM)
        self.queue = blank(_ROOM)
        self.shut_givers = blank(_ROOM)  # whether nothing more gets through giver i, or through taker i
        self.shut_takers = blank(_ROOM)
        self.flow = blank(_ROOM * _ROOM, "d")
        self.ordered = blank(_ROOM * _ROOM)  # [taker * use_room + giver]: the giver gives before the taker takes

    # ---- flaws ----

    def find(self, o: int) -> bool:
        """The first instant at which resource `o` may be out of bounds; what it is stands in the fields."""
        resources = self.resources
        profile = self.profile
        resources.fill(profile, o)
        self.resource = o
        if profile.initial_low + self.change(-1) < profile.minimum - FLOAT_TOLERANCE and self._find_side(o, 1):
            return True
        return profile.initial_high + self.change(1) > profile.maximum + FLOAT_TOLERANCE and self._find_side(o, 0)

    def find_certain(self, o: int) -> bool:
        """Whether the order of uses makes certain what their times alone leave open: the whole envelope is outside."""
        profile = self.profile
        self.resources.fill(profile, o)
        self.resource = o
        self.grounded = False
        self.is_low = 0
        if self._envelope_is_outside(-1):
            return True
        self.is_low = 1
        return self._envelope_is_outside(1)

    def _envelope_is_outside(self, sign: int) -> bool:
        """Whether at some instant the highest level is below the minimum (or the lowest above the maximum)."""
        profile = self.profile
        self.prepare()
        for i in range(profile.count):
            if profile.sign[i] == sign:
                self.at = profile.start_high[i]
                if sign < 0:
                    self.amount = profile.minimum - profile.best_for_consumers(self.at)
                else:
                    self.amount = profile.worst_for_consumers(self.at) - profile.maximum
                self.amount += self._given_back(inf)
                if self.amount > FLOAT_TOLERANCE:
                    return True
        return False

    def change(self, sign: int) -> float:
        """The greatest change of the level in one direction."""
        profile = self.profile
        total = 0.0
        for i in range(profile.count):
            if profile.sign[i] == sign:
                total += sign * profile.most[i]
        return total

    def _find_side(self, o: int, is_low: int) -> bool:
        """The first instant at which the level may be too low (or too high)."""
        profile = self.profile
        self.is_low = is_low
        grounded = self.resources.is_grounded(o)
        self.grounded = grounded
        if not grounded:
            self.prepare()
        count = self._collect_instants()
        for k in range(count):
            self.at = self.instants[k]
            if grounded:
                level = profile.grounded(self.at)
                self.amount = profile.minimum - level if is_low else level - profile.maximum
            else:
                level = profile.worst_for_consumers(self.at) if is_low else profile.best_for_consumers(self.at)
                self.amount = profile.minimum - level if is_low else level - profile.maximum
                if self.amount > FLOAT_TOLERANCE:
                    self.amount -= self._given_back(self.amount)
            if self.amount > FLOAT_TOLERANCE:
                return True
        return False

    def _collect_instants(self) -> int:
        """The instants at which the level may change for the worse, in order; their number."""
        profile = self.profile
        sign = -1 if self.is_low else 1
        count = 0
        for i in range(profile.count):
            if profile.sign[i] == sign:
                t = profile.start_low[i]
                k = count
                while k > 0 and self.instants[k - 1] > t:
                    k -= 1
                if k > 0 and self.instants[k - 1] == t:
                    continue
                for j in range(count, k, -1):
                    self.instants[j] = self.instants[j - 1]
                self.instants[k] = t
                count += 1
        return count

    # ---- order ----

    def prepare(self) -> None:
        """Find which uses give back (or take) before which others take (or give)."""
        profile = self.profile
        n = profile.count
        self.make_room(n)
        resources = self.resources
        taker = -1 if self.is_low else 1
        for i in range(n):
            u = profile.use[i]
            self.takes[i] = NONE
            self.gives[i] = NONE
            if u >= 0 and profile.sign[i] == taker:
                self.takes[i] = resources.start[u]
                if self.is_low and not profile.lasting[i]:
                    self.gives[i] = resources.end[u]
            elif u >= 0 and profile.lasting[i]:
                self.gives[i] = resources.start[u]
        for j in range(n):
            if self.takes[j] >= 0:
                self.walk_back(self.takes[j])
                for i in range(n):
                    v = self.gives[i]
                    known = v >= 0 and i != j
                    if known and self.marks[v] != self.mark:
                        known = self.engine.ub[v] <= self.engine.lb[self.takes[j]]
                    self.ordered[j * self.use_room + i] = known

    def make_room(self, n: int) -> None:
        """Make the arrays long enough for `n` uses and all variables."""
        if n > self.use_room:
            if n > len(self.takes):
                lengthen(
                    self,
                    "takes gives instants supply demand from_taker from_giver queue shut_givers shut_takers",
                    need=n,
                )
            self.use_room = len(self.takes)
            if self.use_room * self.use_room > len(self.flow):
                grow_rows(self, "flow ordered", self.use_room * self.use_room)
        if self.engine.variables > len(self.marks):
            lengthen(self, "marks stack via", need=self.engine.variables)

    def walk_back(self, v: int) -> None:
        """Mark all timepoints that are known to be no later than `v`."""
        engine = self.engine
        self.mark += 1
        self.marks[v] = self.mark
        self.stack[0] = v
        top = 1
        while top:
            top -= 1
            e = engine.out_head[self.stack[top]]
            while e >= 0:
                u = engine.edge_target[e]
                if engine.edge_weight[e] <= 0 and self.marks[u] != self.mark:
                    self.marks[u] = self.mark
                    self.via[u] = e
                    self.stack[top] = u
                    top += 1
                e = engine.out_next[e]

    # ---- the envelope ----

    def _given_back(self, enough: float) -> float:
        """How much of what may be taken at the instant must have been given back before: the greatest flow.

        It is sought no further where it is `enough`.
        """
        profile = self.profile
        n = profile.count
        t = self.at
        total = 0.0
        for i in range(n):
            self.supply[i] = 0.0
            self.demand[i] = 0.0
            if self.takes[i] >= 0 and profile.start_low[i] <= t < profile.start_high[i]:
                if profile.lasting[i] or profile.end_high[i] > t:
                    self.supply[i] = profile.most[i]
            if self.gives[i] >= 0:
                if self.takes[i] < 0:
                    if profile.start_low[i] <= t < profile.start_high[i]:
                        self.demand[i] = profile.least[i]
                elif profile.end_low[i] <= t < profile.end_high[i]:
                    self.demand[i] = profile.most[i]
            total += self.demand[i]
        if total <= FLOAT_TOLERANCE:
            return 0.0
        for cell in range(n * self.use_room):
            self.flow[cell] = 0.0
        for i in range(n):
            self.shut_givers[i] = 0
            self.shut_takers[i] = 0
        total = 0.0
        for j in range(n):
            while self.supply[j] > FLOAT_TOLERANCE and total < enough:
                pushed = self._augment(j)
                if pushed <= 0.0:
                    break
                total += pushed
        return total

    def _augment(self, source: int) -> float:
        """Push along one shortest path from taker `source` to a giver with demand left; how much."""
        n = self.profile.count
        for k in range(n):
            self.from_taker[k] = NONE
            self.from_giver[k] = NONE
        self.from_giver[source] = n  # anything but NONE: reached
        self.queue[0] = source
        first = 0
        last = 1
        while first < last:
            j = self.queue[first]
            first += 1
            for i in range(n):  # what is joined at once is the shortest path
                if self.demand[i] > FLOAT_TOLERANCE and self.ordered[j * self.use_room + i]:
                    self.from_taker[i] = j
                    return self.push(source, i)
            for i in range(n):
                if self.from_taker[i] >= 0 or self.shut_givers[i] or not self.ordered[j * self.use_room + i]:
                    continue
                self.from_taker[i] = j
                for k in range(n):
                    if (
                        self.from_giver[k] < 0
                        and not self.shut_takers[k]
                        and self.flow[k * self.use_room + i] > FLOAT_TOLERANCE
                    ):
                        self.from_giver[k] = i
                        self.queue[last] = k
                        last += 1
        # No later path leads on from what was reached here: none leaves it, and no demand is left in it.
        for k in range(n):
            self.shut_givers[k] = self.shut_givers[k] or self.from_taker[k] >= 0
            self.shut_takers[k] = self.shut_takers[k] or self.from_giver[k] >= 0
        return 0.0

    def push(self, source: int, giver: int) -> float:
        """Push what fits along the path that `augment` found."""
        amount = min(self.supply[source], self.demand[giver])
        i = giver
        j = self.from_taker[i]
        while j != source:
            i = self.from_giver[j]
            amount = min(amount, self.flow[j * self.use_room + i])
            j = self.from_taker[i]
        self.supply[source] -= amount
        self.demand[giver] -= amount
        i = giver
        j = self.from_taker[i]
        self.flow[j * self.use_room + i] += amount
        while j != source:
            i = self.from_giver[j]
            self.flow[j * self.use_room + i] -= amount
            j = self.from_taker[i]
            self.flow[j * self.use_room + i] += amount
        return amount

    # ---- reasons ----

    def note_orders(self, edges: list[int], read: list[int]) -> None:
        """After `find_certain`: add the edges that order what the flow joins, or the bounds (`4 * v + side`)."""
        n = self.profile.count
        for j in range(n):
            is_marked = False
            for i in range(n):
                if self.flow[j * self.use_room + i] <= FLOAT_TOLERANCE:
                    continue
                if not is_marked:
                    self.walk_back(self.takes[j])
                    is_marked = True
                v = self.gives[i]
                if self.marks[v] != self.mark:
                    read.append(v * 4 + SIDE_UPPER)
                    read.append(self.takes[j] * 4 + SIDE_LOWER)
                    continue
                while v != self.takes[j]:
                    e = self.via[v]
                    edges.append(e)
                    v = self.engine.edge_source[e]
