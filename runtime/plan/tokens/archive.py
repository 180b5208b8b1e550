"""Archive: tokens that are over leave the plan; what they implied for others stays as base bounds (level 0).

A token may go when nothing that still can change hangs on it: its parent goes too or is gone, so do the tokens merged
into it, its children go or have begun, none of its guards waits, and its rules tie no two variables that may change. A
child that is merged into a token which has begun goes with its parent, however long the other lasts. What went told
others is kept by restrictions that bear the span of the edge or constraint which said so, so explanations name the
same lines.
"""

from array import array
from collections.abc import Callable

from runtime.constraints.domains.arrays import grow_rows
from runtime.constraints.domains.sparse_set import SparseSet
from runtime.constraints.domains.tags import (
    FLAG_FROZEN,
    KIND_FLOAT,
    SUPPORT_CONSTRAINT,
    SUPPORT_EDGE,
    SUPPORT_RESTRICTION,
)
from runtime.plan.store.plan import Plan
from runtime.plan.tags import (
    ACTIVE,
    BRANCH_WAITING,
    END,
    HOLDS_CONSTRAINT,
    HOLDS_EDGE,
    HOLDS_RESTRICTION,
    HOLDS_VARIABLES,
    MERGED,
    NONE,
    ROLE_LOCAL,
    ROLE_TOKEN,
    SCOPE_GUARD,
    START,
)
from runtime.plan.tokens.retraction import remove_tokens
from runtime.plan.tokens.ties import ties_what_goes_on


class Leaving:
    """What goes with tokens that leave, and what is near it; the sets are made once and filled anew each time."""

    def __init__(self) -> None:
        self.variables = SparseSet(256)
        self.supports = SparseSet(256)
        self.near = SparseSet(256)
        self.tokens = SparseSet(256)
        self.doomed = array("b", bytes(256))  # by token


def archive(
    plan: Plan, tokens: list[int], tick: int, leaving: Leaving, record: Callable[[list[int], int], None]
) -> int:
    """Take out those of `tokens`, which are over at `tick`, that may go, `record` them before; how many went."""
    going = _removable(plan, tokens, tick, leaving)
    if not going:
        return 0
    record(going, tick)
    frozen = _freeze(plan, going, leaving)
    for t in going:
        _orphan(plan, t, leaving.doomed)
    remove_tokens(plan, going)
    needless = [r for v in frozen for r in _outdone(plan, v)]
    if needless:
        plan.engine.retract((), (), needless, ())
    return len(going)


def _removable(plan: Plan, tokens: list[int], tick: int, leaving: Leaving) -> list[int]:
    """The largest part of `tokens` of which no member is needed by a token outside; `leaving.doomed` marks it."""
    rows = plan.rows
    known = leaving.tokens
    known.empty(rows.token_count)
    for t in tokens:
        known.add(t)
    for t in tokens:
        child = rows.children[t]
        while child >= 0:
            if rows.status[child] == MERGED and _has_begun(plan, rows.merged_into[child], tick):
                known.add(child)
            child = rows.sibling[child]
    if len(leaving.doomed) < rows.token_count:
        grow_rows(leaving, "doomed", 2 * rows.token_count)
    doomed = leaving.doomed
    for t in range(rows.token_count):
        doomed[t] = 0
    for i in range(known.count):
        t = known.items[i]
        doomed[t] = not plan.predicate_resource[rows.predicate[t]] and not _has_waiting_guard(plan, t)
    _keep_needed(plan, known, doomed, tick)
    is_tied = False
    for i in range(known.count):
        t = known.items[i]
        if doomed[t] and _has_child_that_goes_on(plan, t, tick) and ties_what_goes_on(plan, t, tick):
            doomed[t] = 0
            is_tied = True
    if is_tied:
        _keep_needed(plan, known, doomed, tick)
    found: list[int] = []
    for i in range(known.count):
        if doomed[known.items[i]]:
            found.append(known.items[i])
    return found


def _keep_needed(plan: Plan, known: SparseSet, doomed: "array[int]", tick: int) -> None:
    """Spare those of the doomed tokens on which something hangs that stays."""
    changed = True
    while changed:
        changed = False
        for i in range(known.count):
            t = known.items[i]
            if doomed[t] and not _is_free(plan, t, doomed, tick):
                doomed[t] = 0
                changed = True


def _is_free(plan: Plan, t: int, doomed: "array[int]", tick: int) -> bool:
    """Whether `t` can go together with the other `doomed` tokens."""
    rows = plan.rows
    if rows.parent[t] >= 0 and not doomed[rows.parent[t]]:
        return False
    if rows.status[t] == MERGED and not doomed[rows.merged_into[t]]:
        if rows.parent[t] < 0 or not _has_begun(plan, rows.merged_into[t], tick):
            return False
    other = rows.merged[t]
    while other >= 0:
        if not doomed[other]:
            return False
        other = rows.merged_next[other]
    child = rows.children[t]
    while child >= 0:
        if not doomed[child]:
            is_planned = rows.status[child] == ACTIVE or rows.status[child] == MERGED
            if not is_planned or plan.engine.upper(rows.var0[child] + START) > tick:
                return False
        child = rows.sibling[child]
    return True


def _has_begun(plan: Plan, t: int, tick: int) -> bool:
    """Whether `t` is in the plan and began at `tick` or before."""
    return bool(plan.rows.status[t] == ACTIVE and plan.engine.upper(plan.rows.var0[t] + START) <= tick)


def _has_waiting_guard(plan: Plan, t: int) -> bool:
    """Whether a part of the rules of `t` may still come."""
    rows = plan.rows
    s = rows.scopes[t]
    while s >= 0:
        if rows.scope_kind[s] == SCOPE_GUARD and rows.scope_branch[s] == BRANCH_WAITING:
            return True
        s = rows.scope_next[s]
    return False


def _has_child_that_goes_on(plan: Plan, t: int, tick: int) -> bool:
    """Whether a child of `t`, or what it is merged into, ends after `tick`."""
    rows = plan.rows
    child = rows.children[t]
    while child >= 0:
        if plan.engine.upper(rows.var0[child] + END) > tick:
            return True
        child = rows.sibling[child]
    return False


def _orphan(plan: Plan, t: int, doomed: "array[int]") -> None:
    """Let the children of `t` that stay stand by themselves."""
    child = plan.rows.children[t]
    while child >= 0:
        following = plan.rows.sibling[child]
        if not doomed[child]:
            plan.rows.detach(child)
        child = following


def detach(plan: Plan, t: int) -> None:
    """Let `t` stand by itself: it no longer goes when the token that asked for it does."""
    if plan.rows.parent[t] >= 0:
        plan.rows.detach(t)


def _freeze(plan: Plan, doomed: list[int], leaving: Leaving) -> list[int]:
    """Put into base domains what edges and constraints that go with the `doomed` tokens say of other variables.

    Gives the variables that have got new limits.
    """
    engine = plan.engine
    gone, going, near = leaving.variables, leaving.supports, leaving.near
    gone.empty(engine.variables)
    going.empty(4 * max(engine.edges_used, engine.constraints_used, engine.restrictions_used) + 4)
    near.empty(engine.variables)
    _gather(plan, doomed, gone, going)
    for i in range(going.count):
        if going.items[i] & 3 == SUPPORT_EDGE:
            near.add(engine.edge_source[going.items[i] >> 2])
            near.add(engine.edge_target[going.items[i] >> 2])
    for i in range(going.count):
        if going.items[i] & 3 == SUPPORT_CONSTRAINT:
            c = going.items[i] >> 2
            for k in range(engine.first[c], engine.first[c] + engine.arity[c]):
                near.add(engine.slot_variable[k])
    for i in range(going.count):
        if going.items[i] & 3 == SUPPORT_RESTRICTION:
            near.add(engine.restriction_variable[going.items[i] >> 2])
    limited: list[int] = []
    for i in range(near.count):
        v = near.items[i]
        if not gone.has(v) and not engine.constant[v] and _keep_domain(plan, v, going):
            limited.append(v)
    return limited


def _outdone(plan: Plan, v: int) -> list[int]:
    """The limits of `v` that stand for what was forgotten and that a later one of them has made needless."""
    engine = plan.engine
    found = []
    lower, upper = -float("inf"), float("inf")
    for r in engine.restrictions_of(v):  # the newest first
        if engine.restriction_flags[r] & FLAG_FROZEN:
            if engine.restriction_lo[r] <= lower and engine.restriction_hi[r] >= upper:
                found.append(r)
            lower = max(lower, engine.restriction_lo[r])
            upper = min(upper, engine.restriction_hi[r])
    return found


def _gather(plan: Plan, doomed: list[int], gone: SparseSet, going: SparseSet) -> None:
    """Gather the variables that go, and in `going` what the edges, constraints and restrictions support by that go."""
    engine, rows = plan.engine, plan.rows
    for t in doomed:
        for v in range(rows.var0[t], rows.var0[t] + rows.width[t]):
            gone.add(v)
        s = rows.scopes[t]
        while s >= 0:
            h = rows.scope_holds[s]
            while h >= 0:
                kind = rows.hold_kind[h]
                if kind == HOLDS_EDGE:
                    going.add(rows.hold_id[h] * 4 + SUPPORT_EDGE)
                elif kind == HOLDS_CONSTRAINT:
                    going.add(rows.hold_id[h] * 4 + SUPPORT_CONSTRAINT)
                elif kind == HOLDS_RESTRICTION:
                    going.add(rows.hold_id[h] * 4 + SUPPORT_RESTRICTION)
                elif kind == HOLDS_VARIABLES:
                    gone.add(rows.hold_id[h])
                h = rows.hold_next[h]
            s = rows.scope_next[s]
    for i in range(gone.count):
        v = gone.items[i]
        for k in range(2):
            slot = engine.mute_head[v] if k else engine.watch_head[v]
            while slot >= 0:
                going.add(engine.slot_constraint[slot] * 4 + SUPPORT_CONSTRAINT)
                slot = engine.slot_next[slot]
        e = engine.out_head[v]
        while e >= 0:
            going.add(e * 4 + SUPPORT_EDGE)
            e = engine.out_next[e]
        e = engine.in_head[v]
        while e >= 0:
            going.add(e * 4 + SUPPORT_EDGE)
            e = engine.in_next[e]
    for i in range(going.count):
        if going.items[i] & 3 == SUPPORT_CONSTRAINT:
            c = going.items[i] >> 2
            if engine.link_a[c] >= 0:
                going.add(engine.link_a[c] * 4 + SUPPORT_EDGE)
            if engine.link_b[c] >= 0:
                going.add(engine.link_b[c] * 4 + SUPPORT_EDGE)


def _keep_domain(plan: Plan, v: int, going: SparseSet) -> bool:
    """Restrict `v` to its present domain where that rests on what is `going`; the token of `v` answers for it.

    Tells whether it has got a limit.
    """
    engine = plan.engine
    owner = plan.variable_owner[v] if plan.variable_role[v] in (ROLE_TOKEN, ROLE_LOCAL) else NONE
    lower, upper = engine.lower_support[v], engine.upper_support[v]
    is_lower_going = lower >= 0 and going.has(lower)
    is_upper_going = upper >= 0 and going.has(upper)
    if engine.word[v] >= 0:
        base = engine.base_values(v)
        values = [float(x) for x in engine.values_of(v)]
        if base is None or len(values) < len(base):
            span = _span_of(plan, lower if is_lower_going else upper)
            engine.restrict_base_values(v, values, span, owner)
        return False
    is_real = engine.kind[v] == KIND_FLOAT
    if is_lower_going:
        bound = engine.flo[v] if is_real else engine.lower(v)
        engine.freeze_base(v, bound, float("inf"), _span_of(plan, lower), owner)
    if is_upper_going:
        bound = engine.fhi[v] if is_real else engine.upper(v)
        engine.freeze_base(v, -float("inf"), bound, _span_of(plan, upper), owner)
    return is_lower_going or is_upper_going


def _span_of(plan: Plan, support: int) -> int:
    """The span of an edge, a constraint or a restriction."""
    engine = plan.engine
    kind, identity = support & 3, support >> 2
    if support < 0:
        return NONE
    if kind == SUPPORT_EDGE:
        return int(engine.edge_span[identity])
    if kind == SUPPORT_CONSTRAINT:
        return int(engine.span[identity])
    return int(engine.restriction_span[identity])
