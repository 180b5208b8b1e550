"""Retraction at level 0: all that scopes made goes in one sweep, children of their tokens included."""

from runtime.constraints.domains.tags import FLAG_DECISION
from runtime.constraints.propagators.opcodes import OP_WATCH
from runtime.plan.store.links import link_by_key, unlink
from runtime.plan.store.plan import Plan
from runtime.plan.store.rows import take_off
from runtime.plan.tags import (
    ACTIVE,
    BRANCH_WAITING,
    FREED,
    HEAD_OPEN,
    HOLDS_CONSTRAINT,
    HOLDS_EDGE,
    HOLDS_RESTRICTION,
    HOLDS_USE,
    HOLDS_VARIABLES,
    INACTIVE,
    LIST_OPEN,
    LIST_ORDER,
    LIST_PREDICATE,
    LIST_THREAT,
    LISTS,
    MERGED,
    NONE,
    SCOPE_BODY,
    SCOPE_INSERTION,
    SCOPE_MERGE,
    SCOPE_SCRIPT,
    STATE,
)
from runtime.plan.tokens.timelines import await_order, has_any_pair, leave_sequence

_LAST_KIND = SCOPE_SCRIPT  # of scopes


class _Sweep:
    """What is to go: collected first, then handed to the engine at once."""

    def __init__(self) -> None:
        self.edges: list[int] = []
        self.constraints: list[int] = []
        self.restrictions: list[int] = []
        self.variables: list[int] = []
        self.undecided: list[int] = []
        self.scopes: list[int] = []
        self.tokens: list[int] = []  # to be removed; grows while it is walked
        self.reopened: list[int] = []


def cancel(plan: Plan, t: int) -> bool:
    """Make `t` inactive again, with all that followed from its state."""
    sweep = _Sweep()
    _deactivate(plan, t, sweep)
    return _finish(plan, sweep)


def remove_tokens(plan: Plan, tokens: list[int]) -> bool:
    """Take tokens away with all that came with them."""
    sweep = _Sweep()
    sweep.tokens += tokens
    return _finish(plan, sweep)


def retract_branch(plan: Plan, s: int) -> bool:
    """Take back the branch that guard `s` runs."""
    sweep = _Sweep()
    rows = plan.rows
    t = rows.scope_token[s]
    inside = {s}
    doomed = plan.doomed_scopes
    doomed.empty(rows.scope_count)
    for each in reversed(_scopes_of(plan, t)):
        if rows.scope_parent[each] in inside:
            inside.add(each)
            if each != s:
                doomed.add(each)
    _drop_scopes(plan, t, sweep)
    rows.set_branch(s, BRANCH_WAITING)
    return _finish(plan, sweep)


def reset(plan: Plan, v: int) -> bool:
    """Undo the decision of a variable."""
    sweep = _Sweep()
    sweep.undecided.append(v)
    return _finish(plan, sweep)


def free(plan: Plan, first: int, second: int, span: int) -> bool:
    """Undo that `first` was put in front of `second` on a timeline."""
    sweep = _Sweep()
    rows = plan.rows
    p = rows.pairs_out[first]
    while p >= 0:
        after = rows.pair_next_out[p]
        if rows.pair_second[p] == second:
            sweep.edges.append(rows.pair_edge[p])
            rows.drop_pair(p)
        p = after
    for t in (first, second):
        if not has_any_pair(rows, t):
            _doom_scopes(plan, t, SCOPE_INSERTION, SCOPE_INSERTION)
            _drop_scopes(plan, t, sweep)
            if rows.link_head[LISTS * t + LIST_ORDER] >= 0:
                leave_sequence(plan, t, sweep.edges, span)
                await_order(plan, t)
    return _finish(plan, sweep)


def withdraw_refusals(plan: Plan) -> None:
    """Let the next statement mend what resources refuse so far: they are checked again when rules fire."""
    refusals = plan.resources.take_refusals()
    if refusals:
        plan.engine.retract(refusals, [], [], [])


def forget_orders(plan: Plan) -> bool:
    """Take back the precedences between uses of resources that a search has posted, and no rule (level 0)."""
    engine, uses = plan.engine, plan.resources
    edges: list[int] = []
    seen: set[int] = set()  # of variables, which several uses may share; an edge goes out of one
    for u in range(uses.count):
        for v in (uses.start[u], uses.end[u]) if uses.sign[u] else ():
            e = engine.out_head[v] if v >= 0 and v not in seen else NONE
            seen.add(v)
            while e >= 0:
                if engine.edge_owner[e] == NONE and engine.edge_span[e] == NONE:
                    edges.append(e)
                e = engine.out_next[e]
    return not edges or engine.retract([], edges)


def _scopes_of(plan: Plan, t: int) -> list[int]:
    """The scopes of a token, the latest first."""
    rows = plan.rows
    found = []
    s = rows.scopes[t]
    while s >= 0:
        found.append(s)
        s = rows.scope_next[s]
    return found


def _doom_scopes(plan: Plan, t: int, least: int, most: int) -> None:
    """Choose the scopes of `t` that go: those of kinds from `least` to `most`."""
    rows, doomed = plan.rows, plan.doomed_scopes
    doomed.empty(rows.scope_count)
    s = rows.scopes[t]
    while s >= 0:
        if least <= rows.scope_kind[s] <= most:
            doomed.add(s)
        s = rows.scope_next[s]


def _deactivate(plan: Plan, t: int, sweep: _Sweep) -> None:
    """Collect what the state of `t` brought: rules, merge, insertion into a timeline, tokens merged into it."""
    rows = plan.rows
    status = rows.status[t]
    if status == INACTIVE or status == FREED:
        return
    if status == ACTIVE:
        leave_sequence(plan, t, sweep.edges, NONE)
        unlink(rows, t, LIST_PREDICATE)
        unlink(rows, t, LIST_THREAT)
        while rows.merged[t] >= 0:
            _deactivate(plan, rows.merged[t], sweep)
        if plan.predicate_resource[rows.predicate[t]]:
            plan.resources.remove_token(t)
    elif status == MERGED:
        rows.unset_merged(t)
        for v in range(rows.var0[t], rows.var0[t] + rows.width[t]):
            wake_guards(plan, v)
    rows.set_status(t, INACTIVE)
    sweep.undecided.append(rows.var0[t] + STATE)
    sweep.reopened.append(t)
    if rows.scopes[t] >= 0:
        _doom_scopes(plan, t, SCOPE_BODY + 1, _LAST_KIND)
        _drop_scopes(plan, t, sweep)


def wake_guards(plan: Plan, v: int) -> None:
    """Have the guards looked at that wait for `v`: it may be decided no more, even if its values stay as they are."""
    if plan.variable_guards[v]:
        for c in plan.engine.constraints_of(v):
            if plan.engine.op[c] == OP_WATCH:
                plan.enqueue(plan.guard_of[c])


def _drop_scopes(plan: Plan, t: int, sweep: _Sweep) -> None:
    """Collect what doomed scopes of `t` hold, and the children that they made; take them off the token's list."""
    rows, doomed = plan.rows, plan.doomed_scopes
    if not doomed.count:
        return
    s = rows.scopes[t]
    while s >= 0:
        following = rows.scope_next[s]
        if doomed.has(s):
            take_off(rows.scopes, rows.scope_next, t, s)
            _collect_holds(plan, s, sweep)
            sweep.scopes.append(s)
        s = following
    child = rows.children[t]
    while child >= 0:
        creator = rows.creator[child]
        if creator >= 0 and doomed.has(creator):
            sweep.tokens.append(child)
        child = rows.sibling[child]


def _collect_holds(plan: Plan, s: int, sweep: _Sweep) -> None:
    """Collect what one scope holds, and give the holds back."""
    rows = plan.rows
    if rows.scope_watch[s] >= 0:
        plan.end_waiting(rows.scope_watch[s])
    while rows.scope_holds[s] >= 0:
        h = rows.scope_holds[s]
        kind = rows.hold_kind[h]
        if kind == HOLDS_EDGE:
            sweep.edges.append(rows.hold_id[h])
        elif kind == HOLDS_CONSTRAINT:
            c = rows.hold_id[h]
            if rows.scope_kind[s] == SCOPE_MERGE and plan.engine.op[c] == OP_WATCH:
                plan.end_waiting(c)
            sweep.constraints.append(c)
        elif kind == HOLDS_RESTRICTION:
            sweep.restrictions.append(rows.hold_id[h])
        elif kind == HOLDS_VARIABLES:
            sweep.variables.append(rows.hold_id[h])
        elif kind == HOLDS_USE:
            plan.resources.remove_use(rows.hold_id[h])
        rows.drop_hold(s)


def _finish(plan: Plan, sweep: _Sweep) -> bool:
    """Take tokens apart, one after the other with all their children; then let the engine forget everything."""
    engine, rows = plan.engine, plan.rows
    done = 0
    freed: list[int] = []
    while done < len(sweep.tokens):
        t = sweep.tokens[done]
        done += 1
        if rows.status[t] == FREED:
            continue  # named both by itself and as a child of another
        freed.append(t)
        _deactivate(plan, t, sweep)
        if rows.scopes[t] >= 0:
            _doom_scopes(plan, t, SCOPE_BODY, _LAST_KIND)
            _drop_scopes(plan, t, sweep)
        unlink(rows, t, LIST_OPEN)
        rows.set_status(t, FREED)
        for v in range(rows.var0[t], rows.var0[t] + rows.width[t]):
            sweep.variables.append(v)
    gone, limits = plan.gone_variables, plan.gone_restrictions
    gone.empty(engine.variables)
    limits.empty(engine.restrictions_used)
    for v in sweep.variables:
        gone.add(v)
    restrictions: list[int] = []
    for r in sweep.restrictions:
        if not gone.has(engine.restriction_variable[r]) and limits.add(r):
            restrictions.append(r)
    for v in sweep.undecided:
        r = NONE if gone.has(v) else engine.restriction_head[v]
        while r >= 0:
            if engine.restriction_flags[r] & FLAG_DECISION and limits.add(r):
                restrictions.append(r)
            r = engine.restriction_next[r]
    for r in restrictions:
        wake_guards(plan, engine.restriction_variable[r])
    if plan.resources.refusals:
        sweep.constraints += plan.resources.take_refusals()
    if gone.count:
        _forget_foreign(plan, sweep.variables)
    engine.retract(sweep.constraints, sweep.edges, restrictions, sweep.variables)
    for s in sweep.scopes:
        rows.release_scope(s)
    for t in reversed(freed):
        rows.release_token(t)
    for t in sweep.reopened:
        if rows.status[t] == INACTIVE and rows.link_head[LISTS * t + LIST_OPEN] < 0:
            link_by_key(rows, t, LIST_OPEN, HEAD_OPEN)
    return bool(engine.consistent)


def _forget_foreign(plan: Plan, gone: list[int]) -> None:
    """Let scopes of tokens that stay hold nothing that goes with the variables `gone`: its number will be used again.

    A token outlives the one that asked for it, or goes before it, once it stands by itself.
    """
    engine, rows = plan.engine, plan.rows
    edges: set[int] = set()
    constraints: set[int] = set()
    restrictions: set[int] = set()
    owners: dict[int, None] = {}
    for v in gone:
        for k in range(2):
            e = engine.in_head[v] if k else engine.out_head[v]
            while e >= 0:
                owner = engine.edge_owner[e]
                if owner >= 0 and rows.status[owner] != FREED:
                    edges.add(e)
                    owners[owner] = None
                e = engine.in_next[e] if k else engine.out_next[e]
        for k in range(2):
            slot = engine.mute_head[v] if k else engine.watch_head[v]
            while slot >= 0:
                c = engine.slot_constraint[slot]
                owner = engine.owner[c]
                if owner >= 0 and rows.status[owner] != FREED:
                    constraints.add(c)
                    owners[owner] = None
                slot = engine.slot_next[slot]
        r = engine.restriction_head[v]
        while r >= 0:
            owner = engine.restriction_owner[r]
            if owner >= 0 and rows.status[owner] != FREED:
                restrictions.add(r)
                owners[owner] = None
            r = engine.restriction_next[r]
    for t in owners:
        for s in _scopes_of(plan, t):
            _drop_held(plan, s, edges, constraints, restrictions)


def _drop_held(plan: Plan, s: int, edges: set[int], constraints: set[int], restrictions: set[int]) -> None:
    """Take off the list of what scope `s` holds some edges, constraints and restrictions."""
    rows = plan.rows
    watch = rows.scope_watch[s]
    if watch >= 0 and watch in constraints:
        plan.end_waiting(watch)
        rows.forget_watch(s)  # what the guard has chosen stays
    h = rows.scope_holds[s]
    while h >= 0:
        following = rows.hold_next[h]
        kind = rows.hold_kind[h]
        identity = rows.hold_id[h]
        if (
            (kind == HOLDS_EDGE and identity in edges)
            or (kind == HOLDS_CONSTRAINT and identity in constraints)
            or (kind == HOLDS_RESTRICTION and identity in restrictions)
        ):
            rows.take_hold(s, h)
        h = following
