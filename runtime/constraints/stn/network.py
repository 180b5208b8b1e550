"""Propagate bounds along temporal edges, one new edge at a time, with exact detection of negative cycles."""

from runtime.constraints.domains.arrays import lengthen
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    CONFLICT_CYCLE,
    EVENT_LOWER,
    EVENT_UPPER,
    HALF_INF,
    MODE_DISTANCE,
    SIDE_LOWER,
    SIDE_UPPER,
    SUPPORT_EDGE,
    TRAIL_EDGE,
    TRAIL_LINK,
    TRAIL_LOWER,
    TRAIL_UPPER,
    TRAIL_WEIGHT,
)


def _link_edge(s: Store, source: int, target: int, weight: int, span: int, owner: int, link: int) -> int:
    """Put a new edge into the lists of its ends, without propagating it."""
    e = s.edge_free
    if e >= 0:
        s.edge_free = s.out_next[e]
    else:
        e = s.edges_used
        if e == len(s.edge_weight):
            others = "edge_source edge_target out_next out_prev in_next in_prev edge_span edge_owner edge_link"
            lengthen(s, "edge_weight", others)
        s.edges_used = e + 1
    s.edge_source[e] = source
    s.edge_target[e] = target
    s.edge_weight[e] = weight
    s.edge_span[e] = span
    s.edge_owner[e] = owner
    s.edge_link[e] = link
    attach_edge(s, e)
    return e


def attach_edge(s: Store, e: int) -> None:
    """Put an edge into the lists of its ends."""
    source = s.edge_source[e]
    target = s.edge_target[e]
    other = s.out_head[source]
    s.out_next[e] = other
    s.out_prev[e] = -1
    s.out_head[source] = e
    if other >= 0:
        s.out_prev[other] = e
    other = s.in_head[target]
    s.in_next[e] = other
    s.in_prev[e] = -1
    s.in_head[target] = e
    if other >= 0:
        s.in_prev[other] = e


def detach_edge(s: Store, e: int) -> None:
    """Take an edge out of the lists of its ends."""
    before = s.out_prev[e]
    after = s.out_next[e]
    if before >= 0:
        s.out_next[before] = after
    else:
        s.out_head[s.edge_source[e]] = after
    if after >= 0:
        s.out_prev[after] = before
    before = s.in_prev[e]
    after = s.in_next[e]
    if before >= 0:
        s.in_next[before] = after
    else:
        s.in_head[s.edge_target[e]] = after
    if after >= 0:
        s.in_prev[after] = before


def free_edge(s: Store, e: int) -> None:
    """Free the row of an edge that is in no list."""
    s.edge_source[e] = -1
    s.out_next[e] = s.edge_free
    s.edge_free = e


def is_followed(s: Store, e: int, temporal_only: bool) -> bool:
    """Tell whether paths follow an edge; those of EUROPA's network follow no comparison of times, such as `leq`."""
    c = s.edge_link[e] if temporal_only else -1
    return c < 0 or s.mode[c] == MODE_DISTANCE


def insert_edge(s: Store, source: int, target: int, weight: int, span: int, owner: int, link: int) -> int:
    """Add an edge and propagate the network; give the edge. The store is inconsistent if that fails."""
    if s.consistent and s.edge_first != s.edge_last:
        propagate_edges(s, -1, -1, -1)
    e = _link_edge(s, source, target, weight, span, owner, link)
    s.save(e, TRAIL_EDGE, 0, 0)
    if not (s.consistent and follow_edge(s, e)):
        s.suspects.append(e)
    return e


def tighten_edge(s: Store, e: int, weight: int) -> bool:
    """Reduce the weight of an edge and propagate the network."""
    if weight >= s.edge_weight[e]:
        return True
    if s.edge_first != s.edge_last and not propagate_edges(s, -1, -1, -1):
        return False
    s.save(e, TRAIL_WEIGHT, s.edge_weight[e], 0)
    s.edge_weight[e] = weight
    if follow_edge(s, e):
        return True
    s.suspects.append(e)
    return False


def follow_edge(s: Store, e: int) -> bool:
    """Propagate one edge that is new or tighter, from both of its ends; the queue must be empty before."""
    u = s.edge_source[e]
    v = s.edge_target[e]
    w = s.edge_weight[e]
    if u == v:
        if w < 0:
            _fail_cycle(s, v, SIDE_UPPER, e, e)
            return False
        return True
    x = s.ub[u] + w
    if x < s.ub[v]:
        if x < s.lb[v]:
            return s.fail(v, SIDE_UPPER, e * 4 + SUPPORT_EDGE)
        s.write_upper(v, x, e * 4 + SUPPORT_EDGE)
        s.queue_edges(v, 1)
        if s.word[v] >= 0:
            s.queue_hull(v)
        if x < HALF_INF:
            s.wake(v, EVENT_UPPER)
    x = s.lb[v] - w
    if x > s.lb[u]:
        if x > s.ub[u]:
            return s.fail(u, SIDE_LOWER, e * 4 + SUPPORT_EDGE)
        s.write_lower(u, x, e * 4 + SUPPORT_EDGE)
        s.queue_edges(u, 0)
        if s.word[u] >= 0:
            s.queue_hull(u)
        if x > -HALF_INF:
            s.wake(u, EVENT_LOWER)
    if s.edge_first == s.edge_last:
        return True
    return propagate_edges(s, u, v, e)


def _fail_cycle(s: Store, v: int, side: int, e: int, new: int) -> None:
    """Record that a path of edges, `new` the first, comes back to `v` by `e` and tightens its own start."""
    s.note_conflict(CONFLICT_CYCLE, v, side, e * 4 + SUPPORT_EDGE)
    s.conflict_edge = new


def propagate_edges(s: Store, source: int, target: int, new: int) -> bool:
    """Run the edge queue to its fixpoint; false on a conflict.

    Bellman-Ford with a queue: O(edges * points) at worst, usually the few edges that change something. With the ends
    of the one edge that is new, a bound that comes back to the edge's own start tightened proves a negative cycle
    (Cesta and Oddi 1996); without one the network has none, so that the queue runs dry also among unbounded points.
    """
    while s.edge_first != s.edge_last:
        key = s.edge_queue[s.edge_first]
        s.edge_first = (s.edge_first + 1) & s.edge_mask
        v = key >> 1
        if key & 1:
            s.queued[v] &= 5
            if not _push_upper(s, v, source, new):
                return False
        else:
            s.queued[v] &= 6
            if not _push_lower(s, v, target, new):
                return False
    return True


def _push_upper(s: Store, v: int, source: int, new: int) -> bool:
    """Pass the upper bound of `v` on along its edges: to targets. Written out, for nothing runs more often."""
    bound = s.ub[v]
    e = s.out_head[v]
    count = 0
    while e >= 0:
        count += 1
        u = s.edge_target[e]
        x = bound + s.edge_weight[e]
        if x < s.ub[u]:
            if u == source:
                _fail_cycle(s, u, SIDE_UPPER, e, new)
                return False
            if x < s.lb[u]:
                return s.fail(u, SIDE_UPPER, e * 4 + SUPPORT_EDGE)
            i = s.trail_size
            if i == s.trail_room:
                s.grow_trail()
            s.trail_key[i] = u * 16 + TRAIL_UPPER
            s.trail_value[i] = s.ub[u]
            s.trail_support[i] = s.upper_support[u]
            s.trail_when[i] = s.upper_when[u]
            s.trail_size = i + 1
            s.ub[u] = x
            s.upper_support[u] = e * 4 + SUPPORT_EDGE
            s.upper_when[u] = s.trail_base + i
            s.updates += 1
            if s.out_head[u] >= 0 and not s.queued[u] & 2:
                s.queued[u] |= 2
                s.edge_queue[s.edge_last] = 2 * u + 1
                s.edge_last = (s.edge_last + 1) & s.edge_mask
            if s.word[u] >= 0:
                s.queue_hull(u)
            if s.watch_head[u] >= 0 and x < HALF_INF:  # without a bound there is nothing to learn
                s.wake(u, EVENT_UPPER)
        e = s.out_next[e]
    s.visits += count
    return True


def _push_lower(s: Store, v: int, target: int, new: int) -> bool:
    """Pass the lower bound of `v` on along its edges: back to sources."""
    bound = s.lb[v]
    e = s.in_head[v]
    count = 0
    while e >= 0:
        count += 1
        u = s.edge_source[e]
        x = bound - s.edge_weight[e]
        if x > s.lb[u]:
            if u == target:
                _fail_cycle(s, u, SIDE_LOWER, e, new)
                return False
            if x > s.ub[u]:
                return s.fail(u, SIDE_LOWER, e * 4 + SUPPORT_EDGE)
            i = s.trail_size
            if i == s.trail_room:
                s.grow_trail()
            s.trail_key[i] = u * 16 + TRAIL_LOWER
            s.trail_value[i] = s.lb[u]
            s.trail_support[i] = s.lower_support[u]
            s.trail_when[i] = s.lower_when[u]
            s.trail_size = i + 1
            s.lb[u] = x
            s.lower_support[u] = e * 4 + SUPPORT_EDGE
            s.lower_when[u] = s.trail_base + i
            s.updates += 1
            if s.in_head[u] >= 0 and not s.queued[u] & 1:
                s.queued[u] |= 1
                s.edge_queue[s.edge_last] = 2 * u
                s.edge_last = (s.edge_last + 1) & s.edge_mask
            if s.word[u] >= 0:
                s.queue_hull(u)
            if s.watch_head[u] >= 0 and x > -HALF_INF:
                s.wake(u, EVENT_LOWER)
        e = s.in_next[e]
    s.visits += count
    return True


def tie_edges(s: Store, c: int, source: int, target: int, forth: int, back: int) -> bool:
    """Carry a constraint out by two edges between the same points; false on a conflict."""
    tie_edge(s, c, source, target, forth)
    s.link_b[c] = insert_edge(s, target, source, back, s.span[c], s.owner[c], c)
    return bool(s.consistent)


def tie_edge(s: Store, c: int, source: int, target: int, weight: int) -> bool:
    """Carry a constraint out by one edge; false on a conflict."""
    s.save(c, TRAIL_LINK, 0, 0)
    s.link_a[c] = insert_edge(s, source, target, weight, s.span[c], s.owner[c], c)
    return bool(s.consistent)
