"""Dynamic controllability in cubic time: Morris' backward propagation from negative nodes (CPAIOR 2014).

Each contingent link [x, y] from A to C is brought into normal form: A' exactly x after A, and C after A' by 0 to y - x.
The upper-case edge C -> A' of weight x - y says that the vehicle may take that long, the lower-case edge A' -> C of
weight 0 that it may be done at once. From each node that a negative edge leads to, distances are propagated backwards
along non-negative edges, until they are not negative; then the path is one more edge. A negative node on the way is
done first, and one that waits for itself is a cycle that no strategy can keep. A strategy may react at once to what it
sees.
"""

from heapq import heappop, heappush

from checker.controllability.network import UncertainNetwork

_Reason = object  # of an edge: that of the caller, or the `_Call` that has found it


def offending_cycle(network: UncertainNetwork) -> tuple[object, ...] | None:
    """The reasons of a cycle that no strategy can keep; None where the network is dynamically controllable."""
    return _Propagation(network).run()


class _Call:
    """Propagation back from one node, suspended while another is done first."""

    __slots__ = ("distance", "done", "node", "queue", "via", "waits")

    def __init__(self, node: int, count: int, most: int) -> None:
        self.node = node
        self.distance = [most] * count
        self.distance[node] = 0
        self.via = [-1] * count  # where the path from a node leads first
        self.queue: list[int] = []  # length times the number of nodes, plus the node
        self.done: set[int] = set()
        self.waits = -1


class _Propagation:
    def __init__(self, network: UncertainNetwork) -> None:
        count = network.points + len(network.links)
        self.count = count
        self.into: list[list[tuple[int, int]]] = [[] for _ in range(count)]  # negative edges: from where, and weight
        self.upper: list[list[tuple[int, int]]] = [[] for _ in range(count)]  # the others
        self.at_once = [-1] * count  # the lower-case edge into a node: from where
        self.least: list[dict[int, int]] = [{} for _ in range(count)]  # the smallest weight of ordinary edges
        self.why: dict[tuple[int, int, int], _Reason] = {}  # of an edge: from, to and weight
        for edge in network.edges:
            self._add(edge.earlier, edge.later, edge.weight, edge.why)
        for number, link in enumerate(network.links):
            amid, why = network.points + number, link.why
            self._add(link.start, amid, link.lower, why)
            self._add(amid, link.start, -link.lower, why)
            self._add(amid, link.end, link.upper - link.lower, why)
            self._add(link.end, amid, 0, why)
            self.at_once[link.end] = amid
            if link.upper > link.lower:
                self._put(link.end, amid, link.lower - link.upper, why)
            self.why[amid, link.end, 0] = why
        self.negative = [bool(edges) for edges in self.into]
        # A path that is longer than all that is negative together is part of no negative cycle.
        self.most = -sum(weight for edges in self.into for _, weight in edges)
        self.finished = [False] * count

    def _add(self, earlier: int, later: int, weight: int, why: _Reason) -> None:
        """Add an ordinary edge, unless there is a stronger one."""
        known = self.least[later].get(earlier)
        if known is not None and known <= weight:
            return
        self.least[later][earlier] = weight
        self._put(earlier, later, weight, why)

    def _put(self, earlier: int, later: int, weight: int, why: _Reason) -> None:
        self.why[earlier, later, weight] = why
        (self.into if weight < 0 else self.upper)[later].append((earlier, weight))

    def run(self) -> tuple[object, ...] | None:
        """Propagate from every negative node."""
        for node, is_negative in enumerate(self.negative):
            if is_negative and not self.finished[node] and (cycle := self._from(node)) is not None:
                return cycle
        return None

    def _from(self, first: int) -> tuple[object, ...] | None:
        """Propagate back from a node, and from those that have to be done before; the reasons of a cycle."""
        calls = [self._begin(first)]
        open_nodes = {first}
        while calls:
            call = calls[-1]
            waits = self._go_on(call)
            if waits < 0:
                self.finished[call.node] = True
                open_nodes.discard(call.node)
                calls.pop()
            elif waits in open_nodes:
                return self._cycle(calls, waits)
            else:
                open_nodes.add(waits)
                calls.append(self._begin(waits))
        return None

    def _begin(self, node: int) -> _Call:
        call = _Call(node, self.count, self.most)
        for earlier, weight in self.into[node]:
            if weight < call.distance[earlier]:
                call.distance[earlier] = weight
                call.via[earlier] = node
                heappush(call.queue, weight * self.count + earlier)
        return call

    def _go_on(self, call: _Call) -> int:
        """Propagate until a negative node has to be done first, which is told; -1 at the end."""
        queue, distance, via, done, source = call.queue, call.distance, call.via, call.done, call.node
        count, upper = self.count, self.upper
        while queue:
            node = heappop(queue) % count
            if node in done:
                continue
            length = distance[node]
            if self.negative[node] and not self.finished[node]:
                heappush(queue, length * count + node)
                call.waits = node
                return node
            done.add(node)
            earlier = self.at_once[node]
            # The vehicle cannot be both at once and as late as it may.
            if earlier not in (-1, source) and length < distance[earlier]:
                distance[earlier] = length
                via[earlier] = node
                heappush(queue, length * count + earlier)
            for earlier, weight in upper[node]:
                total = length + weight
                if total < distance[earlier]:
                    distance[earlier] = total
                    via[earlier] = node
                    if total < 0:
                        heappush(queue, total * count + earlier)
        for node, length in enumerate(distance):
            if length >= 0 and via[node] >= 0:
                self._add(node, source, length, call)
        return -1

    def _cycle(self, calls: list[_Call], node: int) -> tuple[object, ...]:
        """The reasons of the paths between the nodes that wait for each other."""
        first = next(k for k, call in enumerate(calls) if call.node == node)
        reasons: dict[object, None] = {}
        pending: list[tuple[_Call, int]] = [(call, call.waits) for call in reversed(calls[first:])]
        seen: set[tuple[int, int]] = set()
        while pending:
            call, at = pending.pop()
            if (id(call), at) in seen:
                continue
            seen.add((id(call), at))
            inner: list[tuple[_Call, int]] = []
            is_first = True
            while is_first or at != call.node:
                is_first = False
                before = at
                at = call.via[before]
                further = call.distance[at] if at != call.node else 0
                why = self.why[before, at, call.distance[before] - further]
                if isinstance(why, _Call):
                    inner.append((why, before))
                elif why is not None:
                    reasons.setdefault(why)
            pending += reversed(inner)
        return tuple(reasons)
