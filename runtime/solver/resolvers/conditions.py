"""Settle open conditions: merge with an active token, activate, let an action support it, or reject."""

from runtime.constraints.domains.bitset import has_value
from runtime.constraints.propagators.logic import may_be_equal
from runtime.plan.lifecycle import activate, merge, reject
from runtime.plan.tags import (
    FLAG_ACTION,
    FLAG_EFFECT,
    FLAG_FACT,
    NONE,
    OBJECT,
    START,
    STATE,
    SYMBOL_ACTIVE,
    SYMBOL_MERGED,
    SYMBOL_REJECTED,
)
from runtime.plan.tokens.predicate_hierarchy import first_active, next_active
from runtime.plan.tokens.tokens import make_token
from runtime.solver.flaws.agenda import Queues
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.resolvers.insertions import fill_places, is_open_place, is_out_of_range, may_coincide
from runtime.solver.resolvers.preferences import sorted_candidates
from runtime.solver.tags import (
    ACTIVATE_FIRST,
    ACTIVATE_ONLY,
    APPLIED,
    FAILED_CHOICE,
    HANDLER_HSTS,
    HANDLER_SUPPORT,
    MERGE_ONLY,
    NO_CHOICE,
    ORDER_KEY,
    PHASE_ACTIVATE,
    PHASE_DONE,
    PHASE_MERGE,
    PHASE_REJECT,
)


def mend_open_condition(q: Queues, stack: Decisions, d: int) -> int:
    """Carry out the next choice for an inactive token: by phase, merge, activate, reject."""
    t = stack.item[d]
    handler = stack.handler[d]
    is_hsts = q.treatments.handler_code[handler] == HANDLER_HSTS
    choice = q.treatments.handler_choice[handler] if is_hsts else 0
    while stack.phase[d] < PHASE_DONE:
        phase = stack.phase[d]
        if is_hsts and choice == ACTIVATE_FIRST and phase < PHASE_REJECT:
            phase = PHASE_ACTIVATE if phase == PHASE_MERGE else PHASE_MERGE
        outcome = NO_CHOICE
        if phase == PHASE_MERGE:
            if choice != ACTIVATE_ONLY or not is_hsts:
                outcome = mend_by_merging(q, stack, d, t)
        elif phase == PHASE_ACTIVATE:
            if choice != MERGE_ONLY or not is_hsts:
                outcome = mend_by_activating(q, stack, d, t)
        elif stack.other[d] == NONE and may_become(q, t, SYMBOL_REJECTED):
            if q.probing:
                return APPLIED
            stack.other[d] = 0
            stack.tries[d] += 1
            outcome = APPLIED if reject(q.plan, t, NONE) else FAILED_CHOICE
        if outcome != NO_CHOICE:
            return outcome
        stack.phase[d] += 1
        stack.cursor[d] = NONE
        stack.other[d] = NONE
    return NO_CHOICE


def may_become(q: Queues, t: int, symbol: int) -> bool:
    """Whether a state is still possible for a token."""
    return has_value(q.engine, q.rows.var0[t] + STATE, symbol)


def mend_by_merging(q: Queues, stack: Decisions, d: int, t: int) -> int:
    """Merge with the next compatible active token; `cursor` is the last one tried."""
    if not may_become(q, t, SYMBOL_MERGED):
        return NO_CHOICE
    if q.treatments.token_order[stack.handler[d]] != ORDER_KEY:
        return mend_by_sorted_merging(q, stack, d, t)
    q.look_around(t)
    rows = q.rows
    candidate = stack.cursor[d]
    if candidate < 0:
        candidate = first_active(q.plan, rows.predicate[t])
    else:
        candidate = next_active(q.plan, candidate, rows.predicate[t])
    while candidate >= 0:
        if is_compatible(q, t, candidate):
            if q.probing:
                return APPLIED
            stack.cursor[d] = candidate
            stack.tries[d] += 1
            return APPLIED if merge(q.plan, t, candidate, NONE) else FAILED_CHOICE
        candidate = next_active(q.plan, candidate, rows.predicate[t])
    return NO_CHOICE


def mend_by_sorted_merging(q: Queues, stack: Decisions, d: int, t: int) -> int:
    """Merge with the next compatible active token in the order of the handler; `cursor` counts them."""
    if stack.cursor[d] < 0:
        q.look_around(t)
        found = []
        candidate = first_active(q.plan, q.rows.predicate[t])
        while candidate >= 0:
            if is_compatible(q, t, candidate):
                found.append(candidate)
            candidate = next_active(q.plan, candidate, q.rows.predicate[t])
        stack.lists[d] = sorted_candidates(q, t, found, q.treatments.token_order[stack.handler[d]])
        stack.cursor[d] = 0
    candidates = stack.lists[d]
    if stack.cursor[d] >= len(candidates):
        return NO_CHOICE
    if q.probing:
        return APPLIED
    candidate = int(candidates[stack.cursor[d]])
    stack.cursor[d] += 1
    stack.tries[d] += 1
    return APPLIED if merge(q.plan, t, candidate, NONE) else FAILED_CHOICE


def is_compatible(q: Queues, t: int, candidate: int) -> bool:
    """Whether all variables of two tokens intersect, and their times can coincide; `q.look_around(t)` came before."""
    mine = q.rows.var0[t]
    theirs = q.rows.var0[candidate]
    engine = q.engine
    if engine.lb[mine + START] > engine.ub[theirs + START] or engine.lb[theirs + START] > engine.ub[mine + START]:
        return False
    if is_out_of_range(q, candidate):
        return False
    for k in range(OBJECT, q.rows.width[t]):
        if not may_be_equal(engine, mine + k, theirs + k):
            return False
    return may_coincide(q, candidate)


def mend_by_activating(q: Queues, stack: Decisions, d: int, t: int) -> int:
    """Activate a token, or have the next action support it; `cursor` counts the ways tried."""
    if not may_become(q, t, SYMBOL_ACTIVE):
        return NO_CHOICE
    way = stack.cursor[d] + 1
    code = q.treatments.handler_code[stack.handler[d]]
    if code == HANDLER_SUPPORT and not q.rows.flags[t] & (FLAG_FACT | FLAG_EFFECT):
        first = q.supports.first[q.rows.predicate[t]]
        count = q.supports.first[q.rows.predicate[t] + 1] - first
        if count > 0:
            if way >= count:
                return NO_CHOICE
            if q.probing:
                return APPLIED
            stack.cursor[d] = way
            stack.tries[d] += 1
            return support(q, t, q.supports.action[first + way], q.supports.effect[first + way])
    if way > 0 or (code == HANDLER_HSTS and not has_place(q, stack, d, t)):
        return NO_CHOICE
    if q.probing:
        return APPLIED
    stack.cursor[d] = way
    stack.tries[d] += 1
    return APPLIED if activate(q.plan, t, NONE) else FAILED_CHOICE


def has_place(q: Queues, stack: Decisions, d: int, t: int) -> bool:
    """Whether a token would find a place on a timeline; always true where it needs none."""
    if not q.plan.predicate_timeline[q.rows.predicate[t]]:
        return True
    stack.pool_count[d] = 0
    fill_places(q, stack, d, t)
    found = False
    for at in range(stack.pool_first[d], stack.pool_first[d] + stack.pool_count[d]):
        if is_open_place(q, t, stack.pool_before[at], stack.pool_after[at]):
            found = True
            break
    stack.pool_count[d] = NONE
    stack.pool_used = stack.pool_first[d]
    return found


def support(q: Queues, t: int, action: int, effect: int) -> int:
    """Activate a token, make and activate an action, and merge the action's `effect`-th fitting effect with it."""
    plan = q.plan
    if not activate(plan, t, NONE):
        return FAILED_CHOICE
    agent = make_token(plan, action, FLAG_ACTION, NONE, NONE, NONE, NONE)
    if not activate(plan, agent, NONE):
        return FAILED_CHOICE
    chosen = NONE
    skipped = NONE
    while effect >= 0:
        chosen = NONE
        child = q.rows.children[agent]
        while child >= 0:
            if is_effect_for(q, child, t) and (skipped < 0 or q.rows.key[child] > q.rows.key[skipped]):
                if chosen < 0 or q.rows.key[child] < q.rows.key[chosen]:
                    chosen = child
            child = q.rows.sibling[child]
        if chosen < 0:
            return FAILED_CHOICE
        skipped = chosen
        effect -= 1
    return APPLIED if merge(plan, chosen, t, NONE) else FAILED_CHOICE


def is_effect_for(q: Queues, child: int, t: int) -> bool:
    """Whether `child` is an effect of the predicate of `t`."""
    return q.rows.predicate[child] == q.rows.predicate[t] and (q.rows.flags[child] & FLAG_EFFECT) != 0
