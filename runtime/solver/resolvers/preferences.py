"""Sort what handlers with an order of their own offer: values that are listed, tokens to merge with, places."""

from runtime.constraints.domains.tags import KIND_BOOL, KIND_FLOAT, KIND_INT
from runtime.plan.tags import END, START
from runtime.solver.flaws.agenda import Queues
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.flaws.guarding import TRUTHS
from runtime.solver.tags import HANDLER_LISTED, NONE, ORDER_EARLY, ORDER_FAR, ORDER_KEY, ORDER_LATE, ORDER_NEAR


def listed_values(q: Queues, v: int, handler: int) -> list[float]:
    """The values to try: those that the handler lists and the domain has; all of them for a single one."""
    if q.treatments.handler_code[handler] != HANDLER_LISTED or q.filters.is_single(v):
        return list(q.engine.values_of(v))
    found = []
    for text in q.treatments.matching.handlers[handler].values:
        value = value_of(q, v, text)
        if value is not None and q.engine.contains(v, value):
            found.append(value)
    return found


def value_of(q: Queues, v: int, text: str) -> float | None:
    """What `text` means as a value of `v`; None if it is none."""
    if q.engine.kind[v] not in (KIND_BOOL, KIND_INT, KIND_FLOAT):
        return q.treatments.vocabulary.value_number(v, text)
    if text in TRUTHS:
        return TRUTHS[text]
    try:
        return float(text)
    except ValueError:
        return None


def sorted_candidates(q: Queues, t: int, found: list[int], order: int) -> list[int]:
    """Active tokens in the order in which `t` is to be merged with them."""
    return sorted(found, key=lambda other: token_rank(q, t, other, order))


def token_rank(q: Queues, t: int, other: int, order: int) -> int:
    """What sorts tokens: smaller first."""
    start = q.engine.lb[q.rows.var0[other] + START]
    if order == ORDER_EARLY:
        return start
    if order == ORDER_LATE:
        return -start
    if order == ORDER_NEAR:
        return abs(middle(q, t) - middle(q, other))
    if order == ORDER_FAR:
        return -abs(middle(q, t) - middle(q, other))
    return q.rows.key[other]


def middle(q: Queues, t: int) -> int:
    """The middle of the time that a token may take."""
    first = q.engine.lb[q.rows.var0[t] + START]
    return first + (q.engine.ub[q.rows.var0[t] + END] - first) // 2


def sort_places(q: Queues, stack: Decisions, d: int) -> int:
    """Sort the places in the pool of decision `d` as its handler says."""
    first = stack.pool_first[d]
    places = [
        (stack.pool_object[at], stack.pool_before[at], stack.pool_after[at])
        for at in range(first, first + stack.pool_count[d])
    ]
    t = stack.item[d]
    order = q.treatments.token_order[stack.handler[d]]
    places.sort(key=lambda place: place_rank(q, t, place, order))
    for at, place in enumerate(places, first):
        stack.pool_object[at], stack.pool_before[at], stack.pool_after[at] = place
    return 0


def place_rank(q: Queues, t: int, place: tuple[int, int, int], order: int) -> tuple[int, int]:
    """What sorts places: smaller first. The last place of a timeline has no token behind it."""
    o, before, after = place
    is_last = after == t
    if order == ORDER_EARLY:
        return (1, 0) if is_last else (0, q.engine.lb[q.rows.var0[after] + START])
    if order == ORDER_LATE:
        return (0, 0) if is_last else (1, -q.engine.lb[q.rows.var0[after] + START])
    neighbour = before if is_last else after
    return (o if order == ORDER_KEY else NONE, token_rank(q, t, neighbour, order))
