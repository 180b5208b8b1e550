"""Assignments: base domains compared and intersected, for statements and constructor arguments."""

from runtime.constraints.domains.base_domain import is_base_growing, is_growing
from runtime.constraints.domains.tags import FLOAT_TOLERANCE, KIND_FLOAT
from runtime.constraints.engine import Engine
from runtime.plan.store.plan import Plan
from runtime.plan.store.scopes import make_variable
from runtime.plan.tags import NONE, ROLE_INTERNAL


def copy_current(plan: Plan, prototype: int, source: int) -> int:
    """A variable of a prototype's type whose base domain is the current domain of `source`."""
    engine = plan.engine
    v = make_variable(plan, prototype, ROLE_INTERNAL, NONE, NONE)
    if is_growing(engine, source):
        values = engine.base_values(source)
        if values and not engine.is_open[v]:
            engine.restrict_base_values(v, values, NONE, NONE)
    elif engine.kind[source] > KIND_FLOAT or engine.word[source] >= 0:
        values = [engine.lower(source)] if engine.is_singleton(source) else engine.values_of(source)
        engine.restrict_base_values(v, values, NONE, NONE)
    else:
        engine.restrict_base(v, engine.lower(source), engine.upper(source), NONE, NONE)
    return v


def overlap(engine: Engine, v: int, source: int) -> bool:
    """Whether two base domains have a value in common."""
    if is_base_growing(engine, v) or is_base_growing(engine, source):
        return True
    tolerance = FLOAT_TOLERANCE if engine.kind[v] == KIND_FLOAT else 0
    if engine.base_lower(v) > engine.base_upper(source) + tolerance:
        return False
    if engine.base_lower(source) > engine.base_upper(v) + tolerance:
        return False
    mine, theirs = engine.base_values(v), engine.base_values(source)
    if mine is not None and theirs is not None:
        return any(abs(x - y) <= tolerance for x in mine for y in theirs)
    listed = mine if mine is not None else theirs
    if listed is None:
        return True
    other = source if mine is not None else v
    return any(engine.base_lower(other) - tolerance <= x <= engine.base_upper(other) + tolerance for x in listed)
