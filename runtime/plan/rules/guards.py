"""Guards: they wait until the variables that decide them are bound, then choose a branch."""

from runtime.constraints.domains.base_domain import is_growing
from runtime.constraints.domains.tags import KIND_OBJECT
from runtime.constraints.propagators.opcodes import OP_WATCH
from runtime.plan.store.operands import member
from runtime.plan.store.plan import Plan
from runtime.plan.store.scopes import constraint, new_inputs
from runtime.plan.tags import BRANCH_ELSE, BRANCH_THEN, BRANCH_WAITING, MERGED, NONE, ROLE_TOKEN, SCOPE_GUARD, STATE


def wait(plan: Plan, scope: int, at: int, condition: int, first: int, span: int) -> None:
    """Make a guard of the instruction at `at`, with the frame as it is now; operands from `first` on decide it."""
    rows = plan.rows
    owner = rows.scope_token[scope]
    s = rows.new_scope(
        SCOPE_GUARD, owner, rows.scope_rule[scope], scope, rows.scope_slots[scope], rows.scope_size[scope]
    )
    count = plan.operands_used - first
    inputs = new_inputs(plan, condition, first, count)
    plan.operands_used = first
    _listen(plan, condition)
    for i in range(count):
        _listen(plan, rows.cells[inputs + 2 + i])
    for position in range(first, plan.operands_used):
        plan.await_variable(plan.operands[position])
    watch = constraint(plan, s, OP_WATCH, first, span)
    plan.note_watch(watch, s)
    rows.set_guard(s, at, inputs, watch)
    plan.enqueue(s)


def _listen(plan: Plan, v: int) -> None:
    """Note `v` among the operands unless it is a constant; for a proxy its object, and the members it may be."""
    if not plan.engine.constant[v]:
        while plan.proxy_index[v] >= 0:
            x = plan.proxy_index[v]
            for o in plan.engine.values_of(x):
                plan.add_operand(member(plan, int(o), plan.proxy_member[v]))
            v = x
        plan.add_operand(v)
        if _standing(plan, v) != v:
            plan.add_operand(_standing(plan, v))


def _standing(plan: Plan, v: int) -> int:
    """The variable that stands for `v`: another one if its token is merged."""
    if plan.variable_role[v] == ROLE_TOKEN:
        t = plan.variable_owner[v]
        if plan.rows.status[t] == MERGED:
            return plan.rows.var0[plan.rows.merged_into[t]] + v - plan.rows.var0[t]
    return v


def follow(plan: Plan, scope: int, v: int, other: int, span: int) -> None:
    """Have the guards that wait for `v` wait for `other` as well: `v` was merged into it."""
    for c in plan.engine.constraints_of(v):
        if plan.engine.op[c] == OP_WATCH:
            plan.await_variable(other)
            plan.add_operand(other)
            plan.note_watch(constraint(plan, scope, OP_WATCH, plan.operands_used - 1, span), plan.guard_of[c])


def deciders(plan: Plan, c: int) -> list[int]:
    """What decides the guard that waits with `c`; for a merged token also what stands for it, and its state."""
    found: list[int] = []
    for v in plan.engine.arguments(c):
        found.append(v)
        if _standing(plan, v) != v:
            found.append(_standing(plan, v))
            found.append(plan.rows.var0[plan.variable_owner[v]] + STATE)
    return found


def _is_bound(plan: Plan, v: int) -> bool:
    """Whether `v` is decided; a proxy is once its object and the member it then stands for are.

    It also is while all objects agree: their members have the same single value. Recursion is as deep as the path.
    A variable of a merged token is as that which stands for it.
    The clock of an agent counts as decided: what has come to be true of "now or later" stays true.
    """
    if plan.engine.constant[v]:
        return plan.engine.is_decided(v)
    if _standing(plan, v) != v:
        return plan.engine.is_decided(_standing(plan, v))
    x = plan.proxy_index[v]
    if x < 0:
        return v == plan.clock or plan.engine.is_decided(v)
    if _is_bound(plan, x):
        return plan.engine.is_decided(member(plan, plan.engine.lb[x], plan.proxy_member[v]))
    return plan.proxy_index[x] < 0 and _agree(plan, x, plan.proxy_member[v])


def _agree(plan: Plan, x: int, name: int) -> bool:
    """Whether the members called `name` of all objects that `x` may be are decided and equal."""
    engine = plan.engine
    first = NONE
    for o in engine.values_of(x):
        v = member(plan, int(o), name)
        if v < 0 or not engine.is_decided(v) or (first >= 0 and engine.lower(first) != engine.lower(v)):
            return False
        first = v
    return first >= 0 and not is_growing(engine, x)


def choice(plan: Plan, s: int) -> int:
    """The branch that guard `s` asks for now."""
    rows = plan.rows
    inputs = rows.scope_inputs[s]
    engine = plan.engine
    condition = rows.cells[inputs + 1]
    if engine.lb[condition] != engine.ub[condition]:
        return BRANCH_WAITING
    for i in range(inputs + 2, inputs + 2 + rows.cells[inputs]):
        if not _is_bound(plan, rows.cells[i]):
            return BRANCH_WAITING
    # An object that is known is there, whatever its number.
    holds = engine.kind[condition] == KIND_OBJECT or engine.lb[condition] != 0
    return BRANCH_THEN if holds else BRANCH_ELSE
