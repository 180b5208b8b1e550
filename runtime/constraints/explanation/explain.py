"""Walk from a conflict, or from a bound, back along supports to the causes it rests on.

The walk goes back in time: a support is asked what it read, and of each bound that it read, the state before the
support acted counts, as the trail remembers it. What was committed is known in its last state only, which is at least
as tight; the walk then still ends, since each change is visited once, and `minimise` checks the result.
"""

from collections.abc import Sequence

from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    CONFLICT_CYCLE,
    CONFLICT_DOMAIN,
    FLAG_VALUES,
    KIND_BOOL,
    KIND_FLOAT,
    SIDE_HOLES,
    SIDE_LOWER,
    SIDE_UPPER,
    SUPPORT_CONSTRAINT,
    SUPPORT_EDGE,
    SUPPORT_RESTRICTION,
    TRAIL_REAL_LOWER,
    TRAIL_REAL_UPPER,
)
from runtime.constraints.explanation.cause import Cause, CauseKind, Link
from runtime.constraints.explanation.reasons import collect_all, collect_reasons, collect_weight
from runtime.constraints.propagators.opcodes import OP_EXTERNAL

Bound = tuple[int, int, int]  # variable, side, and the time before which its state counts


def cause_of(s: Store, support: int) -> Cause | None:
    """Name what a support stands for; constants and what the engine itself holds have no cause."""
    name = support >> 2
    if support < 0:
        return None
    if support & 3 == SUPPORT_EDGE:
        if s.edge_link[name] < 0:
            return Cause(CauseKind.EDGE, name, s.edge_span[name], s.edge_owner[name])
        name = s.edge_link[name]
    elif support & 3 == SUPPORT_RESTRICTION:
        if s.constant[s.restriction_variable[name]]:
            return None
        return Cause(CauseKind.RESTRICTION, name, s.restriction_span[name], s.restriction_owner[name])
    return Cause(CauseKind.CONSTRAINT, name, s.span[name], s.owner[name])


def explain_conflict(s: Store) -> list[Cause]:
    """Give the causes of the present conflict, those nearest to it first."""
    now = s.trail_base + s.trail_size
    found: dict[Cause, None] = {}
    waiting: list[Bound] = []
    support = s.conflict_support
    v = s.conflict_variable
    side = s.conflict_side
    if s.conflict_kind == CONFLICT_CYCLE:
        waiting = walk_cycle(s, found, now)
    else:
        add_cause(s, found, support)
        if s.conflict_kind == CONFLICT_DOMAIN:
            collect_reasons(s, support, v, side)
            waiting = read_reasons(s, now)
            # The last value of a bool is taken from where it stands, so both of its bounds count.
            if side != SIDE_UPPER or s.kind[v] == KIND_BOOL:
                waiting.append((v, SIDE_UPPER, now))
            if side != SIDE_LOWER or s.kind[v] == KIND_BOOL:
                waiting.append((v, SIDE_LOWER, now))
        else:
            collect_all(s, support >> 2, -1, SIDE_HOLES)
            waiting = read_reasons(s, now)
            if s.op[support >> 2] == OP_EXTERNAL:
                waiting += read_edges(s, found, s.externals[support >> 2].edges, now)
    walk_back(s, found, waiting, [])
    return list(found)


def explain_bound(s: Store, v: int, side: int) -> list[Link]:
    """Give the chain of causes that holds one side of a domain where it is, the nearest first."""
    links: list[Link] = []
    walk_back(s, {}, [(v, side, s.trail_base + s.trail_size)], links)
    return links


def add_cause(s: Store, found: dict[Cause, None], support: int) -> Cause | None:
    """Put the cause of a support among those found."""
    cause = cause_of(s, support)
    if cause is not None:
        found[cause] = None
    return cause


def read_reasons(s: Store, time: int) -> list[Bound]:
    """Turn the collected reasons into bounds as they were before a time."""
    return [(s.reasons[i] >> 2, s.reasons[i] & 3, time) for i in range(s.reason_count)]


def read_edges(s: Store, found: dict[Cause, None], edges: Sequence[int], time: int) -> list[Bound]:
    """Collect edges that a constraint read; what is left to explain are the distances that their weights follow."""
    waiting: list[Bound] = []
    for e in edges:
        add_cause(s, found, e * 4 + SUPPORT_EDGE)
        s.reason_count = 0
        collect_weight(s, e)
        waiting.extend(read_reasons(s, time))
    return waiting


def walk_cycle(s: Store, found: dict[Cause, None], now: int) -> list[Bound]:
    """Collect the edges of a negative cycle; what is left to explain are the distances that their weights follow."""
    waiting: list[Bound] = []
    e = s.conflict_support >> 2
    side = s.conflict_side
    time = now
    while True:
        add_cause(s, found, e * 4 + SUPPORT_EDGE)
        s.reason_count = 0
        collect_weight(s, e)
        waiting.extend(read_reasons(s, time))
        if e == s.conflict_edge:
            return waiting
        u = s.edge_source[e] if side == SIDE_UPPER else s.edge_target[e]
        support, time, _ = state_before(s, u, side, time)
        assert support & 3 == SUPPORT_EDGE
        e = support >> 2


def state_before(s: Store, v: int, side: int, time: int) -> tuple[int, int, float]:
    """Give support, time and value of a bound as it was before a time; of committed changes the last is known."""
    if side == SIDE_LOWER:
        support, when = s.lower_support[v], s.lower_when[v]
        value: float = s.flo[v] if s.kind[v] == KIND_FLOAT else s.lb[v]
    else:
        support, when = s.upper_support[v], s.upper_when[v]
        value = s.fhi[v] if s.kind[v] == KIND_FLOAT else s.ub[v]
    while when >= time and when >= s.trail_base:
        i = when - s.trail_base
        code = s.trail_key[i] & 15
        value = s.real_bounds[s.trail_value[i]] if code in (TRAIL_REAL_LOWER, TRAIL_REAL_UPPER) else s.trail_value[i]
        support = s.trail_support[i]
        when = s.trail_when[i]
    return support, when, value


def walk_back(s: Store, found: dict[Cause, None], waiting: list[Bound], links: list[Link]) -> None:
    """Visit each change of a bound once, breadth first, and collect causes and links."""
    seen: set[tuple[int, int, int]] = set()
    i = 0
    while i < len(waiting):
        v, side, time = waiting[i]
        i += 1
        if s.constant[v]:
            continue
        if side != SIDE_HOLES:
            support, when, value = state_before(s, v, side, time)
            if (v, side, when) not in seen:
                seen.add((v, side, when))
                step_back(s, found, waiting, links, (v, side, when, time), support, value)
        if s.word[v] >= 0:
            entry = s.hole_head[v]
            while entry >= 0:
                when = s.hole_when[entry]
                if (when < time or when < s.trail_base) and (v, 3, entry) not in seen:
                    seen.add((v, 3, entry))
                    step_back(s, found, waiting, links, (v, SIDE_HOLES, when, time), s.hole_support[entry], 0.0)
                entry = s.hole_next[entry]
            # What a set left out from the start is in no log: it is the doing of the declaration, or of a listing.
            r = s.restriction_head[v]
            while r >= 0:
                if s.restriction_flags[r] & FLAG_VALUES or s.restriction_next[r] < 0:
                    add_cause(s, found, r * 4 + SUPPORT_RESTRICTION)
                r = s.restriction_next[r]


def step_back(
    s: Store,
    found: dict[Cause, None],
    waiting: list[Bound],
    links: list[Link],
    change: tuple[int, int, int, int],
    support: int,
    value: float,
) -> None:
    """Collect the cause of one change and put what it read on the waiting list."""
    v, side, when, time = change
    cause = add_cause(s, found, support)
    if cause is None:
        return
    links.append(Link(cause, v, side, float(value)))
    if support & 3 == SUPPORT_RESTRICTION:
        return
    assert support & 3 in (SUPPORT_EDGE, SUPPORT_CONSTRAINT)
    collect_reasons(s, support, v, side)
    # A change that was committed tells no time: what it read is taken as it was at the later step.
    waiting.extend(read_reasons(s, when if when >= s.trail_base else time))
