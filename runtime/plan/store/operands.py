"""Operands: the engine variable that each means; fields of an undecided object become proxies."""

from runtime.constraints.domains.tags import KIND_FLOAT, KIND_INT
from runtime.plan.store.plan import Plan
from runtime.plan.store.scopes import copy_variable
from runtime.plan.tags import (
    HOLDS_CONSTRAINT,
    HOLDS_VARIABLES,
    IN_CONSTANT,
    IN_FIELD,
    IN_GLOBAL,
    IN_LOCAL,
    IN_PROTOTYPE,
    IN_SELF,
    IN_TOKEN,
    IN_UNION,
    NONE,
    ROLE_INTERNAL,
    TOKEN_SHIFT,
)


def operand(plan: Plan, scope: int, kind: int, value: int, span: int) -> int:
    """The variable of an operand in `scope`; it is made if the operand asks for a new one."""
    rows = plan.rows
    if kind == IN_CONSTANT:
        return value
    if kind == IN_LOCAL:
        return rows.cells[rows.scope_frame[scope] + value]
    if kind == IN_TOKEN:
        slot = rows.scope_frame[scope] + rows.scope_slots[scope] + value // TOKEN_SHIFT
        return rows.var0[rows.cells[slot]] + value % TOKEN_SHIFT
    if kind == IN_GLOBAL:
        return plan.globals[value]
    if kind == IN_FIELD:
        return _field(plan, scope, value, span)
    if kind == IN_PROTOTYPE:
        return copy_variable(plan, scope, value, ROLE_INTERNAL, NONE)
    if kind == IN_SELF:
        return plan.object_constant[plan.self_object]
    if kind == IN_UNION:
        return _unite(plan, scope, value, span)
    return NONE


def _field(plan: Plan, scope: int, number: int, span: int) -> int:
    """The variable at the end of a member path; each object on the way that is not fixed gives a proxy."""
    v = operand(plan, scope, plan.field_kind[number], plan.field_value[number], span)
    start = plan.field_start[number]
    for position in range(start, start + plan.field_length[number]):
        name = plan.field_names[position]
        if plan.engine.is_base_singleton(v):
            o = int(plan.engine.base_lower(v))
            v = member(plan, o, name)
        else:
            v = _proxy(plan, scope, v, name, span)
    return v


def member(plan: Plan, o: int, name: int) -> int:
    """The member called `name` of object `o`; NONE if its class has none."""
    k = plan.member_at[plan.object_class[o] * plan.member_names + name]
    return NONE if k < 0 else plan.object_var0[o] + k


def _proxy(plan: Plan, scope: int, index: int, name: int, span: int) -> int:
    """A variable that equals the member called `name` of the object that `index` turns out to be."""
    prototype = plan.name_prototype[name]
    keys: list[int] = []
    variables: list[int] = []
    for x in _base_listed(plan, index):
        o = int(x)
        v = member(plan, o, name)
        if v >= 0:
            keys.append(o)
            variables.append(v)
            prototype = plan.member_prototype[plan.object_class[o] * plan.member_names + name]
    result = copy_variable(plan, scope, prototype, ROLE_INTERNAL, NONE)
    plan.proxy_index[result] = index
    plan.proxy_member[result] = name
    c = plan.engine.post_element(result, index, keys, variables, span, plan.rows.scope_token[scope])
    plan.rows.hold(scope, HOLDS_CONSTRAINT, c)
    return result


def _base_listed(plan: Plan, v: int) -> list[float]:
    """The values of a base domain; of an interval of numbers its two ends."""
    engine = plan.engine
    values = engine.base_values(v)
    if values is not None:
        return values
    lower = engine.base_lower(v)
    upper = engine.base_upper(v)
    if engine.kind[v] == KIND_INT or engine.kind[v] == KIND_FLOAT:
        return [lower, upper]
    return [float(x) for x in range(int(lower), int(upper) + 1)]


def _unite(plan: Plan, scope: int, number: int, span: int) -> int:
    """A variable whose domain is the union of several others, as they are now; in the script each must be known."""
    engine = plan.engine
    values: list[float] = []
    kind = NONE
    owner = plan.rows.scope_token[scope]
    for source_kind, source in plan.unions[number]:
        v = operand(plan, scope, source_kind, source, span)
        kind = engine.kind[v]
        if engine.is_singleton(v):
            values.append(engine.lower(v))
        else:
            values += _base_listed(plan, v)
            if owner < 0:
                plan.services.note_loose_item(span)
    v = engine.new_values(kind, values, span, owner)
    plan.note_variable(v, ROLE_INTERNAL, owner, NONE)
    plan.rows.hold(scope, HOLDS_VARIABLES, v)
    return v
