"""List where a token may stand on its timelines, left to right: pairs of neighbours, as EUROPA finds them."""

from runtime.constraints.domains.bitset import next_value
from runtime.constraints.domains.tags import HALF_INF, NEVER
from runtime.constraints.stn.reach import Reach
from runtime.plan.tags import DURATION, END, LIST_ORDER, LISTS, OBJECT, START
from runtime.solver.flaws.agenda import Queues
from runtime.solver.flaws.decisions import Decisions


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
    first = first_apart(q, q.from_end, START, count)
    behind = count_apart(q, q.to_start, END, count)
    if first == 0:
        stack.add_to_pool(d, o, t, q.sequence[0])
        first = 1
    for gap in range(first, min(behind, count - 1) + 1):
        stack.add_to_pool(d, o, t, q.sequence[gap])
    if behind == count:
        stack.add_to_pool(d, o, q.sequence[count - 1], t)
    return 0


def first_apart(q: Queues, reach: Reach, time: int, count: int) -> int:
    """The first in the sequence whose time (START, END) no path from the token forbids, `count` if none.

    All behind it are apart, too; bounds say so of all from some place on. From there to the left in growing steps, then
    by halving: a question costs more, the farther away it is.
    """
    low = 0
    high = count
    while low < high:
        middle = (low + high) >> 1
        if reach.is_plain(q.rows.var0[q.sequence[middle]] + time):
            high = middle
        else:
            low = middle + 1
    low = 0
    step = 1
    while low < high:
        middle = max(high - step, low)
        if reach.is_apart(q.rows.var0[q.sequence[middle]] + time):
            high = middle
            step *= 2
        else:
            low = middle + 1
            step = (high - low + 1) >> 1
    return high


def count_apart(q: Queues, reach: Reach, time: int, count: int) -> int:
    """How many of the sequence, from the left, have a time that no path to the token forbids; as `first_apart`."""
    low = 0
    high = count
    while low < high:
        middle = (low + high) >> 1
        if reach.is_plain(q.rows.var0[q.sequence[middle]] + time):
            low = middle + 1
        else:
            high = middle
    high = count
    step = 1
    while low < high:
        middle = min(low + step, high) - 1
        if reach.is_apart(q.rows.var0[q.sequence[middle]] + time):
            low = middle + 1
            step *= 2
        else:
            high = middle
            step = (high - low + 1) >> 1
    return low


def may_coincide(q: Queues, candidate: int) -> bool:
    """Whether an active token may have the times of the one that is looked around from.

    Of those in a sequence a first part is too early and a last part too late; found once, for all of them.
    """
    theirs = q.rows.var0[candidate]
    if q.rows.link_head[LISTS * candidate + LIST_ORDER] < 0:
        return (
            q.to_start.is_apart(theirs + START)
            and q.from_start.is_apart(theirs + START)
            and q.to_end.is_apart(theirs + END)
            and q.from_end.is_apart(theirs + END)
        )
    o = q.engine.lb[theirs + OBJECT]
    if q.range_object != o:
        q.range_object = o
        count = q.take_sequence(o)
        for at in range(count):
            q.place_of[q.sequence[at]] = at
        first = first_apart(q, q.from_start, START, count)
        q.range_first = max(first, first_apart(q, q.from_end, END, count))
        end = count_apart(q, q.to_start, START, count)
        q.range_end = min(end, count_apart(q, q.to_end, END, count))
    return not is_out_of_range(q, candidate)


def is_out_of_range(q: Queues, candidate: int) -> bool:
    """Whether `may_coincide` says no, as far as that is known without asking the network."""
    if q.range_object < 0 or q.engine.lb[q.rows.var0[candidate] + OBJECT] != q.range_object:
        return False
    if q.rows.link_head[LISTS * candidate + LIST_ORDER] < 0:
        return False
    return bool(q.place_of[candidate] < q.range_first or q.place_of[candidate] >= q.range_end)


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
