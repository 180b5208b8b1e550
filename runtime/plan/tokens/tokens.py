"""Tokens: a row, consecutive variables, the body of the predicate; an active one puts its rules on the stack."""

from runtime.constraints.propagators.opcodes import OP_TEMPORAL_DISTANCE
from runtime.plan.store.links import link_by_key, unlink
from runtime.plan.store.operands import operand
from runtime.plan.store.plan import Plan
from runtime.plan.store.scopes import constraint, equate, make_closed, make_variable, restrict
from runtime.plan.tags import (
    ACTIVE,
    DURATION,
    END,
    FIRST_PARAMETER,
    FLAG_EVENT,
    FLAG_NATIVE,
    FLAG_REJECTABLE,
    HEAD_OPEN,
    HEAD_THREAT,
    IN_NONE,
    LIST_OPEN,
    LIST_PREDICATE,
    LIST_THREAT,
    NONE,
    OBJECT,
    RESOURCE_HOLDS,
    RESOURCE_PRODUCES,
    ROLE_TOKEN,
    SCOPE_BODY,
    SCOPE_RULE,
    START,
    STATE,
    SYMBOL_ACTIVE,
)
from runtime.plan.tokens.predicate_hierarchy import active_head


def make_token(plan: Plan, predicate: int, flags: int, parent: int, creator: int, given: int, span: int) -> int:
    """Make a token and put its body on the stack; `given` is the variable that holds its object, or NONE."""
    rows = plan.rows
    engine = plan.engine
    flags |= plan.predicate_flags[predicate]
    t = rows.new_token(predicate, flags, parent, creator, span)
    count = plan.parameter_count[predicate]
    first = engine.reserve(FIRST_PARAMETER + count)
    rows.set_variables(t, first, FIRST_PARAMETER + count)
    state = plan.state_prototype
    if flags & FLAG_NATIVE:
        state = plan.native_prototype
    elif flags & FLAG_REJECTABLE:
        state = plan.rejectable_prototype
    make_variable(plan, state, ROLE_TOKEN, t, STATE)
    is_fixed = given >= 0 and engine.is_base_singleton(given)
    holder = plan.class_prototype[plan.predicate_class[predicate]]
    if is_fixed:
        holder = plan.object_constant[int(engine.base_lower(given))]
    make_closed(plan, holder, ROLE_TOKEN, t, OBJECT)
    if engine.lb[first + OBJECT] > engine.ub[first + OBJECT]:
        plan.services.note_homeless(t)
        engine.restrict_base(first + OBJECT, 1.0, 0.0, span, t)
    duration = plan.instant_prototype if flags & FLAG_EVENT else plan.duration_prototype
    make_variable(plan, duration, ROLE_TOKEN, t, DURATION)
    make_variable(plan, plan.time_prototype, ROLE_TOKEN, t, START)
    make_variable(plan, plan.time_prototype, ROLE_TOKEN, t, END)
    start = plan.parameter_start[predicate]
    for k in range(count):
        make_variable(plan, plan.parameter_prototype[start + k], ROLE_TOKEN, t, FIRST_PARAMETER + k)
    size = plan.body_slots[predicate] + plan.body_tokens[predicate]
    scope = rows.new_scope(SCOPE_BODY, t, NONE, NONE, plan.body_slots[predicate], size)
    if size > plan.body_slots[predicate]:
        rows.set_slot(scope, plan.body_slots[predicate], t)
    for k in range(count):
        if plan.parameter_copy_kind[start + k] != IN_NONE:
            value = plan.parameter_copy_value[start + k]
            source = operand(plan, scope, plan.parameter_copy_kind[start + k], value, span)
            restrict(plan, scope, first + FIRST_PARAMETER + k, source, span)
    used = plan.operands_used
    plan.add_operand(first + START)
    plan.add_operand(first + DURATION)
    plan.add_operand(first + END)
    constraint(plan, scope, OP_TEMPORAL_DISTANCE, used, span)
    if given >= 0 and not is_fixed:
        equate(plan, scope, first + OBJECT, given, span)
    link_by_key(rows, t, LIST_OPEN, HEAD_OPEN)
    if flags & FLAG_NATIVE:
        activation(plan, t, span)
    block = plan.body_block[predicate]
    if plan.block_end[block] > plan.block_start[block]:
        plan.push(plan.block_start[block], plan.block_end[block], scope, NONE, NONE)
    return t


def activation(plan: Plan, t: int, span: int) -> bool:
    """Make `t` active and put its rules on the stack, the ancestor's first."""
    rows = plan.rows
    predicate = rows.predicate[t]
    rows.set_status(t, ACTIVE)
    unlink(rows, t, LIST_OPEN)
    link_by_key(rows, t, LIST_PREDICATE, active_head(plan, predicate))
    if plan.predicate_timeline[predicate]:
        link_by_key(rows, t, LIST_THREAT, HEAD_THREAT)
    kind = plan.predicate_resource[predicate]
    if kind:
        first = rows.var0[t]
        sign = 1 if kind == RESOURCE_PRODUCES else -1
        end = first + END if kind == RESOURCE_HOLDS else NONE
        quantity = first + FIRST_PARAMETER
        lasting = first + DURATION if end >= 0 else NONE
        plan.resources.add_use(t, sign, first + OBJECT, quantity, first + START, end, lasting, rows.level)
    holds = plan.engine.decide(rows.var0[t] + STATE, SYMBOL_ACTIVE, span, t)
    made = 0
    for index in range(plan.first_rule[predicate], plan.first_rule[predicate + 1]):
        rule = plan.rule_number[index]
        if plan.rule_declared[rule] <= plan.statement:
            slots = plan.rule_slots[rule]
            s = rows.new_scope(SCOPE_RULE, t, rule, NONE, slots, slots + plan.rule_tokens[rule])
            rows.set_slot(s, slots, t)
            made += 1
    # The latest scope stands first on the token's list: pushed in this order, the ancestor's rule is on top.
    s = rows.scopes[t]
    for _ in range(made):
        block = plan.rule_block[rows.scope_rule[s]]
        plan.push(plan.block_start[block], plan.block_end[block], s, NONE, NONE)
        s = rows.scope_next[s]
    return holds


def take_key(plan: Plan) -> int:
    """A key that no token of the plan has had."""
    key = int(plan.rows.next_key)
    plan.rows.next_key += 1
    return key


def restore_key(plan: Plan, t: int, key: int) -> None:
    """Give a new token a key from before; its own is given back by undoing it, or by `return_key` once it stays."""
    plan.rows.key[t] = key


def return_key(plan: Plan) -> None:
    """Give back the last key that was taken."""
    plan.rows.next_key -= 1
