"""List where a token may stand on its timelines, left to right: pairs of neighbours, as EUROPA finds them."""

from runtime.constraints.bits import next_value
from runtime.constraints.codes import HALF_INF, NEVER
from runtime.plan.codes import DURATION, END, LIST_ORDER, OBJECT, START
from runtime.plan.rows import LISTS
from runtime.solver.decisions import Decisions
from runtime.solver.queues import Queues


def fill_places(q: Queues, stack: Decisions, d: int, t: int, exact: bool) -> int:
    """Put all places of token `t` into the pool of decision `d`, by object, then from left to right."""
    engine = q.engine
    v = q.rows.var0[t] + OBJECT
    o = engine.lb[v]
    while o != NEVER and o <= engine.ub[v]:
        if engine.word[v] >= 0:
            o = next_value(engine, v, o)
            if o == NEVER or o > engine.ub[v]:
                break
        if q.plan.object_timeline[o]:
            fill_timeline(q, stack, d, t, o, exact)
        o += 1
    return 0


def fill_timeline(q: Queues, stack: Decisions, d: int, t: int, o: int, exact: bool) -> int:
    """Put the places of token `t` on object `o` into the pool."""
    rows = q.rows
    head = q.plan.object_head[o]
    first = rows.head_first[head]
    if first < 0:
        stack.add_to_pool(d, o, t, t)
        return 0
    current = first
    while current >= 0 and not can_precede(q, t, current, exact):
        current = rows.link_after[LISTS * current + LIST_ORDER]
    if current == first:
        stack.add_to_pool(d, o, t, first)
        current = rows.link_after[LISTS * first + LIST_ORDER]
    while current >= 0:
        previous = rows.link_before[LISTS * current + LIST_ORDER]
        if not can_precede(q, previous, t, exact):
            return 0
        if fits_between(q, t, previous, current, exact):
            stack.add_to_pool(d, o, t, current)
        current = rows.link_after[LISTS * current + LIST_ORDER]
    last = rows.head_last[head]
    if can_precede(q, last, t, exact):
        stack.add_to_pool(d, o, last, t)
    return 0


def can_precede(q: Queues, first: int, second: int, exact: bool) -> bool:
    """Whether the end of `first` may lie before the start of `second`; `exact` asks the whole network."""
    end = q.rows.var0[first] + END
    start = q.rows.var0[second] + START
    if q.engine.lb[end] > q.engine.ub[start]:
        return False
    return not exact or q.distances.admits(start, end, 0)


def fits_between(q: Queues, t: int, previous: int, following: int, exact: bool) -> bool:
    """Whether the gap between two neighbours may become as long as `t`."""
    engine = q.engine
    rows = q.rows
    end = rows.var0[previous] + END
    start = rows.var0[following] + START
    if engine.ub[start] < HALF_INF and engine.ub[start] - engine.lb[end] < engine.lb[rows.var0[t] + DURATION]:
        return False
    if not exact:
        return True
    need = engine.lb[rows.var0[t] + END] - engine.ub[rows.var0[t] + START]
    return q.distances.admits(start, end, -max(need, 1))
