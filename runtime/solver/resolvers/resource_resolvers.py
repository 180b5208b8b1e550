"""Resolvers of resource flaws: precedences between pairs of uses."""

from runtime.solver.flaws.agenda import Agenda
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.resolvers.pairs import sorted_pairs
from runtime.solver.tags import (
    APPLIED,
    CONCURRENT_FIRST,
    CONCURRENT_ONLY,
    CONSTRAINT_FIRST,
    FAILED_CHOICE,
    NO_CHOICE,
    NONE,
    PRECEDES_FIRST,
)


def mend_resource(agenda: Agenda, stack: Decisions, d: int) -> int:
    """Post the next precedence between uses; `cursor` counts pairs (and kinds of order), row by row of the pool."""
    handler = stack.handler[d]
    by_default = agenda.table.pairs_by_default[handler]
    if agenda.exact and by_default:
        return _mend_in_order_of_ids(agenda, stack, d)
    kinds = agenda.table.handler_constraint[handler]
    rounds = 2 if kinds == PRECEDES_FIRST or kinds == CONCURRENT_FIRST else 1
    if stack.pool_count[d] < 0:
        stack.begin_pool(d)
        if not by_default:
            sorted_pairs(agenda, stack, d)
        elif rounds > 1:
            while _add_useful_pairs(agenda, stack, d):
                pass
    count = stack.pool_count[d]
    step = stack.cursor[d] + 1
    while True:
        if step >= count * rounds:
            # Mostly the first giver serves, so that the pairs of the others are listed when their turn comes.
            if rounds > 1 or not by_default or not _add_useful_pairs(agenda, stack, d):
                return NO_CHOICE
            count = stack.pool_count[d]
        if agenda.table.handler_iterate[handler] == CONSTRAINT_FIRST:
            pair = step // rounds
            turn = step % rounds
        else:
            pair = step % count
            turn = step // count
        at = stack.pool_first[d] + pair
        first = stack.pool_before[at]
        second = stack.pool_after[at]
        if agenda.uses.may_order(stack.item[d], first, second):
            if agenda.probing:
                return APPLIED
            stack.choose(d, step)
            together = kinds == CONCURRENT_ONLY or (kinds == CONCURRENT_FIRST and turn == 0)
            together = together or (kinds == PRECEDES_FIRST and turn == 1)
            return APPLIED if agenda.uses.order(first, second, 1 if together else 0) else FAILED_CHOICE
        step += 1


def _mend_in_order_of_ids(agenda: Agenda, stack: Decisions, d: int) -> int:
    """Order the next pair that EUROPA would: by the first timepoint, then by the second one, as they were made."""
    uses = agenda.uses
    lb = agenda.engine.lb
    ub = agenda.engine.ub
    if stack.pool_count[d] < 0:
        stack.begin_pool(d)
        uses.gather(stack.item[d])
        uses.events.clear()
        for k in range(uses.count):
            uses.events.push(uses.point[k], 0, uses.point[k])
        while uses.events.length:
            stack.add_to_pool(d, 0, uses.events.top_item(), 0)
            uses.events.pop()
    count = stack.pool_count[d]
    base = stack.pool_first[d]
    at = stack.instant[d]
    step = stack.cursor[d] + 1
    while step < count * count:
        first = stack.pool_before[base + step // count]
        second = stack.pool_before[base + step % count]
        is_here = lb[first] <= at <= ub[first] or lb[second] <= at <= ub[second]
        if is_here and lb[second] <= ub[first] and uses.may_order(stack.item[d], first, second):
            if agenda.probing:
                return APPLIED
            stack.choose(d, step)
            return APPLIED if uses.order(first, second, 0) else FAILED_CHOICE
        step += 1
    return NO_CHOICE


def _add_useful_pairs(agenda: Agenda, stack: Decisions, d: int) -> bool:
    """Pair the next giver with all takers: what may give later, before what may take by then; false if none is left.

    No schedule within bounds lacks all pairs: at the last of the takers by then, one of the givers has given. The giver
    that may be first comes first, then the taker that has most time left.
    """
    uses = agenda.uses
    engine = agenda.engine
    at = stack.instant[d]
    grounded = uses.resources.is_grounded(stack.item[d])
    uses.gather(stack.item[d])
    taker = 1 if stack.is_low[d] else 0
    last = NONE
    if stack.pool_count[d] > 0:
        last = stack.pool_before[stack.pool_used - 1]
    giver = NONE
    uses.events.clear()
    for k in range(uses.count):
        v = uses.point[k]
        lower = engine.lb[v]
        if uses.takes[k] == taker:
            if lower <= at:
                uses.events.push(-engine.ub[v], -v, v)
        elif lower > at if grounded else engine.ub[v] > at:
            is_left = last < 0 or lower > engine.lb[last] or (lower == engine.lb[last] and v > last)
            if is_left and (giver < 0 or lower < engine.lb[giver] or (lower == engine.lb[giver] and v < giver)):
                giver = v
    if giver < 0 or uses.events.length == 0:
        return False
    while uses.events.length:
        stack.add_to_pool(d, 0, giver, uses.events.top_item())
        uses.events.pop()
    return True
