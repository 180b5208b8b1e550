"""Find the cone of what is taken out: all bounds that it held up, and all that those held up in turn.

A support that was overwritten is forgotten, so a bound that the removed thing once held may since hold itself up in a
circle (x <= y / 2 and y <= x have shrunk both from 10). Such bounds are in the cone too: any bound of a touched
constraint or edge whose supports do not lead back to restrictions without a circle.
"""

from runtime.constraints.domains.arrays import grown
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    HALF_INF,
    OP_TEMPORAL_DISTANCE,
    OP_WATCH,
    SIDE_HOLES,
    SIDE_LOWER,
    SIDE_UPPER,
    SUPPORT_CONSTRAINT,
    SUPPORT_EDGE,
    SUPPORT_RESTRICTION,
)
from runtime.constraints.relaxation.support_cycles import holds_itself


def loosen(s: Store, v: int, side: int) -> None:
    """Put a bound into the cone; a variable with a bit set goes in whole."""
    if s.constant[v]:
        return
    if s.word[v] >= 0:
        side = SIDE_HOLES
    bit = 7 if side == SIDE_HOLES else 1 << side
    new = bit & ~s.loose[v]
    if new == 0:
        return
    s.loose[v] |= bit
    if s.cone_count + 2 > len(s.cone):
        s.cone = grown(s.cone, 2 * len(s.cone))
    if new & 1:
        s.cone[s.cone_count] = v * 4 + SIDE_LOWER
        s.cone_count += 1
    if new & 2:
        s.cone[s.cone_count] = v * 4 + SIDE_UPPER
        s.cone_count += 1


def loosen_by(s: Store, v: int, support: int) -> None:
    """Loosen what `support` holds of `v`, and what of `v` holds itself up."""
    if s.constant[v]:
        return
    if s.word[v] >= 0:
        entry = s.hole_head[v]
        while entry >= 0:
            if s.hole_support[entry] == support:
                loosen(s, v, SIDE_HOLES)
                return
            entry = s.hole_next[entry]
        if support & 3 == SUPPORT_RESTRICTION:
            loosen(s, v, SIDE_HOLES)
            return
    for side in range(2):
        if s.loose[v] & (1 << side) == 0:
            holder = s.lower_support[v] if side == SIDE_LOWER else s.upper_support[v]
            if holder == support or holds_itself(s, v, side):
                loosen(s, v, side)


def loosen_by_edge(s: Store, e: int) -> None:
    """Loosen what an edge holds at both of its ends."""
    support = e * 4 + SUPPORT_EDGE
    v = s.edge_target[e]
    if s.loose[v] & 2 == 0 and (s.upper_support[v] == support or holds_itself(s, v, SIDE_UPPER)):
        loosen(s, v, SIDE_UPPER)
    v = s.edge_source[e]
    if s.loose[v] & 1 == 0 and (s.lower_support[v] == support or holds_itself(s, v, SIDE_LOWER)):
        loosen(s, v, SIDE_LOWER)


def loosen_by_constraint(s: Store, c: int) -> None:
    """Loosen what a constraint holds, itself or by its edges."""
    if s.link_a[c] >= 0:
        loosen_by_edge(s, s.link_a[c])
    if s.link_b[c] >= 0:
        loosen_by_edge(s, s.link_b[c])
    support = c * 4 + SUPPORT_CONSTRAINT
    for slot in range(s.first[c], s.first[c] + s.arity[c]):
        loosen_by(s, s.slot_variable[slot], support)


def follow_cone(s: Store) -> None:
    """Let the cone grow until it holds all that was held by its own bounds."""
    i = 0
    while i < s.cone_count:
        v = s.cone[i] >> 2
        if s.cone[i] & 3 == SIDE_UPPER:
            e = s.out_head[v]
            while e >= 0:
                u = s.edge_target[e]
                if s.loose[u] & 2 == 0 and s.edge_weight[e] < HALF_INF:
                    if s.upper_support[u] == e * 4 + SUPPORT_EDGE or holds_itself(s, u, SIDE_UPPER):
                        loosen(s, u, SIDE_UPPER)
                e = s.out_next[e]
        else:
            e = s.in_head[v]
            while e >= 0:
                u = s.edge_source[e]
                if s.loose[u] & 1 == 0 and s.edge_weight[e] < HALF_INF:
                    if s.lower_support[u] == e * 4 + SUPPORT_EDGE or holds_itself(s, u, SIDE_LOWER):
                        loosen(s, u, SIDE_LOWER)
                e = s.in_next[e]
        slot = s.watch_head[v]
        while slot >= 0:
            c = s.slot_constraint[slot]
            if s.op[c] == OP_TEMPORAL_DISTANCE:
                loosen_by_distance(s, c, v, s.cone[i] & 3)
            elif s.op[c] != OP_WATCH:
                loosen_by_constraint(s, c)
            slot = s.slot_next[slot]
        i += 1


def loosen_by_distance(s: Store, c: int, v: int, side: int) -> None:
    """Loosen what a distance holds: by its edge if it is the distance that has changed, else the distance itself."""
    d = s.slot_variable[s.first[c] + 1]
    if v == d:
        if s.link_a[c] >= 0:
            loosen_by_edge(s, s.link_a[c] if side == SIDE_UPPER else s.link_b[c])
    else:
        loosen_by(s, d, c * 4 + SUPPORT_CONSTRAINT)
