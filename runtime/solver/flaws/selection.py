"""Choose the flaw to mend next, in EUROPA's order: effects of actions, then by priority, manager and key."""

from runtime.plan.tags import ACTIVE, INACTIVE, LIST_ORDER, LISTS
from runtime.solver.flaws.agenda import Queues
from runtime.solver.resolvers.resource_resolvers import select_instant
from runtime.solver.tags import (
    BEST_PRIORITY,
    CUSTOM,
    DROPPED_EFFECT,
    DROPPED_TOKEN,
    DROPPED_VARIABLE,
    NO_PRIORITY,
    NONE,
    OPEN_CONDITION,
    RESOURCE_THREAT,
    THREAT,
    UNBOUND_VARIABLE,
)


def select(q: Queues) -> bool:
    """Find the next flaw of a token or variable and note it in `q.found_*`; False: there is none."""
    q.found_item = NONE
    q.found_priority = NO_PRIORITY
    for manager in range(q.treatments.managers):
        if q.treatments.manager_kind[manager] == OPEN_CONDITION and select_effect(q, manager):
            return True
    if q.has_custom:
        select_custom(q)
    for manager in range(q.treatments.managers):
        if q.found_priority == BEST_PRIORITY:
            break
        if q.treatments.manager_kind[manager] == RESOURCE_THREAT:
            select_instant(q, manager)
            continue
        select_from_heaps(q, manager)
        if q.loose_count:
            select_loose(q, manager)
    return q.found_item >= 0


def select_custom(q: Queues) -> int:
    """Ask the manager that somebody else has added."""
    flaw = q.custom.select()
    if flaw >= 0:
        q.found_manager = NONE
        q.found_kind = CUSTOM
        q.found_item = flaw
        q.found_handler = NONE
        q.found_priority = q.custom.priority()
    return 0


def select_effect(q: Queues, manager: int) -> bool:
    """Find the first effect of an action that is not settled; no filter that changes concerns it."""
    heap = q.effects[manager]
    while heap.length:
        slot = heap.top_item()
        t = slot // q.managers
        if q.rows.key[t] == heap.top_key() and q.rows.status[t] == INACTIVE:
            take(q, manager, t, q.handler_now(q.token_row[slot], t), BEST_PRIORITY)
            return True
        is_stale = q.rows.key[t] != heap.top_key()
        heap.pop()
        if not is_stale:
            q.drop(slot, DROPPED_EFFECT)
    return False


def take(q: Queues, manager: int, item: int, handler: int, priority: float) -> int:
    """Note the best flaw so far."""
    q.found_manager = manager
    q.found_kind = q.treatments.manager_kind[manager]
    q.found_item = item
    q.found_handler = handler
    q.found_priority = priority
    return 0


def select_from_heaps(q: Queues, manager: int) -> int:
    """Compare the best of a manager's heaps with the best so far."""
    first = q.treatments.manager_heap[manager]
    for heap in range(first, first + q.treatments.manager_heaps[manager]):
        priority = q.treatments.heap_priority[heap]
        if priority >= q.found_priority:
            break
        if q.treatments.manager_kind[manager] == UNBOUND_VARIABLE:
            slot = first_variable(q, heap)
            row = q.variable_row[slot] if slot >= 0 else NONE
        else:
            slot = first_token(q, heap, q.treatments.manager_kind[manager])
            row = q.token_row[slot] if slot >= 0 else NONE
        if slot >= 0:
            take(q, manager, slot // q.managers, q.treatments.handler_of[q.treatments.first_handler[row]], priority)
            break
    return 0


def first_token(q: Queues, number: int, kind: int) -> int:
    """The slot on top of a heap of tokens that is a flaw in scope; those above it are dropped or parked."""
    heap = q.heaps[number]
    while heap.length:
        slot = heap.top_item()
        if q.token_key[slot] != heap.top_key():
            heap.pop()
            continue
        t = slot // q.managers
        if not is_token_flaw(q, t, kind):
            heap.pop()
            q.drop(slot, DROPPED_TOKEN)
        elif q.filters.keeps_token(q.token_row[slot], t):
            heap.pop()
            q.park_token(slot)
        else:
            return slot
    return NONE


def first_variable(q: Queues, number: int) -> int:
    """The slot on top of a heap of variables that is a flaw in scope; those above it are dropped or parked."""
    heap = q.heaps[number]
    while heap.length:
        slot = heap.top_item()
        if q.variable_key[slot] != heap.top_key():
            heap.pop()
            continue
        v = slot // q.managers
        row = q.variable_row[slot]
        if not is_variable_flaw(q, v):
            heap.pop()
            q.drop(slot, DROPPED_VARIABLE)
        elif q.filters.keeps_variable(row, v):
            heap.pop()
            q.park_variable(slot, q.filters.token_of(v) if q.filters.waits_for_times(row) else NONE)
        elif q.sorted_by_size[number] and q.rank(v) != heap.top_key():
            heap.pop()
            q.variable_key[slot] = q.rank(v)
            heap.push(q.variable_key[slot], v, slot)
        else:
            return slot
    return NONE


def is_token_flaw(q: Queues, t: int, kind: int) -> bool:
    """Whether a token still is what the manager mends."""
    if kind == THREAT:
        return q.rows.status[t] == ACTIVE and q.rows.link_head[LISTS * t + LIST_ORDER] < 0
    return q.rows.status[t] == INACTIVE


def is_variable_flaw(q: Queues, v: int) -> bool:
    """Whether a variable exists, is not decided, and is one of the plan: tokens out of it decide nothing."""
    if q.engine.kind[v] < 0 or q.is_decided(v):
        return False
    t = q.filters.token_of(v)
    return t < 0 or q.rows.status[t] == ACTIVE


def select_loose(q: Queues, manager: int) -> int:
    """Compare all loose flaws of a manager with the best so far: their handlers and filters may have changed."""
    kind = q.treatments.manager_kind[manager]
    best_tie = 0
    is_mine = q.found_manager == manager and q.found_item >= 0
    if is_mine:
        best_tie = tie(q, q.found_item, kind, q.found_priority)
    for at in range(q.loose_count):
        slot = q.loose_slot[at]
        if slot % q.managers != manager:
            continue
        item = slot // q.managers
        if q.loose_is_variable[at]:
            row = q.variable_row[slot]
            if not is_variable_flaw(q, item) or q.filters.keeps_variable(row, item):
                continue
            handler = q.handler_now(row, q.filters.token_of(item))
        else:
            row = q.token_row[slot]
            if not is_token_flaw(q, item, kind) or q.filters.keeps_token(row, item):
                continue
            handler = q.handler_now(row, item)
        priority = q.treatments.handler_priority[handler]
        own = tie(q, item, kind, priority)
        if priority < q.found_priority or (is_mine and priority == q.found_priority and own < best_tie):
            take(q, manager, item, handler, priority)
            is_mine = True
            best_tie = own
    return 0


def tie(q: Queues, item: int, kind: int, priority: float) -> int:
    """What orders flaws of one manager that have the same priority: smaller first."""
    if kind == UNBOUND_VARIABLE:
        return item if priority == BEST_PRIORITY else q.filters.size(item) * (1 << 24) + item
    return q.rows.key[item] if priority == BEST_PRIORITY else -q.rows.key[item]
