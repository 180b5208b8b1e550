"""Interpreter of bytecode: bodies of predicates when a token is made, rules when it becomes active.

Bodies run from a stack of (position, end, scope), so that a child's own body runs in the middle of the rule that made
it without recursion. Nothing is propagated here, except that edges reach the network at once.
"""

from runtime.constraints.domains.tags import KIND_INT
from runtime.constraints.propagators.opcodes import OP_FREEZE, OP_SAMPLE
from runtime.plan.rules.guards import wait
from runtime.plan.store.operands import operand
from runtime.plan.store.plan import Plan
from runtime.plan.store.scopes import between, constraint, copy_variable, equate, post_two, restrict
from runtime.plan.tags import (
    DO_ASSIGN,
    DO_BETWEEN,
    DO_CHILD,
    DO_FOREACH,
    DO_GUARD,
    DO_POST,
    DO_RELATE,
    DO_SAMPLE,
    DO_USE,
    DO_VARIABLE,
    DURATION,
    END,
    FLAG_CONDITION,
    FLAG_EFFECT,
    HOLDS_USE,
    IN_NONE,
    NONE,
    OBJECT,
    OBJECT_GIVEN,
    OBJECT_OWN,
    ROLE_INTERNAL,
    ROLE_LOCAL,
    START,
)
from runtime.plan.tokens.predicate_hierarchy import own_predicate
from runtime.plan.tokens.relations import relate
from runtime.plan.tokens.tokens import make_token


def run(plan: Plan) -> bool:
    """Carry out what is on the stack; False on a conflict, after which a search drops the rest."""
    rows = plan.rows
    while plan.stack_length:
        top = plan.stack_length - 1
        at = plan.stack_at[top]
        scope = plan.stack_scope[top]
        if plan.stack_slot[top] >= 0:
            rows.set_slot(scope, plan.stack_slot[top], plan.stack_value[top])
            plan.stack_slot[top] = NONE
        if at == plan.stack_end[top]:
            plan.stack_length = top
            continue
        plan.stack_at[top] = at + _step(plan, scope, at)
        if rows.level and not plan.engine.consistent:
            plan.stack_length = 0
            plan.operands_used = 0
            return False
    return plan.engine.consistent


def _step(plan: Plan, scope: int, at: int) -> int:
    """Carry out the instruction at `at`; the number of its cells."""
    code = plan.code[at]
    span = plan.code[at + 1]
    if code == DO_POST:
        return _post(plan, scope, at, span)
    if code == DO_CHILD:
        return _child(plan, scope, at, span)
    if code == DO_BETWEEN:
        return _distance(plan, scope, at, span)
    if code == DO_VARIABLE:
        return _variable(plan, scope, at, span)
    if code == DO_GUARD:
        return _guard(plan, scope, at, span)
    if code == DO_RELATE:
        return _relation(plan, scope, at, span)
    if code == DO_ASSIGN:
        return _assign(plan, scope, at, span)
    if code == DO_SAMPLE:
        return _sample(plan, scope, at, span)
    if code == DO_FOREACH:
        return _loop(plan, scope, at, span)
    if code == DO_USE:
        return _use(plan, scope, at, span)
    slot = plan.code[at + 2]
    v = plan.services.make_object(scope, plan.code[at + 3])
    if slot >= 0:
        plan.rows.set_slot(scope, slot, v)
    return 4


def _variable(plan: Plan, scope: int, at: int, span: int) -> int:
    """Make a local variable."""
    name = plan.code[at + 3]
    v = copy_variable(plan, scope, plan.code[at + 4], ROLE_INTERNAL if name < 0 else ROLE_LOCAL, name)
    if plan.code[at + 5] != IN_NONE:
        source = operand(plan, scope, plan.code[at + 5], plan.code[at + 6], span)
        restrict(plan, scope, v, source, span)
    plan.rows.set_slot(scope, plan.code[at + 2], v)
    return 7


def _post(plan: Plan, scope: int, at: int, span: int) -> int:
    """Post a constraint."""
    count = plan.code[at + 3]
    first = _collect(plan, scope, at + 4, count, span)
    constraint(plan, scope, plan.code[at + 2], first, span)
    return 4 + 2 * count


def _collect(plan: Plan, scope: int, at: int, count: int, span: int) -> int:
    """Put the variables of `count` operands behind the collected ones; finding one may post something itself."""
    first = plan.operands_used
    for i in range(count):
        plan.add_operand(operand(plan, scope, plan.code[at + 2 * i], plan.code[at + 2 * i + 1], span))
    return first


def _distance(plan: Plan, scope: int, at: int, span: int) -> int:
    """Post a distance between two timepoints, or the comparison that it stands for where one is no whole number."""
    a = operand(plan, scope, plan.code[at + 2], plan.code[at + 3], span)
    b = operand(plan, scope, plan.code[at + 4], plan.code[at + 5], span)
    engine = plan.engine
    if engine.kind[a] == KIND_INT and engine.kind[b] == KIND_INT:
        between(plan, scope, a, b, plan.code[at + 6], plan.code[at + 7], span)
    else:
        post_two(plan, scope, plan.code[at + 8], a, b, span)
    return 9


def _relation(plan: Plan, scope: int, at: int, span: int) -> int:
    """Relate two tokens that exist."""
    rows = plan.rows
    tokens = rows.scope_frame[scope] + rows.scope_slots[scope]
    origin = rows.cells[tokens + plan.code[at + 3]]
    target = rows.cells[tokens + plan.code[at + 4]]
    relate(plan, scope, plan.code[at + 2], origin, target, at + 5, span)
    return 6 + 2 * plan.code[at + 5]


def _child(plan: Plan, scope: int, at: int, span: int) -> int:
    """Make a token that the rule asks for."""
    rows = plan.rows
    role = plan.code[at + 5]
    mode = plan.code[at + 6]
    given = NONE
    parent = rows.scope_token[scope]
    if mode == OBJECT_OWN:
        given = rows.var0[parent] + OBJECT
    elif mode == OBJECT_GIVEN:
        given = operand(plan, scope, plan.code[at + 7], plan.code[at + 8], span)
    flags = FLAG_CONDITION if role == 1 else FLAG_EFFECT if role == 2 else 0
    predicate = plan.code[at + 3]
    if mode == OBJECT_OWN:
        predicate = own_predicate(plan, predicate, parent)
    t = make_token(plan, predicate, flags, parent, scope, given, span)
    tokens = rows.scope_slots[scope]
    origin = rows.cells[rows.scope_frame[scope] + tokens + plan.code[at + 10]]
    rows.set_asking(t, plan.code[at + 4], plan.code[at + 9], origin)
    rows.set_slot(scope, tokens + plan.code[at + 2], t)
    relate(plan, scope, plan.code[at + 9], origin, t, at + 11, span)
    return 12 + 2 * plan.code[at + 11]


def _assign(plan: Plan, scope: int, at: int, span: int) -> int:
    """Restrict the base domain of a variable of the token."""
    v = operand(plan, scope, plan.code[at + 2], plan.code[at + 3], span)
    source = operand(plan, scope, plan.code[at + 4], plan.code[at + 5], span)
    restrict(plan, scope, v, source, span)
    return 6


def _sample(plan: Plan, scope: int, at: int, span: int) -> int:
    """Bind a variable to what the environment draws; without a draw it keeps its range."""
    v = operand(plan, scope, plan.code[at + 3], plan.code[at + 4], span)
    value = plan.services.draw(plan.code[at + 2], v)
    if value >= 0:
        post_two(plan, scope, OP_SAMPLE, v, value, span)
        return 5
    prototype = plan.services.sample_range(plan.code[at + 2])
    if prototype >= 0:
        equate(plan, scope, v, copy_variable(plan, scope, prototype, ROLE_INTERNAL, NONE), span)
    return 5


def _loop(plan: Plan, scope: int, at: int, span: int) -> int:
    """Run a block once per object of a domain, in the order of their making, and freeze the domain.

    What stands above the loop counts, so it is propagated first. An open domain stays open.
    """
    v = operand(plan, scope, plan.code[at + 3], plan.code[at + 4], span)
    if not plan.engine.propagate():
        return 6
    block = plan.code[at + 5]
    objects = plan.engine.values_of(v)
    if plan.rows.level > 0:
        base = plan.engine.base_values(v)
        if base is None or len(base) != len(objects):
            plan.loops_read_choices = True
    if not objects:
        return 6
    frozen = plan.engine.new_constant_values(plan.engine.kind[v], objects)
    post_two(plan, scope, OP_FREEZE, v, frozen, span)
    for o in reversed(objects):
        held = plan.object_constant[int(o)]
        plan.push(plan.block_start[block], plan.block_end[block], scope, plan.code[at + 2], held)
    return 6


def _use(plan: Plan, scope: int, at: int, span: int) -> int:
    """Charge a resource without a token."""
    first = _collect(plan, scope, at + 2, 4, span)
    owner = plan.rows.scope_token[scope]
    holder = plan.operands[first]
    quantity = plan.operands[first + 1]
    start = plan.operands[first + 2]
    end = plan.operands[first + 3]
    plan.operands_used = first
    duration = NONE
    if owner >= 0 and start == plan.rows.var0[owner] + START and end == plan.rows.var0[owner] + END:
        duration = plan.rows.var0[owner] + DURATION
    u = plan.resources.add_use(owner, -1, holder, quantity, start, end, duration, plan.rows.level)
    plan.rows.hold(scope, HOLDS_USE, u)
    return 10


def _guard(plan: Plan, scope: int, at: int, span: int) -> int:
    """Make a guard; `fire` runs its branches."""
    count = plan.code[at + 6]
    condition = operand(plan, scope, plan.code[at + 2], plan.code[at + 3], span)
    first = _collect(plan, scope, at + 7, count, span)
    wait(plan, scope, at, condition, first, span)
    return 7 + 2 * count
