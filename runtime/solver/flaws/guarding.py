"""Guards of a handler: whether variables of the flaw's token, or of its parent, have the values it names."""

from runtime.constraints.domains.tags import KIND_BOOL, KIND_FLOAT, KIND_INT
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
    number = filters.table.variable_number(filters.rows.predicate[t], name)
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
    return filters.table.vocabulary.value_text(v) == wanted
