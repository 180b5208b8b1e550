"""Cone of a retraction: the bounds that what is removed supports, and in turn all that these support.

A support that was overwritten is forgotten, so a bound that the removed thing once supported may since support itself
in a cycle (x <= y / 2 and y <= x have shrunk both from 10). Such bounds are in the cone too: any bound of a touched
constraint or edge whose supports do not lead back to restrictions without a cycle.
"""

from runtime.constraints.domains.arrays import grow_rows
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    HALF_INF,
    SIDE_HOLES,
    SIDE_LOWER,
    SIDE_UPPER,
    SUPPORT_CONSTRAINT,
    SUPPORT_EDGE,
    SUPPORT_RESTRICTION,
)
from runtime.constraints.propagators.opcodes import OP_TEMPORAL_DISTANCE, OP_WATCH
from runtime.constraints.relaxation.support_cycles import is_self_supporting


def _relax(s: Store, v: int, side: int) -> None:
    """Put a bound into the cone; a variable with a bit set goes in whole."""
    if s.word[v] >= 0:
        side = SIDE_HOLES
    bit = 7 if side == SIDE_HOLES else 1 << side
    new = bit & ~s.relaxed[v]
    s.relaxed[v] |= bit
    if s.cone_count + 2 > len(s.cone):
        grow_rows(s, "cone", 2 * len(s.cone))
    for bound in range(2):
        if new & (1 << bound):
            s.cone[s.cone_count] = v * 4 + bound
            s.cone_count += 1


def _relax_bound(s: Store, v: int, side: int, support: int) -> None:
    """Relax a bound that `support` holds, or that supports itself."""
    if s.relaxed[v] & (1 << side) == 0 and not s.constant[v]:
        holder = s.lower_support[v] if side == SIDE_LOWER else s.upper_support[v]
        if holder == support or is_self_supporting(s, v, side):
            _relax(s, v, side)


def relax_by(s: Store, v: int, support: int) -> None:
    """Relax what `support` holds of `v`, and the bounds of `v` that support themselves."""
    entry = s.hole_head[v] if s.word[v] >= 0 else -1
    while entry >= 0 and s.hole_support[entry] != support:
        entry = s.hole_next[entry]
    if entry >= 0 or (s.word[v] >= 0 and support & 3 == SUPPORT_RESTRICTION and not s.constant[v]):
        _relax(s, v, SIDE_HOLES)
    _relax_bound(s, v, SIDE_LOWER, support)
    _relax_bound(s, v, SIDE_UPPER, support)


def relax_by_edge(s: Store, e: int) -> None:
    """Relax what an edge holds at both of its ends."""
    _relax_bound(s, s.edge_target[e], SIDE_UPPER, e * 4 + SUPPORT_EDGE)
    _relax_bound(s, s.edge_source[e], SIDE_LOWER, e * 4 + SUPPORT_EDGE)


def relax_by_constraint(s: Store, c: int) -> None:
    """Relax what a constraint holds, itself or by its edges."""
    if s.link_a[c] >= 0:
        relax_by_edge(s, s.link_a[c])
    if s.link_b[c] >= 0:
        relax_by_edge(s, s.link_b[c])
    for slot in range(s.first[c], s.first[c] + s.arity[c]):
        relax_by(s, s.slot_variable[slot], c * 4 + SUPPORT_CONSTRAINT)


def close_cone(s: Store) -> None:
    """Let the cone grow until it holds all that its own bounds support. Upper bounds support along the edges."""
    i = 0
    while i < s.cone_count:
        v = s.cone[i] >> 2
        side = s.cone[i] & 3
        is_upper = side == SIDE_UPPER
        e = s.out_head[v] if is_upper else s.in_head[v]
        while e >= 0:
            if s.edge_weight[e] < HALF_INF:
                _relax_bound(s, s.edge_target[e] if is_upper else s.edge_source[e], side, e * 4 + SUPPORT_EDGE)
            e = s.out_next[e] if is_upper else s.in_next[e]
        slot = s.watch_head[v]
        while slot >= 0:
            c = s.slot_constraint[slot]
            if s.op[c] == OP_TEMPORAL_DISTANCE:
                _relax_by_distance(s, c, v, side)
            elif s.op[c] != OP_WATCH:
                relax_by_constraint(s, c)
            slot = s.slot_next[slot]
        i += 1


def _relax_by_distance(s: Store, c: int, v: int, side: int) -> None:
    """Relax what a distance holds: by its edge if it is the distance that has changed, else the distance itself."""
    d = s.slot_variable[s.first[c] + 1]
    if v != d:
        relax_by(s, d, c * 4 + SUPPORT_CONSTRAINT)
    elif s.link_a[c] >= 0:
        relax_by_edge(s, s.link_a[c] if side == SIDE_UPPER else s.link_b[c])
