"""Timelines: active tokens in a sequence per object, `end <= start` between neighbours, objects fixed.

A pair is one posted `first.end <= second.start`. Neighbours that are separated by an insertion keep theirs.
"""

from runtime.plan.store.links import link, link_by_key, unlink
from runtime.plan.store.plan import Plan
from runtime.plan.store.rows import Rows
from runtime.plan.store.scopes import equate
from runtime.plan.tags import (
    END,
    HEAD_THREAT,
    LIST_ORDER,
    LIST_THREAT,
    LISTS,
    NONE,
    OBJECT,
    SCOPE_INSERTION,
    START,
)


def order(plan: Plan, o: int, before: int, after: int, span: int) -> bool:
    """Put `before` in front of `after` on object `o`; the same token twice: it alone, behind all that are there.

    A token that is not in the sequence yet becomes the neighbour of the other one. Objects that are no timelines have
    no sequence: there only the pair is ordered.
    """
    rows = plan.rows
    head = plan.object_head[o]
    if not plan.object_timeline[o]:
        _fix_object(plan, o, before, span)
        if before != after:
            _fix_object(plan, o, after, span)
            _pair(plan, before, after, span)
        return plan.engine.consistent
    if not _is_sequenced(rows, before):
        is_known = _is_sequenced(rows, after)
        previous = rows.link_before[LISTS * after + LIST_ORDER] if is_known else rows.head_last[head]
        _insert(plan, o, before, previous, span)
    if before == after:
        return plan.engine.consistent
    if not _is_sequenced(rows, after):
        _insert(plan, o, after, before, span)
    elif rows.link_after[LISTS * before + LIST_ORDER] != after or not has_pair(rows, before, after):
        _pair(plan, before, after, span)
    return plan.engine.consistent


def _insert(plan: Plan, o: int, t: int, previous: int, span: int) -> None:
    """Put `t` into the sequence of `o` behind `previous` (NONE: in front), between its neighbours' times."""
    rows = plan.rows
    head = plan.object_head[o]
    link(rows, t, LIST_ORDER, head, previous)
    unlink(rows, t, LIST_THREAT)
    _fix_object(plan, o, t, span)
    if previous >= 0:
        _pair(plan, previous, t, span)
    following = rows.link_after[LISTS * t + LIST_ORDER]
    if following >= 0:
        _pair(plan, t, following, span)


def _fix_object(plan: Plan, o: int, t: int, span: int) -> None:
    """Give `t` the object `o`, unless its object is decided."""
    v = plan.rows.var0[t] + OBJECT
    if not plan.engine.is_decided(v):
        scope = plan.rows.new_scope(SCOPE_INSERTION, t, NONE, NONE, 0, 0)
        equate(plan, scope, v, plan.object_constant[o], span)


def _is_sequenced(rows: Rows, t: int) -> bool:
    """Whether `t` is in the sequence of an object."""
    return rows.link_head[LISTS * t + LIST_ORDER] >= 0


def _pair(plan: Plan, first: int, second: int, span: int) -> None:
    """Post `first.end <= second.start`."""
    rows = plan.rows
    plan.engine.add_edge(rows.var0[second] + START, rows.var0[first] + END, 0, span, first)
    rows.new_pair(first, second, plan.engine.newest_edge)


def has_pair(rows: Rows, first: int, second: int) -> bool:
    """Whether `first.end <= second.start` is posted."""
    p = rows.pairs_out[first]
    while p >= 0 and rows.pair_second[p] != second:
        p = rows.pair_next_out[p]
    return p >= 0


def leave_sequence(plan: Plan, t: int, edges: list[int], span: int) -> None:
    """Take `t` out of its sequence and close the gap (level 0); the edges that go are added to `edges`."""
    rows = plan.rows
    while rows.pairs_out[t] >= 0:
        edges.append(rows.pair_edge[rows.pairs_out[t]])
        rows.drop_pair(rows.pairs_out[t])
    while rows.pairs_in[t] >= 0:
        edges.append(rows.pair_edge[rows.pairs_in[t]])
        rows.drop_pair(rows.pairs_in[t])
    at = LISTS * t + LIST_ORDER
    if rows.link_head[at] >= 0:
        previous = rows.link_before[at]
        following = rows.link_after[at]
        unlink(rows, t, LIST_ORDER)
        if previous >= 0 and following >= 0 and not has_pair(rows, previous, following):
            _pair(plan, previous, following, span)


def has_any_pair(rows: Rows, t: int) -> bool:
    """Whether `t` is ordered against another token."""
    return rows.pairs_out[t] >= 0 or rows.pairs_in[t] >= 0


def await_order(plan: Plan, t: int) -> None:
    """Put an active token back among those that wait for an insertion (threats)."""
    if plan.predicate_timeline[plan.rows.predicate[t]]:
        link_by_key(plan.rows, t, LIST_THREAT, HEAD_THREAT)


def assign_object(plan: Plan, o: int, t: int, span: int) -> bool:
    """Fix the object of `t` without an insertion into the sequence, unless it is the first there."""
    rows = plan.rows
    if rows.head_first[plan.object_head[o]] < 0 and plan.object_timeline[o]:
        _insert(plan, o, t, NONE, span)
    else:
        _fix_object(plan, o, t, span)
    return bool(plan.engine.consistent)
