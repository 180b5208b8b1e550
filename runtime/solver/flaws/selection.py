"""Flaw selection in EUROPA's order: effects of actions, then by priority, manager and key."""

from runtime.plan.tags import ACTIVE, INACTIVE, LIST_ORDER, LISTS
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.flaws.resource_selection import select_resource
from runtime.solver.tags import (
    BEST_PRIORITY,
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


def select(agenda: Agenda) -> bool:
    """Find the next flaw of a token or variable and note it in `agenda.found_*`; False: there is none."""
    agenda.found_item = NONE
    agenda.found_priority = NO_PRIORITY
    for manager in range(agenda.table.managers):
        if agenda.table.manager_kind[manager] == OPEN_CONDITION and _select_effect(agenda, manager):
            return True
    for manager in range(agenda.table.managers):
        if agenda.found_priority == BEST_PRIORITY:
            break
        if agenda.table.manager_kind[manager] == RESOURCE_THREAT:
            select_resource(agenda, manager, False)
            continue
        _select_from_heaps(agenda, manager)
        if agenda.dynamic_count:
            _select_dynamic(agenda, manager)
    if agenda.found_item < 0 and agenda.relief is not None:
        for manager in range(agenda.table.managers):
            if agenda.table.manager_kind[manager] == RESOURCE_THREAT:
                select_resource(agenda, manager, True)
    return agenda.found_item >= 0


def _select_effect(agenda: Agenda, manager: int) -> bool:
    """Select the first effect of an action that is open; no filter tested in each step concerns it."""
    heap = agenda.effects[manager]
    while heap.length:
        slot = heap.top_item()
        t = slot // agenda.managers
        if agenda.rows.key[t] == heap.top_key() and agenda.rows.status[t] == INACTIVE:
            agenda.note_flaw(manager, t, agenda.handler_now(agenda.token_row[slot], t), BEST_PRIORITY)
            return True
        is_stale = agenda.rows.key[t] != heap.top_key()
        heap.pop()
        if not is_stale:
            agenda.drop(slot, DROPPED_EFFECT)
    return False


def _select_from_heaps(agenda: Agenda, manager: int) -> None:
    """Compare the best of a manager's heaps with the best so far."""
    first = agenda.table.manager_heap[manager]
    for heap in range(first, first + agenda.table.manager_heaps[manager]):
        priority = agenda.table.heap_priority[heap]
        if priority >= agenda.found_priority:
            break
        if agenda.table.manager_kind[manager] == UNBOUND_VARIABLE:
            slot = _first_variable(agenda, heap)
            row = agenda.variable_row[slot] if slot >= 0 else NONE
        else:
            slot = _first_token(agenda, heap, agenda.table.manager_kind[manager])
            row = agenda.token_row[slot] if slot >= 0 else NONE
        if slot >= 0:
            handler = agenda.table.handler_of[agenda.table.first_handler[row]]
            agenda.note_flaw(manager, slot // agenda.managers, handler, priority)
            break


def _first_token(agenda: Agenda, number: int, kind: int) -> int:
    """The slot on top of a heap of tokens that is a flaw in scope; those above it are dropped or deferred."""
    heap = agenda.heaps[number]
    while heap.length:
        slot = heap.top_item()
        if agenda.token_key[slot] != heap.top_key():
            heap.pop()
            continue
        t = slot // agenda.managers
        if not _is_token_flaw(agenda, t, kind):
            heap.pop()
            agenda.drop(slot, DROPPED_TOKEN)
        elif agenda.filters.keeps_token(agenda.token_row[slot], t):
            heap.pop()
            agenda.defer_token(slot)
        else:
            return slot
    return NONE


def _first_variable(agenda: Agenda, number: int) -> int:
    """The slot on top of a heap of variables that is a flaw in scope; those above it are dropped or deferred."""
    heap = agenda.heaps[number]
    while heap.length:
        slot = heap.top_item()
        if agenda.variable_key[slot] != heap.top_key():
            heap.pop()
            continue
        v = slot // agenda.managers
        row = agenda.variable_row[slot]
        if not _is_variable_flaw(agenda, v):
            heap.pop()
            agenda.drop(slot, DROPPED_VARIABLE)
        elif agenda.filters.keeps_variable(row, v):
            heap.pop()
            agenda.defer_variable(slot, agenda.filters.token_of(v) if agenda.filters.waits_for_times(row) else NONE)
        elif agenda.sorted_by_size[number] and agenda.rank(v) != heap.top_key():
            heap.pop()
            agenda.variable_key[slot] = agenda.rank(v)
            heap.push(agenda.variable_key[slot], v, slot)
        else:
            return slot
    return NONE


def _is_token_flaw(agenda: Agenda, t: int, kind: int) -> bool:
    """Whether a token still is a flaw of a kind."""
    if kind == THREAT:
        return agenda.rows.status[t] == ACTIVE and agenda.rows.link_head[LISTS * t + LIST_ORDER] < 0
    return agenda.rows.status[t] == INACTIVE


def _is_variable_flaw(agenda: Agenda, v: int) -> bool:
    """Whether a variable exists, is not decided, and is one of the plan: tokens out of it decide nothing."""
    if agenda.engine.kind[v] < 0 or agenda.is_decided(v):
        return False
    t = agenda.filters.token_of(v)
    return t < 0 or agenda.rows.status[t] == ACTIVE


def _select_dynamic(agenda: Agenda, manager: int) -> None:
    """Compare all dynamic flaws of a manager with the best so far: their handlers and filters may have changed."""
    kind = agenda.table.manager_kind[manager]
    best_tie = 0
    is_mine = agenda.found_manager == manager and agenda.found_item >= 0
    if is_mine:
        best_tie = _tie(agenda, agenda.found_item, kind, agenda.found_priority)
    for at in range(agenda.dynamic_count):
        slot = agenda.dynamic_slot[at]
        if slot % agenda.managers != manager:
            continue
        item = slot // agenda.managers
        if agenda.dynamic_is_variable[at]:
            row = agenda.variable_row[slot]
            if not _is_variable_flaw(agenda, item) or agenda.filters.keeps_variable(row, item):
                continue
            handler = agenda.handler_now(row, agenda.filters.token_of(item))
        else:
            row = agenda.token_row[slot]
            if not _is_token_flaw(agenda, item, kind) or agenda.filters.keeps_token(row, item):
                continue
            handler = agenda.handler_now(row, item)
        priority = agenda.table.handler_priority[handler]
        own = _tie(agenda, item, kind, priority)
        if priority < agenda.found_priority or (is_mine and priority == agenda.found_priority and own < best_tie):
            agenda.note_flaw(manager, item, handler, priority)
            is_mine = True
            best_tie = own


def _tie(agenda: Agenda, item: int, kind: int, priority: float) -> int:
    """Sort key of flaws of one manager and priority."""
    if kind == UNBOUND_VARIABLE:
        return item if priority == BEST_PRIORITY else agenda.filters.size(item) * (1 << 24) + item
    return agenda.rows.key[item] if priority == BEST_PRIORITY else -agenda.rows.key[item]
