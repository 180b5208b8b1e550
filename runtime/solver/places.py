"""List where a token may stand on its timelines, left to right: pairs of neighbours, as EUROPA finds them."""

from runtime.constraints.bits import next_value
from runtime.constraints.codes import HALF_INF, NEVER
from runtime.plan.codes import DURATION, END, LIST_ORDER, LISTS, OBJECT, START
from runtime.solver.decisions import Decisions
from runtime.solver.queues import Queues


def fill_places(q: Queues, stack: Decisions, d: int, t: int) -> int:
    """Put all places of token `t` into the pool of decision `d`, by object, then from left to right."""
    engine = q.engine
    q.look_around(t)
    v = q.rows.var0[t] + OBJECT
    o = engine.lb[v]
    while o <= engine.ub[v]:
        if engine.word[v] >= 0:
            o = next_value(engine, v, o)
            if o == NEVER or o > engine.ub[v]:
                break
        if q.plan.object_timeline[o]:
            fill_timeline(q, stack, d, t, o)
        o += 1
    return 0


def fill_timeline(q: Queues, stack: Decisions, d: int, t: int, o: int) -> int:
    """Put the places of token `t` on object `o` into the pool, also those between neighbours that may be too near.

    `first` is the first token that `t` can precede, `behind` how many can precede `t`: along a sequence each answer
    changes only once. EUROPA makes the same tests one by one, from left to right.
    `q.look_around(t)` came before.
    """
    count = q.take_sequence(o)
    if count == 0:
        stack.add_to_pool(d, o, t, t)
        return 0
    first = first_behind(q, count)
    behind = count_before(q, count)
    if first == 0:
        stack.add_to_pool(d, o, t, q.sequence[0])
        first = 1
    for gap in range(first, min(behind, count - 1) + 1):
        stack.add_to_pool(d, o, t, q.sequence[gap])
    if behind == count:
        stack.add_to_pool(d, o, q.sequence[count - 1], t)
    return 0


def first_behind(q: Queues, count: int) -> int:
    """The first in the sequence that the token may precede, `count` if none: bounds say it of all from some place on.

    From there to the left in growing steps, then by halving: a question costs more, the farther away it is.
    """
    low = 0
    high = count
    while low < high:
        middle = (low + high) >> 1
        if q.from_end.is_plain(q.rows.var0[q.sequence[middle]] + START):
            high = middle
        else:
            low = middle + 1
    low = 0
    step = 1
    while low < high:
        middle = max(high - step, low)
        if can_be_before(q, q.sequence[middle]):
            high = middle
            step *= 2
        else:
            low = middle + 1
            step = (high - low + 1) >> 1
    return high


def count_before(q: Queues, count: int) -> int:
    """How many of the sequence may precede the token; found as `first_behind` is, from the left."""
    low = 0
    high = count
    while low < high:
        middle = (low + high) >> 1
        if q.to_start.is_plain(q.rows.var0[q.sequence[middle]] + END):
            low = middle + 1
        else:
            high = middle
    high = count
    step = 1
    while low < high:
        middle = min(low + step, high) - 1
        if can_be_behind(q, q.sequence[middle]):
            low = middle + 1
            step *= 2
        else:
            high = middle
            step = (high - low + 1) >> 1
    return low


def can_be_before(q: Queues, other: int) -> bool:
    """Whether the token that is looked around from may end before `other` starts."""
    return q.from_end.is_apart(q.rows.var0[other] + START)


def can_be_behind(q: Queues, other: int) -> bool:
    """Whether the token that is looked around from may start after `other` ends."""
    return q.to_start.is_apart(q.rows.var0[other] + END)


def is_open_place(q: Queues, t: int, before: int, after: int) -> bool:
    """Whether a place of token `t` is an end of the sequence, or a gap that may become as long as `t`."""
    engine = q.engine
    rows = q.rows
    if before != t:
        return True
    previous = rows.link_before[LISTS * after + LIST_ORDER]
    if previous < 0 or after == t:
        return True
    end = rows.var0[previous] + END
    start = rows.var0[after] + START
    if engine.ub[start] < HALF_INF and engine.ub[start] - engine.lb[end] < engine.lb[rows.var0[t] + DURATION]:
        return False
    if not q.exact:
        return True
    need = engine.lb[rows.var0[t] + END] - engine.ub[rows.var0[t] + START]
    return q.distances.admits(start, end, -max(need, 1))
