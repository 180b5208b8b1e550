"""Temporal relations: distances between the times of two tokens."""

from runtime.plan.store.plan import Plan
from runtime.plan.store.scopes import between
from runtime.plan.tags import (
    DURATION,
    DURATION_EQUAL,
    DURATION_ORIGIN_SHORTER,
    DURATION_TARGET_SHORTER,
    INFINITY,
    RELATION_CELLS,
)


def relate(plan: Plan, scope: int, relation: int, origin: int, target: int, at: int, span: int) -> bool:
    """Post `origin relation target`; the relation bounds stand in the code at `at`, their count first."""
    rows = plan.rows
    given = plan.code[at]
    position = plan.relation_start[relation]
    holds = True
    for k in range((plan.relation_start[relation + 1] - position) // RELATION_CELLS):
        cell = position + k * RELATION_CELLS
        earlier = target if plan.relation_distance[cell] else origin
        later = target if plan.relation_distance[cell + 2] else origin
        a = rows.var0[earlier] + plan.relation_distance[cell + 1]
        b = rows.var0[later] + plan.relation_distance[cell + 3]
        lower = plan.relation_distance[cell + 4]
        upper = plan.relation_distance[cell + 5]
        if k < given:
            lower = plan.code[at + 1 + 2 * k]
            upper = plan.code[at + 2 + 2 * k]
        holds = between(plan, scope, a, b, lower, upper, span) and holds
    # Durations follow from the times once these are bounded; with bounds of the dialect they follow from nothing else.
    rule = plan.relation_duration[relation]
    if rule and not given:
        a = rows.var0[target] + DURATION
        b = rows.var0[origin] + DURATION
        if rule == DURATION_EQUAL:
            holds = between(plan, scope, a, b, 0, 0, span) and holds
        elif rule == DURATION_TARGET_SHORTER:
            holds = between(plan, scope, a, b, 0, INFINITY, span) and holds
        elif rule == DURATION_ORIGIN_SHORTER:
            holds = between(plan, scope, b, a, 0, INFINITY, span) and holds
    return holds
