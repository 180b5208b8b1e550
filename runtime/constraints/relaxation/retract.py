"""Retraction at level 0: remove constraints, edges, restrictions and variables in any order; relax what they support.

The bounds of the cone (cone.py) go back to their base and are tightened along the remaining edges; what touches them
is propagated again. Cost: what is removed, the cone and its neighbours.
"""

import math
from math import inf

from runtime.constraints.domains.base_domain import is_listing
from runtime.constraints.domains.bitset import detach_words, drop_log
from runtime.constraints.domains.narrow import raise_to, reduce_to
from runtime.constraints.domains.sparse_set import SparseSet
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    FLAG_DECISION,
    FLAG_VALUES,
    FLOAT_TOLERANCE,
    HALF_INF,
    INF,
    KIND_FLOAT,
    MODE_EDGES,
    NEVER,
    SIDE_LOWER,
    SIDE_UPPER,
    SUPPORT_EDGE,
    SUPPORT_RESTRICTION,
)
from runtime.constraints.domains.variables import drop_restriction, drop_variable, keep_values
from runtime.constraints.propagators.opcodes import OP_TEMPORAL_DISTANCE
from runtime.constraints.propagators.posting import release_constraint
from runtime.constraints.relaxation.cone import close_cone, relax_by, relax_by_constraint, relax_by_edge
from runtime.constraints.relaxation.trail import clear_queues, commit_trail
from runtime.constraints.stn.network import attach_edge, detach_edge, follow_edge, free_edge, propagate_edges

_WHOLE = 7  # both bounds, and a bit set


def retract(
    s: Store, constraints: list[int], edges: list[int], restrictions: list[int], variables: list[int]
) -> list[int]:
    """Remove and relax; leave the rest scheduled. Give the edges that must be followed again, one by one.

    Constraints, edges and restrictions of the removed variables go too.
    """
    was_consistent = s.consistent
    commit_trail(s)
    if not was_consistent:
        clear_queues(s)
    s.consistent = True
    s.conflict_kind = 0
    s.visits_begun += 1
    s.cone_count = 0
    doomed, gone = s.doomed, s.gone
    doomed.empty(s.constraints_used)
    gone.empty(s.edges_used)
    for v in variables:
        s.relaxed[v] = _WHOLE  # what goes stays out of the cone: all that it supports is touched by what goes with it
    for c in constraints:
        doomed.add(c)
    _gather(s, variables, doomed)
    for e in edges:
        relax_by_edge(s, e)
    for i in range(doomed.count):
        relax_by_constraint(s, doomed.items[i])
    for r in restrictions:
        relax_by(s, s.restriction_variable[r], r * 4 + SUPPORT_RESTRICTION)
    suspects = [e for e in s.suspects if s.edge_source[e] >= 0]
    s.suspects.clear()
    for e in suspects:
        relax_by_edge(s, e)
    close_cone(s)
    for e in edges:
        gone.add(e)
    for i in range(doomed.count):
        c = doomed.items[i]
        if s.link_a[c] >= 0:
            gone.add(s.link_a[c])
        if s.link_b[c] >= 0:
            gone.add(s.link_b[c])
    for v in variables:
        e = s.out_head[v]
        while e >= 0:
            gone.add(e)
            e = s.out_next[e]
        e = s.in_head[v]
        while e >= 0:
            gone.add(e)
            e = s.in_next[e]
    for e in suspects:
        detach_edge(s, e)
    gone.sort()
    for i in range(gone.count):
        e = gone.items[i]
        if not suspects or e not in suspects:
            detach_edge(s, e)
        free_edge(s, e)
    for i in range(doomed.count):
        release_constraint(s, doomed.items[i])
    for r in restrictions:
        v = s.restriction_variable[r]
        is_decision = s.restriction_flags[r] & FLAG_DECISION
        drop_restriction(s, r)
        if is_decision:
            s.set_decided(v, 1 if _has_decision(s, v) else 0)
    _reset_cone(s)
    for v in variables:
        while s.restriction_head[v] >= 0:
            drop_restriction(s, s.restriction_head[v])
        s.relaxed[v] = 0
        drop_variable(s, v)
    _renew_cone(s)
    commit_trail(s)
    if not was_consistent:
        _schedule_all(s)
    return [e for e in suspects if not gone.has(e)]


def _gather(s: Store, variables: list[int], doomed: SparseSet) -> None:
    """Add the constraints on removed variables to those that go."""
    for v in variables:
        for k in range(2):
            slot = s.mute_head[v] if k else s.watch_head[v]
            while slot >= 0:
                doomed.add(s.slot_constraint[slot])
                slot = s.slot_next[slot]
        for k in range(2):
            e = s.in_head[v] if k else s.out_head[v]
            while e >= 0:
                if s.edge_link[e] >= 0:
                    doomed.add(s.edge_link[e])
                relax_by_edge(s, e)
                e = s.in_next[e] if k else s.out_next[e]


def edges_of(s: Store, v: int) -> list[int]:
    """List the edges of a variable."""
    found = []
    e = s.out_head[v]
    while e >= 0:
        found.append(e)
        e = s.out_next[e]
    e = s.in_head[v]
    while e >= 0:
        found.append(e)
        e = s.in_next[e]
    return found


def _reset_cone(s: Store) -> None:
    """Give every bound of the cone its base value back, and every distance in it edges that hold nothing."""
    for i in range(s.cone_count):
        v = s.cone[i] >> 2
        side = s.cone[i] & 3
        if s.word[v] >= 0:
            _reset_set(s, v)
        elif s.relaxed[v]:
            _reset_bound(s, v, side)
        slot = s.watch_head[v]
        while slot >= 0:
            c = s.slot_constraint[slot]
            if s.op[c] == OP_TEMPORAL_DISTANCE and s.slot_variable[s.first[c] + 1] == v and s.link_a[c] >= 0:
                s.edge_weight[s.link_a[c] if side == SIDE_UPPER else s.link_b[c]] = NEVER
            slot = s.slot_next[slot]


def _reset_bound(s: Store, v: int, side: int) -> None:
    """Give one bound the tightest value that restrictions and decisions leave it."""
    best = -inf if side == SIDE_LOWER else inf
    support = -1
    r = s.restriction_head[v]
    while r >= 0:
        x = s.restriction_lo[r] if side == SIDE_LOWER else s.restriction_hi[r]
        # Of equal ones the oldest counts, as when they were carried out.
        if support < 0 or (x >= best if side == SIDE_LOWER else x <= best):
            best = x
            support = r * 4 + SUPPORT_RESTRICTION
        r = s.restriction_next[r]
    _set_base(s, v, side, best, support)


def _set_base(s: Store, v: int, side: int, x: float, support: int) -> None:
    """Set a bound as it was before all propagation."""
    if side == SIDE_LOWER:
        s.lower_support[v] = support
        s.lower_when[v] = -1
        if s.kind[v] == KIND_FLOAT:
            s.flo[v] = -inf if x <= -HALF_INF else x
        else:
            s.lb[v] = -INF if x <= -HALF_INF else int(math.ceil(x - FLOAT_TOLERANCE))
    else:
        s.upper_support[v] = support
        s.upper_when[v] = -1
        if s.kind[v] == KIND_FLOAT:
            s.fhi[v] = inf if x >= HALF_INF else x
        else:
            s.ub[v] = INF if x >= HALF_INF else int(math.floor(x + FLOAT_TOLERANCE))


def _reset_set(s: Store, v: int) -> None:
    """Take the bit set of a variable away; `renew_cone` carries its restrictions to sets out again."""
    drop_log(s, v)
    detach_words(s, v)
    _reset_bound(s, v, SIDE_LOWER)
    _reset_bound(s, v, SIDE_UPPER)


def _uncross(s: Store, v: int, side: int) -> None:
    """Where restrictions contradict, record the conflict and let the variable's declaration alone bound this side."""
    if s.kind[v] == KIND_FLOAT:
        if s.flo[v] <= s.fhi[v]:
            return
        if s.flo[v] <= s.fhi[v] + FLOAT_TOLERANCE:
            s.fhi[v] = s.flo[v]
            return
    elif s.lb[v] <= s.ub[v]:
        return
    r = s.restriction_head[v]
    while s.restriction_next[r] >= 0:
        r = s.restriction_next[r]
    if s.restriction_lo[r] > s.restriction_hi[r]:
        return
    s.fail(v, side, s.lower_support[v] if side == SIDE_LOWER else s.upper_support[v])
    x = s.restriction_lo[r] if side == SIDE_LOWER else s.restriction_hi[r]
    _set_base(s, v, side, x, r * 4 + SUPPORT_RESTRICTION)


def _renew_cone(s: Store) -> None:
    """Pull the bounds of the cone tight along the edges, restrict to sets, and schedule all that touches them."""
    for i in range(s.cone_count):
        v = s.cone[i] >> 2
        s.relaxed[v] = 0
        if s.kind[v] >= 0:
            _uncross(s, v, s.cone[i] & 3)
    for i in range(s.cone_count):
        v = s.cone[i] >> 2
        side = s.cone[i] & 3
        if s.kind[v] < 0:
            continue
        if side == SIDE_LOWER:
            _pull_lower(s, v)
        else:
            _pull_upper(s, v)
        _restrict_to_sets(s, v)
        for head in (s.watch_head[v], s.mute_head[v]):
            slot = head
            while slot >= 0:
                c = s.slot_constraint[slot]
                # Edges that do not change carry some out.
                if s.mode[c] != MODE_EDGES or s.link_a[c] < 0 or s.slot_mask[slot]:
                    s.schedule(c)
                slot = s.slot_next[slot]


def _restrict_to_sets(s: Store, v: int) -> None:
    """Carry the restrictions of a variable to sets of values out again, the oldest first."""
    listed = []
    r = s.restriction_head[v]
    while r >= 0:
        if s.restriction_flags[r] & FLAG_VALUES and not is_listing(s, r):
            listed.append(r)
        r = s.restriction_next[r]
    for r in reversed(listed):
        if s.consistent and s.restriction_values[r]:
            keep_values(s, v, s.restriction_values[r], r * 4 + SUPPORT_RESTRICTION)


def _pull_lower(s: Store, v: int) -> None:
    """Raise a lower bound to what its edges ask for now."""
    e = s.out_head[v]
    while e >= 0:
        x = s.lb[s.edge_target[e]] - s.edge_weight[e]
        if x > s.ub[v]:
            s.queue_edges(s.edge_target[e], 0)  # which will find the conflict
        elif x > s.lb[v]:
            s.lb[v] = x
            s.lower_support[v] = e * 4 + SUPPORT_EDGE
            s.lower_when[v] = s.trail_base
        e = s.out_next[e]
    s.queue_edges(v, 0)


def _pull_upper(s: Store, v: int) -> None:
    """Reduce an upper bound to what its edges ask for now."""
    e = s.in_head[v]
    while e >= 0:
        x = s.ub[s.edge_source[e]] + s.edge_weight[e]
        if x < s.lb[v]:
            s.queue_edges(s.edge_source[e], 1)
        elif x < s.ub[v]:
            s.ub[v] = x
            s.upper_support[v] = e * 4 + SUPPORT_EDGE
            s.upper_when[v] = s.trail_base
        e = s.in_next[e]
    s.queue_edges(v, 1)


def _schedule_all(s: Store) -> None:
    """After a conflict at level 0 nothing is known to be carried out: restrict again, schedule all, visit all edges."""
    for r in range(s.restrictions_used):
        v = s.restriction_variable[r]
        if v >= 0 and s.consistent and not is_listing(s, r):
            support = r * 4 + SUPPORT_RESTRICTION
            if raise_to(s, v, s.restriction_lo[r], support):
                reduce_to(s, v, s.restriction_hi[r], support)
    for c in range(s.constraints_used):
        if s.op[c] >= 0:
            s.schedule(c)
    for v in range(s.variables):
        if s.kind[v] >= 0:
            _restrict_to_sets(s, v)
            s.queue_edges(v, 0)
            s.queue_edges(v, 1)


def follow_again(s: Store, edges: list[int]) -> bool:
    """Put edges that led to a conflict back, one by one; false if one does again."""
    propagate_edges(s, -1, -1, -1)
    for e in edges:
        attach_edge(s, e)
        if not (s.consistent and follow_edge(s, e)):
            s.suspects.append(e)
    return s.consistent


def _has_decision(s: Store, v: int) -> bool:
    """Tell whether any restriction of a variable is a decision."""
    r = s.restriction_head[v]
    while r >= 0 and not s.restriction_flags[r] & FLAG_DECISION:
        r = s.restriction_next[r]
    return r >= 0
