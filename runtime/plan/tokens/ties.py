"""Ties: whether rules of a token that is over relate variables that may still change; then it cannot be archived yet.

Archiving keeps what a token said as bounds of single variables. `a.end <= b.end` of two children that both outlast it
is no such bound: frozen, it would let one go on when the other has ended, or hold to what was only planned.
"""

from runtime.plan.store.plan import Plan
from runtime.plan.tags import (
    DURATION,
    END,
    HOLDS_CONSTRAINT,
    HOLDS_EDGE,
    MERGED,
    NONE,
    ROLE_LOCAL,
    ROLE_TOKEN,
    SCOPE_INSERTION,
    SCOPE_MERGE,
    START,
)


def ties_what_goes_on(plan: Plan, t: int, tick: int) -> bool:
    """Whether what the rules of `t` posted ties two variables that may still change after `tick`, also by locals."""
    return _has_two_that_go_on(plan, t, tick) and _joins_what_goes_on(plan, t, tick)


def _has_two_that_go_on(plan: Plan, t: int, tick: int) -> bool:
    """Whether the rules of `t` posted anything about two variables that may still change: the usual no, found soon."""
    engine, rows = plan.engine, plan.rows
    only = NONE
    s = rows.scopes[t]
    while s >= 0:
        h = rows.scope_holds[s] if rows.scope_kind[s] not in (SCOPE_MERGE, SCOPE_INSERTION) else NONE
        while h >= 0:
            at, kind = rows.hold_id[h], rows.hold_kind[h]
            count = engine.arity[at] if kind == HOLDS_CONSTRAINT else 2 if kind == HOLDS_EDGE else 0
            for k in range(count):
                if kind == HOLDS_CONSTRAINT:
                    v = engine.slot_variable[engine.first[at] + k]
                else:
                    v = engine.edge_target[at] if k else engine.edge_source[at]
                v = _standing_for(plan, v)
                if v != only and not _is_known(plan, v) and _goes_on(plan, v, tick):
                    if only != NONE:
                        return True
                    only = v
            h = rows.hold_next[h]
        s = rows.scope_next[s]
    return False


def _joins_what_goes_on(plan: Plan, t: int, tick: int) -> bool:
    """Whether two such variables are joined, by what relates them or by what relates others to both."""
    groups: dict[int, int] = {}  # union-find over the variables without a value

    def root(v: int) -> int:
        while groups.setdefault(v, v) != v:
            v = groups[v]
        return v

    for together in _posted(plan, t):
        open_ones = [v for v in (_standing_for(plan, v) for v in together) if not _is_known(plan, v)]
        for v in open_ones[1:]:
            groups[root(v)] = root(open_ones[0])
    going_on = [root(v) for v in groups if _goes_on(plan, v, tick)]
    return len(going_on) > len(set(going_on))


def _posted(plan: Plan, t: int) -> list[list[int]]:
    """The variables of each edge and each constraint that the rules of `t` posted."""
    engine, rows = plan.engine, plan.rows
    found: list[list[int]] = []
    s = rows.scopes[t]
    while s >= 0:
        h = rows.scope_holds[s] if rows.scope_kind[s] not in (SCOPE_MERGE, SCOPE_INSERTION) else NONE
        while h >= 0:
            at = rows.hold_id[h]
            if rows.hold_kind[h] == HOLDS_EDGE:
                found.append([engine.edge_source[at], engine.edge_target[at]])
            elif rows.hold_kind[h] == HOLDS_CONSTRAINT:
                first = engine.first[at]
                found.append([engine.slot_variable[k] for k in range(first, first + engine.arity[at])])
            h = rows.hold_next[h]
        s = rows.scope_next[s]
    return found


def _standing_for(plan: Plan, v: int) -> int:
    """The variable of the active token that `v` of a merged one equals; for a duration from a known start, the end."""
    rows = plan.rows
    if plan.variable_role[v] != ROLE_TOKEN:
        return v
    t = plan.variable_owner[v]
    k = v - rows.var0[t]
    while rows.status[t] == MERGED:
        t = rows.merged_into[t]
    if k == DURATION and plan.engine.is_singleton(rows.var0[t] + START):
        k = END
    return int(rows.var0[t] + k)


def _is_known(plan: Plan, v: int) -> bool:
    return bool(v < 0 or plan.engine.constant[v] or plan.engine.is_singleton(v))


def _goes_on(plan: Plan, v: int, tick: int) -> bool:
    """Whether a variable without a value may still get one: those of what is over keep their domain."""
    if plan.variable_role[v] not in (ROLE_TOKEN, ROLE_LOCAL):
        return True
    return bool(plan.engine.upper(plan.rows.var0[plan.variable_owner[v]] + END) > tick)
