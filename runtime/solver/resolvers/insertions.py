"""Insertions: where a token may stand on its timelines, left to right, as pairs of neighbours."""

from runtime.constraints.domains.bitset import next_value
from runtime.constraints.domains.tags import HALF_INF, NEVER
from runtime.constraints.stn.reach import Reach
from runtime.plan.tags import DURATION, END, FLAG_FACT, FLAG_GOAL, FLAG_SENT, LIST_ORDER, LISTS, OBJECT, START
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.flaws.decisions import Decisions


def list_insertions(agenda: Agenda, stack: Decisions, d: int, t: int) -> None:
    """List all insertions of token `t` in the pool of decision `d`, by object, then from left to right."""
    engine = agenda.engine
    stack.begin_pool(d)
    agenda.sequence.look_around(t)
    v = agenda.rows.var0[t] + OBJECT
    o = engine.lb[v]
    while o <= engine.ub[v]:
        if engine.word[v] >= 0:
            o = next_value(engine, v, o)
            if o == NEVER or o > engine.ub[v]:
                break
        if agenda.plan.object_timeline[o]:
            _list_insertions_on(agenda, stack, d, t, o)
        o += 1


def _list_insertions_on(agenda: Agenda, stack: Decisions, d: int, t: int, o: int) -> int:
    """List the insertions of token `t` on object `o` in the pool, also between neighbours that may be too near.

    `first` is the first token that `t` can precede, `behind` how many can precede `t`: along a sequence each answer
    changes only once. EUROPA makes the same tests one by one, from left to right.
    `agenda.sequence.look_around(t)` came before.
    """
    sequence = agenda.sequence
    start = stack.pool_used
    count = sequence.take(o)
    if count == 0:
        stack.add_to_pool(d, o, t, t)
        return 0
    first = _first_apart(agenda, sequence.from_end, START, count, False)
    behind = _count_apart(agenda, sequence.to_start, END, count)
    if (
        agenda.filters.has_scope
        and agenda.engine.lb[agenda.rows.var0[t] + START] >= 0
        and not agenda.rows.flags[t] & FLAG_FACT
    ):
        while first < count and not agenda.filters.scope.may_begin(sequence.tokens[first]):
            first += 1
    if first == 0:
        stack.add_to_pool(d, o, t, sequence.tokens[0])
        first = 1
    for gap in range(first, min(behind, count - 1) + 1):
        stack.add_to_pool(d, o, t, sequence.tokens[gap])
    if behind == count:
        stack.add_to_pool(d, o, sequence.tokens[count - 1], t)
    if agenda.earliest:
        _list_behind_goals(agenda, stack, start, t)
    return 0


def _origin(agenda: Agenda, t: int) -> int:
    """The token that a token goes back to, rule by rule."""
    while agenda.rows.parent[t] >= 0:
        t = agenda.rows.parent[t]
    return t


def _list_behind_goals(agenda: Agenda, stack: Decisions, start: int, t: int) -> None:
    """Let insertions, from index `start` of the pool on, begin behind what goals ask for and what may start before `t`.

    A goal that asked for no later start but waits for such goals comes before `t`, too: equals keep their order. Then
    come the later ones, and the earlier ones from right to left. Who plans for an executive keeps goals from waiting by
    this; otherwise the order is EUROPA's, from left to right. What one goal asks for keeps the order of its asking
    (T-REX tries later places first), and comes behind what owners were asked for before: they do it in this order.
    """
    engine = agenda.engine
    origin = _origin(agenda, t)
    is_child = origin != t and (agenda.rows.flags[origin] & FLAG_GOAL) != 0
    mine = agenda.rows.var0[t] + START
    asked = agenda.rows.var0[origin] + START if is_child else mine
    end = stack.pool_used
    first = start
    free = engine.lb[mine]  # from when on `t` has the timeline, behind all of these
    if end > start + 1:
        before = agenda.rows.link_before[LISTS * stack.pool_after[start] + LIST_ORDER]
        if before >= 0:  # has begun, or has to come before `t` anyway
            free = max(free, engine.lb[agenda.rows.var0[before] + END])
    for at in range(start, end - 1):
        after = stack.pool_after[at]
        theirs = agenda.rows.var0[after]
        begin = engine.lb[theirs + START]
        asker = _origin(agenda, after)
        is_sent = (agenda.rows.flags[after] & FLAG_SENT) != 0
        if not (is_sent or agenda.rows.flags[asker] & FLAG_GOAL):
            continue
        if is_child:
            is_first = engine.base_lower(agenda.rows.var0[asker] + START) <= engine.lb[asked]
        else:
            is_first = after == asker and engine.base_lower(theirs + START) <= engine.lb[asked]
        if begin > free and (not is_first or agenda.filters.scope.may_overtake(t, after)):
            continue
        if not is_child:
            is_first = is_first or begin <= engine.lb[mine]
        if is_first or is_sent:
            first = at + 1
            free = max(free, engine.lb[theirs + END])
    if first > start:
        stack.reverse_pool(first, end)
        stack.reverse_pool(start, end)


def _first_apart(agenda: Agenda, reach: Reach, time: int, count: int, is_reversed: bool) -> int:
    """The first in the sequence whose time (START, END) no path from the token forbids, `count` if none.

    All behind it are apart, too; bounds say so of all from some index on. From there to the left in growing steps, then
    by halving: a question costs more, the farther away it is. `is_reversed`: the sequence is read from its end.
    """
    tokens = agenda.sequence.tokens
    low = 0
    high = count
    while low < high:
        middle = (low + high) >> 1
        t = tokens[count - 1 - middle if is_reversed else middle]
        if reach.is_plain(agenda.rows.var0[t] + time):
            high = middle
        else:
            low = middle + 1
    low = 0
    step = 1
    while low < high:
        middle = max(high - step, low)
        t = tokens[count - 1 - middle if is_reversed else middle]
        if reach.is_apart(agenda.rows.var0[t] + time):
            high = middle
            step *= 2
        else:
            low = middle + 1
            step = (high - low + 1) >> 1
    return high


def _count_apart(agenda: Agenda, reach: Reach, time: int, count: int) -> int:
    """How many of the sequence, from the left, have a time that no path to the token forbids."""
    return count - _first_apart(agenda, reach, time, count, True)


def may_coincide(agenda: Agenda, candidate: int) -> bool:
    """Whether an active token may have the times of the one that is looked around from.

    Of those in a sequence a first part is too early and a last part too late; found once, for all of them.
    """
    sequence = agenda.sequence
    theirs = agenda.rows.var0[candidate]
    if agenda.rows.link_head[LISTS * candidate + LIST_ORDER] < 0:
        return (
            sequence.to_start.is_apart(theirs + START)
            and sequence.from_start.is_apart(theirs + START)
            and sequence.to_end.is_apart(theirs + END)
            and sequence.from_end.is_apart(theirs + END)
        )
    o = agenda.engine.lb[theirs + OBJECT]
    if sequence.range_object != o:
        count = sequence.take(o)
        first = _first_apart(agenda, sequence.from_start, START, count, False)
        first = max(first, _first_apart(agenda, sequence.from_end, END, count, False))
        end = _count_apart(agenda, sequence.to_start, START, count)
        sequence.note_range(o, count, first, min(end, _count_apart(agenda, sequence.to_end, END, count)))
    return not is_out_of_range(agenda, candidate)


def is_out_of_range(agenda: Agenda, candidate: int) -> bool:
    """Whether `may_coincide` says no, as far as that is known without asking the network."""
    sequence = agenda.sequence
    if sequence.range_object < 0 or agenda.engine.lb[agenda.rows.var0[candidate] + OBJECT] != sequence.range_object:
        return False
    if agenda.rows.link_head[LISTS * candidate + LIST_ORDER] < 0:
        return False
    return bool(not sequence.range_first <= sequence.index_of[candidate] < sequence.range_end)


def is_open_insertion(agenda: Agenda, t: int, before: int, after: int) -> bool:
    """Whether an insertion of token `t` is at an end of the sequence, or a gap that may become as long as `t`."""
    engine = agenda.engine
    rows = agenda.rows
    if before != t:
        return True
    previous = rows.link_before[LISTS * after + LIST_ORDER]
    if previous < 0 or after == t:
        return True
    end = rows.var0[previous] + END
    start = rows.var0[after] + START
    if engine.ub[start] < HALF_INF and engine.ub[start] - engine.lb[end] < engine.lb[rows.var0[t] + DURATION]:
        return False
    if not agenda.exact:
        return True
    need = engine.lb[rows.var0[t] + END] - engine.ub[rows.var0[t] + START]
    return agenda.distances.admits(start, end, -max(need, 1))
