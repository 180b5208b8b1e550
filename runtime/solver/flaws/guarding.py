"""Tell whether the guards of a handler hold: variables of the flaw's token, or of the parent, have a value."""

from runtime.constraints.domains.tags import KIND_BOOL, KIND_FLOAT, KIND_INT
from runtime.solver.flaws.filters import Filters
from runtime.solver.tags import NONE

TRUTHS = {"true": 1.0, "TRUE": 1.0, "True": 1.0, "false": 0.0, "FALSE": 0.0, "False": 0.0}


def guards_hold(filters: Filters, handler: int, t: int) -> bool:
    """Whether all guards of a handler hold."""
    said = filters.treatments.matching.handlers[handler]
    if said.guards and (t < 0 or not all(has_value(filters, t, *pair) for pair in said.guards)):
        return False
    if said.master_guards:
        master = filters.rows.parent[t] if t >= 0 else NONE
        return master >= 0 and all(has_value(filters, master, *pair) for pair in said.master_guards)
    return True


def has_value(filters: Filters, t: int, name: str, wanted: str) -> bool:
    """Whether the variable of `t` that is called `name` is fixed to the value that is written `wanted`."""
    place = filters.treatments.place_of(filters.rows.predicate[t], name)
    if place < 0:
        return False
    v = filters.rows.var0[t] + place
    if not filters.is_single(v):
        return False
    kind = filters.engine.kind[v]
    if kind == KIND_FLOAT:
        value = filters.engine.flo[v]
    else:
        value = float(filters.engine.lb[v])
    if kind in (KIND_BOOL, KIND_INT, KIND_FLOAT):
        number = TRUTHS.get(wanted)
        try:
            return value == (float(wanted) if number is None else number)
        except ValueError:
            return False
    return filters.treatments.vocabulary.value_text(v) == wanted
