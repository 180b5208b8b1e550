"""Choose the instant of a resource to mend next, and order pairs of uses there one after the other."""

from runtime.solver.flaws.agenda import Queues
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.resolvers.pairs import sorted_pairs
from runtime.solver.tags import (
    APPLIED,
    BEST_PRIORITY,
    CONCURRENT_FIRST,
    CONCURRENT_ONLY,
    CONSTRAINT_FIRST,
    FAILED_CHOICE,
    NO_CHOICE,
    NONE,
    PRECEDES_FIRST,
    PREFER_EARLIEST,
    PREFER_LATEST,
    PREFER_LEAST,
    PREFER_LOWER,
    PREFER_MOST,
    PREFER_UPPER,
    RESOURCE_THREAT,
)


def is_mended(q: Queues, o: int) -> bool:
    """Whether object `o` is a resource, and some manager sees to it that it is never used too much."""
    if o >= q.plan.resources.object_room or not q.plan.resources.is_resource[o]:
        return False
    for manager in range(q.treatments.managers):
        if q.treatments.manager_kind[manager] == RESOURCE_THREAT:
            if q.treatments.instant_row(manager, q.plan.object_class[o]) >= 0:
                return True
    return False


def select_instant(q: Queues, manager: int) -> int:
    """Compare the instants of all resources with the best flaw so far.

    With `q.exact` the worst instant by the manager's order, as EUROPA does. Otherwise the first one of the first
    resource: whatever is ordered there is not undone by what comes later.
    """
    uses = q.uses
    is_mine = False
    at = 0
    low = 0
    excess = 0.0
    for o in range(q.plan.object_count):
        if o >= q.plan.resources.object_room or not q.plan.resources.is_resource[o]:
            continue
        row = q.treatments.instant_row(manager, q.plan.object_class[o])
        if row < 0 or (q.treatments.filter_count[row] and not is_in_scope(q, row, o)):
            continue
        handler = q.handler_now(row, NONE)
        priority = q.treatments.handler_priority[handler]
        if priority > q.found_priority or (priority == q.found_priority and not is_mine):
            continue
        takes_first = not q.exact or priority == BEST_PRIORITY or q.treatments.prefers_earliest[manager]
        if not (uses.first_flaw(o) if takes_first else uses.worst_flaw(o)):
            continue
        is_rival = is_mine and priority == q.found_priority
        if is_rival and (not q.exact or not is_better(q, manager, at, low, excess)):
            continue
        q.found_manager = manager
        q.found_kind = q.treatments.manager_kind[manager]
        q.found_item = o
        q.found_handler = handler
        q.found_priority = priority
        is_mine = True
        at = uses.found_at
        low = uses.found_low
        excess = uses.found_excess
        if priority == BEST_PRIORITY:
            break
    if is_mine:
        q.found_at = at
        q.found_low = low
    return 0


def is_in_scope(q: Queues, row: int, o: int) -> bool:
    """Whether the filters of `row` let through some token that uses resource `o`."""
    uses = q.plan.resources
    for u in range(uses.count):
        if uses.sign[u] and uses.on[u] == o and uses.token[u] >= 0 and not q.filters.keeps_token(row, uses.token[u]):
            return True
    return False


def is_better(q: Queues, manager: int, other_at: int, other_low: int, other_excess: float) -> bool:
    """Whether the instant that was found comes before another one in the order of a manager."""
    at = q.uses.found_at
    low = q.uses.found_low
    excess = q.uses.found_excess
    for k in range(q.treatments.instant_orders[manager], q.treatments.instant_orders[manager + 1]):
        code = q.treatments.instant_order[k]
        difference = 0.0
        if code == PREFER_EARLIEST:
            difference = other_at - at
        elif code == PREFER_LATEST:
            difference = at - other_at
        elif code == PREFER_MOST:
            difference = excess - other_excess
        elif code == PREFER_LEAST:
            difference = other_excess - excess
        elif code == PREFER_LOWER:
            difference = low - other_low
        elif code == PREFER_UPPER:
            difference = other_low - low
        if difference > 0:
            return True
        if difference < 0:
            return False
    return False


def mend_instant(q: Queues, stack: Decisions, d: int) -> int:
    """Order the next pair of uses; `cursor` counts pairs (and kinds of order), row by row of the pool."""
    handler = stack.handler[d]
    by_default = q.treatments.pairs_by_default[handler]
    if q.exact and by_default:
        return mend_in_order_of_ids(q, stack, d)
    kinds = q.treatments.handler_constraint[handler]
    rounds = 2 if kinds == PRECEDES_FIRST or kinds == CONCURRENT_FIRST else 1
    if stack.pool_count[d] < 0:
        stack.pool_count[d] = 0
        if not by_default:
            sorted_pairs(q, stack, d)
        elif rounds > 1:
            while add_useful_pairs(q, stack, d):
                pass
    count = stack.pool_count[d]
    step = stack.cursor[d] + 1
    while True:
        if step >= count * rounds:
            # Mostly the first giver serves, so that the pairs of the others are listed when their turn comes.
            if rounds > 1 or not by_default or not add_useful_pairs(q, stack, d):
                return NO_CHOICE
            count = stack.pool_count[d]
        if q.treatments.handler_iterate[handler] == CONSTRAINT_FIRST:
            pair = step // rounds
            turn = step % rounds
        else:
            pair = step % count
            turn = step // count
        at = stack.pool_first[d] + pair
        first = stack.pool_before[at]
        second = stack.pool_after[at]
        if q.uses.may_order(stack.item[d], first, second):
            if q.probing:
                return APPLIED
            stack.cursor[d] = step
            stack.tries[d] += 1
            together = kinds == CONCURRENT_ONLY or (kinds == CONCURRENT_FIRST and turn == 0)
            together = together or (kinds == PRECEDES_FIRST and turn == 1)
            return APPLIED if q.uses.order(first, second, 1 if together else 0) else FAILED_CHOICE
        step += 1


def mend_in_order_of_ids(q: Queues, stack: Decisions, d: int) -> int:
    """Order the next pair that EUROPA would: by the first timepoint, then by the second one, as they were made."""
    uses = q.uses
    lb = q.engine.lb
    ub = q.engine.ub
    if stack.pool_count[d] < 0:
        stack.pool_count[d] = 0
        uses.gather(stack.item[d])
        uses.agenda.clear()
        for k in range(uses.count):
            uses.agenda.push(uses.point[k], 0, uses.point[k])
        while uses.agenda.length:
            stack.add_to_pool(d, 0, uses.agenda.top_item(), 0)
            uses.agenda.pop()
    count = stack.pool_count[d]
    base = stack.pool_first[d]
    at = stack.other[d]
    step = stack.cursor[d] + 1
    while step < count * count:
        first = stack.pool_before[base + step // count]
        second = stack.pool_before[base + step % count]
        is_here = lb[first] <= at <= ub[first] or lb[second] <= at <= ub[second]
        if is_here and lb[second] <= ub[first] and uses.may_order(stack.item[d], first, second):
            if q.probing:
                return APPLIED
            stack.cursor[d] = step
            stack.tries[d] += 1
            return APPLIED if uses.order(first, second, 0) else FAILED_CHOICE
        step += 1
    return NO_CHOICE


def add_useful_pairs(q: Queues, stack: Decisions, d: int) -> bool:
    """Pair the next giver with all takers: what may give later, before what may take by then; false if none is left.

    No schedule within bounds lacks all pairs: at the last of the takers by then, one of the givers has given. The giver
    that may be first comes first, then the taker that has most time left.
    """
    uses = q.uses
    engine = q.engine
    at = stack.other[d]
    grounded = uses.grounded[stack.item[d]]
    uses.gather(stack.item[d])
    taker = 1 if stack.phase[d] else 0
    last = NONE
    if stack.pool_count[d] > 0:
        last = stack.pool_before[stack.pool_used - 1]
    giver = NONE
    q.takers.clear()
    for k in range(uses.count):
        v = uses.point[k]
        lower = engine.lb[v]
        if uses.takes[k] == taker:
            if lower <= at:
                q.takers.push(-engine.ub[v], -v, v)
        elif lower > at if grounded else engine.ub[v] > at:
            is_left = last < 0 or lower > engine.lb[last] or (lower == engine.lb[last] and v > last)
            if is_left and (giver < 0 or lower < engine.lb[giver] or (lower == engine.lb[giver] and v < giver)):
                giver = v
    if giver < 0 or q.takers.length == 0:
        return False
    while q.takers.length:
        stack.add_to_pool(d, 0, giver, q.takers.top_item())
        q.takers.pop()
    return True
