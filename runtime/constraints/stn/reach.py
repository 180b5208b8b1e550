"""Grow the shortest paths from one timepoint, or to it, as far as questions about others need them."""

from runtime.constraints.domains.arrays import blank, grow_rows
from runtime.constraints.domains.store import Store
from runtime.constraints.stn.heap import Heap
from runtime.constraints.stn.network import is_followed

_MOST_NEAR = 16
_UNKNOWN, _APART, _REACHED = range(3)


class Reach:
    """Dijkstra with upper bounds as potentials, kept between questions; it holds while the network does not change."""

    def __init__(self, engine: Store, temporal_only: bool) -> None:
        self.engine = engine
        self.temporal_only = temporal_only
        self.is_forward = True
        self.origin = -1
        self.most = 0  # paths of this reduced length or more are left out
        self.stamp = 0
        self.stamped = blank(64)
        self.distance = blank(64)
        self.near_stamp = 0
        self.near_stamped = blank(64)
        self.near_distance = blank(64)
        self.near = blank(_MOST_NEAR)
        self.heap = Heap()

    def begin(self, origin: int, is_forward: bool) -> None:
        """Have questions be about paths from `origin` (or to it) in the network as it is now; nothing is done yet."""
        self.origin = origin
        self.is_forward = is_forward
        self.most = 0

    def is_apart(self, other: int) -> bool:
        """Whether no path from `origin` to `other` (or back from it) is shorter than 0: the two may coincide that way.

        The path says `end - begin < 0`, so that an edge of weight 0 against it would close a negative cycle.
        """
        engine = self.engine
        begin = self.origin if self.is_forward else other
        end = other if self.is_forward else self.origin
        if engine.lb[begin] > engine.ub[end]:
            return False
        limit = engine.ub[begin] - engine.ub[end]
        if self.is_plain(other) or begin == end:
            return True
        if limit <= self.most and self.stamped[other] == self.stamp and self.distance[other] < limit:
            return False
        near = self._probe(other)
        if near != _UNKNOWN:
            return near == _APART
        if limit > self.most:
            self._restart(limit if limit > 2 * self.most else 2 * self.most)
        while self.stamped[other] != self.stamp or self.distance[other] >= limit:
            if self.heap.length == 0 or self.heap.top_key() >= limit:
                return True
            self._expand()
        return False

    def is_plain(self, other: int) -> bool:
        """Whether `is_apart` says yes for bounds alone: both are potentials, no path is shorter than they say."""
        engine = self.engine
        begin = self.origin if self.is_forward else other
        end = other if self.is_forward else self.origin
        return bool(engine.ub[begin] <= engine.ub[end] or engine.lb[begin] <= engine.lb[end])

    def _probe(self, other: int) -> int:
        """Look for a path from the far end, by a few edges: _APART, _REACHED, or _UNKNOWN if that does not tell.

        Both bounds are potentials: what is left to go is never shorter than either says.
        """
        engine = self.engine
        if len(self.near_stamped) < len(engine.kind):
            grow_rows(self, "near_stamped near_distance", len(engine.kind))
        self.near_stamp += 1
        high = engine.ub[self.origin]
        low = engine.lb[self.origin]
        self.near[0] = other
        self.near_distance[other] = 0
        count = 1
        at = 0
        while at < count:
            v = self.near[at]
            at += 1
            e = engine.in_head[v] if self.is_forward else engine.out_head[v]
            while e >= 0:
                u = engine.edge_source[e] if self.is_forward else engine.edge_target[e]
                length = self.near_distance[v] + engine.edge_weight[e]
                up = engine.ub[u] - high if self.is_forward else high - engine.ub[u]
                down = engine.lb[u] - low if self.is_forward else low - engine.lb[u]
                is_shorter = self.near_stamped[u] != self.near_stamp or length < self.near_distance[u]
                if is_shorter and length + up < 0 and length + down < 0 and is_followed(engine, e, self.temporal_only):
                    if u == self.origin:
                        return _REACHED
                    if count == _MOST_NEAR:
                        return _UNKNOWN
                    self.near_stamped[u] = self.near_stamp
                    self.near_distance[u] = length
                    self.near[count] = u
                    count += 1
                e = engine.in_next[e] if self.is_forward else engine.out_next[e]
        return _APART

    def _restart(self, most: int) -> None:
        """Forget all paths, and from now on look for those up to a greater length."""
        self.most = most
        room = len(self.engine.kind)
        if len(self.stamped) < room:
            grow_rows(self, "stamped distance", room)
        self.stamp += 1
        self.heap.clear()
        self.stamped[self.origin] = self.stamp
        self.distance[self.origin] = 0
        self.heap.push(0, 0, self.origin)

    def _expand(self) -> int:
        """Take the nearest point off the heap and follow its edges: those that leave it, or those that lead to it."""
        engine = self.engine
        is_forward = self.is_forward
        length = self.heap.top_key()
        v = self.heap.top_item()
        self.heap.pop()
        if length > self.distance[v]:
            return 0
        e = engine.out_head[v] if is_forward else engine.in_head[v]
        while e >= 0:
            u = engine.edge_target[e] if is_forward else engine.edge_source[e]
            gap = engine.ub[v] - engine.ub[u]
            longer = length + engine.edge_weight[e] + (gap if is_forward else -gap)
            if (
                longer < self.most
                and (self.stamped[u] != self.stamp or longer < self.distance[u])
                and is_followed(engine, e, self.temporal_only)
            ):
                self.stamped[u] = self.stamp
                self.distance[u] = longer
                self.heap.push(longer, 0, u)
            e = engine.out_next[e] if is_forward else engine.in_next[e]
        return 0
