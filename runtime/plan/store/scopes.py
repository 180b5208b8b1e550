"""Scopes own what rules make: edges, constraints, variables and decisions; the door to the engine."""

from runtime.constraints.domains.base_domain import is_base_growing
from runtime.constraints.domains.tags import KIND_FLOAT
from runtime.constraints.propagators.opcodes import OP_EQ
from runtime.plan.store.plan import Plan
from runtime.plan.tags import (
    FIRST_WRITTEN,
    HOLDS_CONSTRAINT,
    HOLDS_EDGE,
    HOLDS_RESTRICTION,
    HOLDS_VARIABLES,
    INFINITY,
    NONE,
)


def between(plan: Plan, scope: int, a: int, b: int, lower: int, upper: int, span: int) -> bool:
    """Demand that b - a lies in [lower, upper]."""
    holds = True
    if upper < INFINITY:
        holds = _edge(plan, scope, a, b, upper, span)
    if lower > -INFINITY and (holds or not plan.rows.level):
        holds = _edge(plan, scope, b, a, -lower, span) and holds
    return holds


def _edge(plan: Plan, scope: int, source: int, target: int, weight: int, span: int) -> bool:
    """Demand `target - source <= weight`."""
    rows = plan.rows
    holds = plan.engine.add_edge(source, target, weight, span, rows.scope_token[scope])
    rows.hold(scope, HOLDS_EDGE, plan.engine.newest_edge)
    return holds


def constraint(plan: Plan, scope: int, operation: int, first: int, span: int) -> int:
    """Post a constraint on the operands collected from `first` on, and forget them; its id."""
    rows = plan.rows
    owner = rows.scope_token[scope]
    arguments: list[int] = []
    for position in range(first, plan.operands_used):
        arguments.append(plan.operands[position])
    plan.operands_used = first
    if operation < FIRST_WRITTEN:
        c = plan.engine.post(operation, arguments, span, owner)
    else:
        c = plan.services.post_written(operation - FIRST_WRITTEN, arguments, span, owner)
    rows.hold(scope, HOLDS_CONSTRAINT, c)
    return c


def new_inputs(plan: Plan, condition: int, first: int, count: int) -> int:
    """Take cells for what decides a guard: how many operands from `first` on, its condition, these operands."""
    rows = plan.rows
    start = rows.new_cells(count + 2)
    rows.cells[start] = count
    rows.cells[start + 1] = condition
    for i in range(count):
        rows.cells[start + 2 + i] = plan.operands[first + i]
    return start


def post_two(plan: Plan, scope: int, operation: int, a: int, b: int, span: int) -> int:
    """Post a constraint on two variables."""
    first = plan.operands_used
    plan.add_operand(a)
    plan.add_operand(b)
    return constraint(plan, scope, operation, first, span)


def equate(plan: Plan, scope: int, a: int, b: int, span: int) -> int:
    """Post that two variables are equal."""
    return post_two(plan, scope, OP_EQ, a, b, span)


def decide(plan: Plan, scope: int, v: int, value: float, span: int) -> bool:
    """Specify a variable as long as the scope lives."""
    rows = plan.rows
    holds = plan.engine.decide(v, value, span, rows.scope_token[scope])
    rows.hold(scope, HOLDS_RESTRICTION, plan.engine.newest_restriction)
    return holds


def restrict(plan: Plan, scope: int, v: int, source: int, span: int) -> bool:
    """Intersect the base domain of `v` with that of `source`, as long as the scope lives."""
    rows = plan.rows
    holds = plan.engine.restrict_base_to(v, source, span, rows.scope_token[scope])
    rows.hold(scope, HOLDS_RESTRICTION, plan.engine.newest_restriction)
    return holds


def copy_variable(plan: Plan, scope: int, prototype: int, role: int, name: int) -> int:
    """Make a variable like a prototype, as long as the scope lives."""
    rows = plan.rows
    v = make_variable(plan, prototype, role, rows.scope_token[scope], name)
    rows.hold(scope, HOLDS_VARIABLES, v)
    return v


def make_variable(plan: Plan, prototype: int, role: int, owner: int, name: int) -> int:
    """Make a variable like a prototype."""
    v = _copy(plan, prototype)
    plan.note_variable(v, role, owner, name)
    if plan.engine.is_open[v]:
        plan.services.note_open(v, prototype)
    return v


def make_closed(plan: Plan, prototype: int, role: int, owner: int, name: int) -> int:
    """Make a variable like a prototype as it is now: what joins an open one later is no value of it."""
    engine = plan.engine
    if not engine.is_open[prototype]:
        return make_variable(plan, prototype, role, owner, name)
    values = engine.base_values(prototype) or []
    if plan.rows.level and values:  # nothing joins it in a search
        v = engine.new_like(_closed_twin(plan, prototype, values), NONE, NONE)
    else:
        v = engine.new_values(engine.kind[prototype], values, NONE, NONE)
    plan.note_variable(v, role, owner, name)
    return v


def _closed_twin(plan: Plan, prototype: int, values: list[float]) -> int:
    """A constant with the values that an open prototype lists; it serves until more are listed."""
    twin, count = plan.twins.get(prototype, (NONE, 0))
    if count != len(values):
        twin = plan.engine.new_constant_values(plan.engine.kind[prototype], values)
        plan.twins[prototype] = (twin, len(values))
    return int(twin)


def _copy(plan: Plan, prototype: int) -> int:
    """Make a variable with the base domain of another one, which does not change once it is closed."""
    engine = plan.engine
    kind = engine.kind[prototype]
    if prototype < len(plan.form) and plan.form[prototype]:
        return engine.new_interval(kind, plan.form_lower[prototype], plan.form_upper[prototype], NONE, NONE)
    values = engine.base_values(prototype)
    if is_base_growing(engine, prototype):
        return engine.new_open(kind, values or [], NONE, NONE)
    if values is not None and not _is_gapless(kind, values):
        return engine.new_like(prototype, NONE, NONE)
    lower = values[0] if values else engine.base_lower(prototype)
    upper = values[len(values) - 1] if values else engine.base_upper(prototype)
    plan.note_form(prototype, lower, upper)
    return engine.new_interval(kind, lower, upper, NONE, NONE)


def _is_gapless(kind: int, values: list[float]) -> bool:
    """Whether a sorted set of whole numbers is an interval."""
    return kind != KIND_FLOAT and len(values) > 0 and values[len(values) - 1] - values[0] + 1 == len(values)
