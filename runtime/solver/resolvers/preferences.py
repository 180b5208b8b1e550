"""Resolver orders that a handler names: values, tokens to merge with, insertions."""

from runtime.constraints.domains.tags import KIND_BOOL, KIND_FLOAT, KIND_INT
from runtime.plan.tags import END, START
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.flaws.guarding import TRUTHS, value_number
from runtime.solver.tags import HANDLER_LISTED, NONE, ORDER_EARLY, ORDER_FAR, ORDER_KEY, ORDER_LATE, ORDER_NEAR


def listed_values(agenda: Agenda, v: int, handler: int) -> list[float]:
    """The values to try: those that the handler lists and the domain has; all of them for a single one."""
    if agenda.table.handler_code[handler] != HANDLER_LISTED or agenda.engine.is_singleton(v):
        return list(agenda.engine.values_of(v))
    found = []
    for text in agenda.table.matching.handlers[handler].values:
        value = _value_of(agenda, v, text)
        if value is not None and agenda.engine.contains(v, value):
            found.append(value)
    return found


def _value_of(agenda: Agenda, v: int, text: str) -> float | None:
    """What `text` means as a value of `v`; None if it is none."""
    if agenda.engine.kind[v] not in (KIND_BOOL, KIND_INT, KIND_FLOAT):
        return value_number(agenda.table.database, v, text)
    if text in TRUTHS:
        return TRUTHS[text]
    try:
        return float(text)
    except ValueError:
        return None


def sorted_candidates(agenda: Agenda, t: int, found: list[int], order: int) -> list[int]:
    """Merge candidates of `t`, in the order of a handler."""
    return sorted(found, key=lambda other: _token_rank(agenda, t, other, order))


def _token_rank(agenda: Agenda, t: int, other: int, order: int) -> int:
    """Sort key of tokens to merge with."""
    start = agenda.engine.lb[agenda.rows.var0[other] + START]
    if order == ORDER_EARLY:
        return start
    if order == ORDER_LATE:
        return -start
    if order == ORDER_NEAR:
        return abs(_middle(agenda, t) - _middle(agenda, other))
    if order == ORDER_FAR:
        return -abs(_middle(agenda, t) - _middle(agenda, other))
    return agenda.rows.key[other]


def _middle(agenda: Agenda, t: int) -> int:
    """The middle of the time that a token may take."""
    first = agenda.engine.lb[agenda.rows.var0[t] + START]
    return first + (agenda.engine.ub[agenda.rows.var0[t] + END] - first) // 2


def sort_insertions(agenda: Agenda, stack: Decisions, d: int) -> None:
    """Sort the insertions in the pool of decision `d` as its handler says."""
    first = stack.pool_first[d]
    insertions = [
        (stack.pool_object[at], stack.pool_before[at], stack.pool_after[at])
        for at in range(first, first + stack.pool_count[d])
    ]
    t = stack.item[d]
    order = agenda.table.token_order[stack.handler[d]]
    stack.begin_pool(d)
    for insertion in sorted(insertions, key=lambda one: _insertion_rank(agenda, t, one, order)):
        stack.add_to_pool(d, *insertion)


def _insertion_rank(agenda: Agenda, t: int, insertion: tuple[int, int, int], order: int) -> tuple[int, int]:
    """Sort key of insertions; the last one of a timeline has no token behind it."""
    o, before, after = insertion
    is_last = after == t
    if order == ORDER_EARLY:
        return (1, 0) if is_last else (0, agenda.engine.lb[agenda.rows.var0[after] + START])
    if order == ORDER_LATE:
        return (0, 0) if is_last else (1, -agenda.engine.lb[agenda.rows.var0[after] + START])
    neighbour = before if is_last else after
    return (o if order == ORDER_KEY else NONE, _token_rank(agenda, t, neighbour, order))
