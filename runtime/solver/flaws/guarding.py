"""Guards of a handler: whether variables of the flaw's token, or of its parent, have the values it names."""

from runtime.constraints.domains.tags import KIND_BOOL, KIND_FLOAT, KIND_INT, KIND_OBJECT, KIND_STRING
from runtime.plan.database import PlanDatabase
from runtime.solver.flaws.filters import Filters
from runtime.solver.tags import NONE

TRUTHS = {"true": 1.0, "TRUE": 1.0, "True": 1.0, "false": 0.0, "FALSE": 0.0, "False": 0.0}


def guards_hold(filters: Filters, handler: int, t: int) -> bool:
    """Whether all guards of a handler hold."""
    said = filters.table.matching.handlers[handler]
    if said.guards and (t < 0 or not all(_has_value(filters, t, *pair) for pair in said.guards)):
        return False
    if said.parent_guards:
        parent = filters.rows.parent[t] if t >= 0 else NONE
        return parent >= 0 and all(_has_value(filters, parent, *pair) for pair in said.parent_guards)
    return True


def _has_value(filters: Filters, t: int, name: str, wanted: str) -> bool:
    """Whether the variable of `t` that is called `name` is fixed to the value that is written `wanted`."""
    predicate = filters.table.program.predicates[filters.rows.predicate[t]].name
    number = filters.table.matching.variable_number(predicate, name)
    if number < 0:
        return False
    v = filters.rows.var0[t] + number
    if not filters.engine.is_singleton(v):
        return False
    kind = filters.engine.kind[v]
    if kind == KIND_FLOAT:
        value = filters.engine.flo[v]
    else:
        value = float(filters.engine.lb[v])
    if kind in (KIND_BOOL, KIND_INT, KIND_FLOAT):
        truth = TRUTHS.get(wanted)
        try:
            return value == (float(wanted) if truth is None else truth)
        except ValueError:
            return False
    return _value_text(filters.table.database, v) == wanted


def _value_text(database: PlanDatabase, v: int) -> str:
    """The single value of a variable that holds names: an object, a symbol or a text."""
    kind = database.plan.engine.kind[v]
    value = database.plan.engine.lb[v]
    if kind == KIND_OBJECT:
        return database.objects.names[value]
    if kind == KIND_STRING:
        return database.prototypes.texts.text(value)
    return database.prototypes.symbols.text(value)


def value_number(database: PlanDatabase, v: int, text: str) -> float | None:
    """The number of a name as a value of `v`; None if nothing is called so."""
    kind = database.plan.engine.kind[v]
    if kind == KIND_OBJECT:
        return database.objects.numbers.get(text)
    names = database.prototypes.texts if kind == KIND_STRING else database.prototypes.symbols
    return names.numbers.get(text)
