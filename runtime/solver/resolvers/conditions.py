"""Resolvers of open conditions: merge with an active token, activate, support by an action, reject."""

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
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.resolvers.insertions import is_open_insertion, is_out_of_range, list_insertions, may_coincide
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


def mend_open_condition(agenda: Agenda, stack: Decisions, d: int) -> int:
    """Carry out the next resolver of an inactive token: by phase, merge, activate, reject."""
    t = stack.item[d]
    handler = stack.handler[d]
    is_hsts = agenda.table.handler_code[handler] == HANDLER_HSTS
    choice = agenda.table.handler_choice[handler] if is_hsts else 0
    while stack.phase[d] < PHASE_DONE:
        phase = stack.phase[d]
        if is_hsts and choice == ACTIVATE_FIRST and phase < PHASE_REJECT:
            phase = PHASE_ACTIVATE if phase == PHASE_MERGE else PHASE_MERGE
        outcome = NO_CHOICE
        if phase == PHASE_MERGE:
            if choice != ACTIVATE_ONLY or not is_hsts:
                outcome = _mend_by_merging(agenda, stack, d, t)
        elif phase == PHASE_ACTIVATE:
            if choice != MERGE_ONLY or not is_hsts:
                outcome = _mend_by_activating(agenda, stack, d, t)
        elif stack.cursor[d] == NONE and _may_become(agenda, t, SYMBOL_REJECTED):
            if agenda.probing:
                return APPLIED
            stack.choose(d, 0)
            outcome = APPLIED if reject(agenda.plan, t, NONE) else FAILED_CHOICE
        if outcome != NO_CHOICE:
            return outcome
        stack.next_phase(d)
    return NO_CHOICE


def _may_become(agenda: Agenda, t: int, symbol: int) -> bool:
    """Whether a state is still possible for a token."""
    return has_value(agenda.engine, agenda.rows.var0[t] + STATE, symbol)


def _mend_by_merging(agenda: Agenda, stack: Decisions, d: int, t: int) -> int:
    """Merge with the next compatible active token; `cursor` is the last one tried."""
    if not _may_become(agenda, t, SYMBOL_MERGED):
        return NO_CHOICE
    if agenda.table.token_order[stack.handler[d]] != ORDER_KEY:
        return _mend_by_sorted_merging(agenda, stack, d, t)
    agenda.sequence.look_around(t)
    rows = agenda.rows
    candidate = stack.cursor[d]
    if candidate < 0:
        candidate = first_active(agenda.plan, rows.predicate[t])
    else:
        candidate = next_active(agenda.plan, candidate, rows.predicate[t])
    while candidate >= 0:
        if _is_compatible(agenda, t, candidate):
            if agenda.probing:
                return APPLIED
            stack.choose(d, candidate)
            return APPLIED if merge(agenda.plan, t, candidate, NONE) else FAILED_CHOICE
        candidate = next_active(agenda.plan, candidate, rows.predicate[t])
    return NO_CHOICE


def _mend_by_sorted_merging(agenda: Agenda, stack: Decisions, d: int, t: int) -> int:
    """Merge with the next compatible active token in the order of the handler; `cursor` is the last one tried."""
    if stack.cursor[d] < 0:
        agenda.sequence.look_around(t)
        found = []
        candidate = first_active(agenda.plan, agenda.rows.predicate[t])
        while candidate >= 0:
            if _is_compatible(agenda, t, candidate):
                found.append(candidate)
            candidate = next_active(agenda.plan, candidate, agenda.rows.predicate[t])
        stack.lists[d] = sorted_candidates(agenda, t, found, agenda.table.token_order[stack.handler[d]])
    candidates = stack.lists[d]
    at = stack.cursor[d] + 1
    if at >= len(candidates):
        return NO_CHOICE
    if agenda.probing:
        return APPLIED
    stack.choose(d, at)
    return APPLIED if merge(agenda.plan, t, int(candidates[at]), NONE) else FAILED_CHOICE


def _is_compatible(agenda: Agenda, t: int, candidate: int) -> bool:
    """Whether all variables of two tokens intersect, and their times may coincide; `look_around(t)` came before."""
    mine = agenda.rows.var0[t]
    theirs = agenda.rows.var0[candidate]
    engine = agenda.engine
    if engine.lb[mine + START] > engine.ub[theirs + START] or engine.lb[theirs + START] > engine.ub[mine + START]:
        return False
    if is_out_of_range(agenda, candidate):
        return False
    for k in range(OBJECT, agenda.rows.width[t]):
        if not may_be_equal(engine, mine + k, theirs + k):
            return False
    return may_coincide(agenda, candidate)


def _mend_by_activating(agenda: Agenda, stack: Decisions, d: int, t: int) -> int:
    """Activate a token, or have the next action support it; `cursor` counts the ways tried."""
    if not _may_become(agenda, t, SYMBOL_ACTIVE):
        return NO_CHOICE
    is_bounded = agenda.filters.has_scope and not agenda.rows.flags[t] & FLAG_FACT
    if is_bounded and not agenda.filters.scope.may_begin(t):
        return NO_CHOICE  # a dead end asks for the times of a token that is in scope
    way = stack.cursor[d] + 1
    code = agenda.table.handler_code[stack.handler[d]]
    if code == HANDLER_SUPPORT and not agenda.rows.flags[t] & (FLAG_FACT | FLAG_EFFECT):
        first = agenda.supports.first[agenda.rows.predicate[t]]
        count = agenda.supports.first[agenda.rows.predicate[t] + 1] - first
        if count > 0:
            if way >= count:
                return NO_CHOICE
            if agenda.probing:
                return APPLIED
            stack.choose(d, way)
            return _support(agenda, t, agenda.supports.action[first + way], agenda.supports.effect[first + way])
    if way > 0 or (code == HANDLER_HSTS and not _has_insertion(agenda, stack, d, t)):
        return NO_CHOICE
    if agenda.probing:
        return APPLIED
    stack.choose(d, way)
    if not activate(agenda.plan, t, NONE):
        return FAILED_CHOICE
    return FAILED_CHOICE if is_bounded and not agenda.filters.scope.begins_in_time(t) else APPLIED


def _has_insertion(agenda: Agenda, stack: Decisions, d: int, t: int) -> bool:
    """Whether a token has an insertion on some timeline; always true where it needs none."""
    if not agenda.plan.predicate_timeline[agenda.rows.predicate[t]]:
        return True
    list_insertions(agenda, stack, d, t)
    found = False
    for at in range(stack.pool_first[d], stack.pool_first[d] + stack.pool_count[d]):
        if is_open_insertion(agenda, t, stack.pool_before[at], stack.pool_after[at]):
            found = True
            break
    stack.drop_pool(d)
    return found


def _support(agenda: Agenda, t: int, action: int, effect: int) -> int:
    """Activate a token, make and activate an action, and merge the action's `effect`-th fitting effect with it."""
    plan = agenda.plan
    if not activate(plan, t, NONE):
        return FAILED_CHOICE
    agent = make_token(plan, action, FLAG_ACTION, NONE, NONE, NONE, NONE)
    if not activate(plan, agent, NONE):
        return FAILED_CHOICE
    chosen = NONE
    skipped = NONE
    while effect >= 0:
        chosen = NONE
        child = agenda.rows.children[agent]
        while child >= 0:
            if _is_effect_for(agenda, child, t) and (skipped < 0 or agenda.rows.key[child] > agenda.rows.key[skipped]):
                if chosen < 0 or agenda.rows.key[child] < agenda.rows.key[chosen]:
                    chosen = child
            child = agenda.rows.sibling[child]
        if chosen < 0:
            return FAILED_CHOICE
        skipped = chosen
        effect -= 1
    return APPLIED if merge(plan, chosen, t, NONE) else FAILED_CHOICE


def _is_effect_for(agenda: Agenda, child: int, t: int) -> bool:
    """Whether `child` is an effect of the predicate of `t`."""
    return agenda.rows.predicate[child] == agenda.rows.predicate[t] and (agenda.rows.flags[child] & FLAG_EFFECT) != 0
