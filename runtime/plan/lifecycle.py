"""Fire rules to a fixpoint after a change, and change the states of tokens: activate, merge, reject."""

from runtime.constraints.stn.entailment import entail_distance
from runtime.plan.rules.guards import choice, follow
from runtime.plan.rules.rule_interpreter import run
from runtime.plan.store.links import unlink
from runtime.plan.store.plan import Plan
from runtime.plan.store.scopes import between, decide, equate
from runtime.plan.tags import (
    BRANCH_THEN,
    BRANCH_WAITING,
    DURATION,
    END,
    LIST_OPEN,
    MERGED,
    NONE,
    OBJECT,
    REJECTED,
    SCOPE_BRANCH,
    SCOPE_MERGE,
    START,
    STATE,
    SYMBOL_MERGED,
    SYMBOL_REJECTED,
)
from runtime.plan.tokens.retraction import retract_branch
from runtime.plan.tokens.tokens import activation


def fire(plan: Plan) -> bool:
    """Run the rules on the stack, propagate, decide guards, until a fixpoint; False on a conflict."""
    engine = plan.engine
    if plan.stack_length and not run(plan) and plan.rows.level:
        return False
    if plan.resources.postponed:
        plan.resources.resume()
    while engine.propagate():
        plan.gather_woken()
        if plan.queue_length == 0:
            if plan.resources.is_quiet():
                return True
            if not plan.resources.check(plan.envelope, plan.rows.level):
                return False
            continue
        count = plan.queue_length
        for i in range(count):
            _decide_guard(plan, plan.queue[i])
        plan.keep_queued(count)
        if not run(plan):
            break
    return False


def _decide_guard(plan: Plan, s: int) -> None:
    """Put the branch that guard `s` asks for on the stack, and take back another one that ran before (level 0)."""
    rows = plan.rows
    if rows.scope_watch[s] < 0:
        return
    branch = choice(plan, s)
    old = rows.scope_branch[s]
    if branch == old:
        return
    if old != BRANCH_WAITING:
        retract_branch(plan, s)
    rows.set_branch(s, branch)
    if branch == BRANCH_WAITING:
        return
    at = rows.scope_at[s]
    block = plan.code[at + 4] if branch == BRANCH_THEN else plan.code[at + 5]
    if plan.block_end[block] == plan.block_start[block]:
        return
    t = rows.scope_token[s]
    b = rows.new_scope(SCOPE_BRANCH, t, rows.scope_rule[s], s, rows.scope_slots[s], rows.scope_size[s])
    plan.push(plan.block_start[block], plan.block_end[block], b, NONE, NONE)


def activate(plan: Plan, t: int, span: int) -> bool:
    """Make an inactive token active and let its rules fire."""
    activation(plan, t, span)
    return fire(plan)


def merge(plan: Plan, t: int, other: int, span: int) -> bool:
    """Make an inactive token stand for an active one: all their variables are equal, what decides one decides both."""
    rows = plan.rows
    engine = plan.engine
    rows.set_status(t, MERGED)
    rows.set_merged(t, other)
    unlink(rows, t, LIST_OPEN)
    scope = rows.new_scope(SCOPE_MERGE, t, NONE, NONE, 0, 0)
    engine.decide(rows.var0[t] + STATE, SYMBOL_MERGED, span, t)
    mine = rows.var0[t]
    theirs = rows.var0[other]
    for k in range(OBJECT, rows.width[t]):
        a = mine + k
        b = theirs + k
        if k == DURATION or k == START or k == END:
            between(plan, scope, a, b, 0, 0, span)
        else:
            equate(plan, scope, a, b, span)
        if engine.is_decided(a) and not engine.is_decided(b) and engine.is_singleton(a):
            decide(plan, scope, b, engine.lower(a), _word(plan, a, span))
        if plan.variable_guards[a]:
            follow(plan, scope, a, b, span)
        if rows.level and not engine.consistent:
            return False
    if rows.level:
        entail_distance(engine, mine + DURATION)
    return fire(plan)


def _word(plan: Plan, v: int, span: int) -> int:
    """The span under which somebody outside of the plan gave a variable its value; `span` where nobody did."""
    engine = plan.engine
    r = engine.restriction_head[v]
    while r >= 0:
        if engine.restriction_span[r] < NONE:
            return engine.restriction_span[r]
        r = engine.restriction_next[r]
    return span


def reject(plan: Plan, t: int, span: int) -> bool:
    """Drop a rejectable token."""
    rows = plan.rows
    rows.set_status(t, REJECTED)
    unlink(rows, t, LIST_OPEN)
    plan.engine.decide(rows.var0[t] + STATE, SYMBOL_REJECTED, span, t)
    return fire(plan)
