"""Selection of resource flaws: the instant to mend next, by the order of a ResourceThreatManager."""

from runtime.solver.flaws.agenda import Agenda
from runtime.solver.tags import (
    BEST_PRIORITY,
    NONE,
    PREFER_EARLIEST,
    PREFER_LATEST,
    PREFER_LEAST,
    PREFER_LOWER,
    PREFER_MOST,
    PREFER_UPPER,
    RESOURCE_THREAT,
)


def is_resource_managed(agenda: Agenda, o: int) -> bool:
    """Whether object `o` is a resource, and some manager mends its flaws."""
    if o >= len(agenda.plan.resources.is_resource) or not agenda.plan.resources.is_resource[o]:
        return False
    for manager in range(agenda.table.managers):
        if agenda.table.manager_kind[manager] == RESOURCE_THREAT:
            if agenda.table.resource_row(manager, agenda.plan.object_class[o]) >= 0:
                return True
    return False


def select_resource(agenda: Agenda, manager: int, is_last: bool) -> None:
    """Compare the flaws of all resources with the best flaw so far; `is_last`: those too that may be relieved.

    With `agenda.exact` the worst one by the manager's order, as EUROPA does. Otherwise the first one of the first
    resource: a precedence posted there is not undone by later ones.
    """
    uses = agenda.uses
    is_mine = False
    at = 0
    low = 0
    amount = 0.0
    for o in range(agenda.plan.object_count):
        if o >= len(agenda.plan.resources.is_resource) or not agenda.plan.resources.is_resource[o]:
            continue
        row = agenda.table.resource_row(manager, agenda.plan.object_class[o])
        if row < 0 or (agenda.table.filter_count[row] and not _is_in_scope(agenda, row, o)):
            continue
        handler = agenda.handler_now(row, NONE)
        priority = agenda.table.handler_priority[handler]
        if priority > agenda.found_priority or (priority == agenda.found_priority and not is_mine):
            continue
        takes_first = not agenda.exact or priority == BEST_PRIORITY or agenda.table.prefers_earliest[manager]
        if not uses.find_flaw(o, not takes_first):
            continue
        if not is_last and agenda.relief is not None and agenda.relief.may_come(o, 1 if uses.found_low else -1):
            continue
        is_rival = is_mine and priority == agenda.found_priority
        if is_rival and (not agenda.exact or not _is_better(agenda, manager, at, low, amount)):
            continue
        agenda.note_flaw(manager, o, handler, priority)
        is_mine = True
        at = uses.found_at
        low = uses.found_low
        amount = uses.found_amount
        if priority == BEST_PRIORITY:
            break
    if is_mine:
        agenda.found_at = at
        agenda.found_low = low


def _is_in_scope(agenda: Agenda, row: int, o: int) -> bool:
    """Whether the filters of `row` let through some token that uses resource `o`."""
    uses = agenda.plan.resources
    for u in range(uses.count):
        t = uses.token[u]
        if uses.sign[u] and uses.on[u] == o and t >= 0 and not agenda.filters.keeps_token(row, t):
            return True
    return False


def _is_better(agenda: Agenda, manager: int, other_at: int, other_low: int, other_amount: float) -> bool:
    """Whether the flaw found last comes before another one in the order of a manager."""
    at = agenda.uses.found_at
    low = agenda.uses.found_low
    amount = agenda.uses.found_amount
    for k in range(agenda.table.resource_orders[manager], agenda.table.resource_orders[manager + 1]):
        code = agenda.table.resource_order[k]
        difference = 0.0
        if code == PREFER_EARLIEST:
            difference = other_at - at
        elif code == PREFER_LATEST:
            difference = at - other_at
        elif code == PREFER_MOST:
            difference = amount - other_amount
        elif code == PREFER_LEAST:
            difference = other_amount - amount
        elif code == PREFER_LOWER:
            difference = low - other_low
        elif code == PREFER_UPPER:
            difference = other_low - low
        if difference != 0:
            return difference > 0
    return False
