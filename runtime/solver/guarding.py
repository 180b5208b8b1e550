"""Take the most specific handler of a flaw whose guards hold: variables of its token or its parent have a value."""

from runtime.constraints.codes import KIND_BOOL, KIND_FLOAT, KIND_INT
from runtime.solver.codes import NONE
from runtime.solver.queues import Queues

TRUTHS = {"true": 1.0, "TRUE": 1.0, "True": 1.0, "false": 0.0, "FALSE": 0.0, "False": 0.0}


def handler_now(q: Queues, row: int, t: int) -> int:
    """The handler of a row that applies now; `t` is the token that the flaw belongs to (NONE: to nobody)."""
    first = q.treatments.first_handler[row]
    count = q.treatments.handler_count[row]
    for at in range(first, first + count - 1):
        handler = q.treatments.handler_of[at]
        if guards_hold(q, handler, t):
            return handler
    return q.treatments.handler_of[first + count - 1]


def guards_hold(q: Queues, handler: int, t: int) -> bool:
    """Whether all guards of a handler hold."""
    said = q.treatments.matching.handlers[handler]
    if said.guards and (t < 0 or not all(has_value(q, t, *pair) for pair in said.guards)):
        return False
    if said.master_guards:
        master = q.rows.master[t] if t >= 0 else NONE
        return master >= 0 and all(has_value(q, master, *pair) for pair in said.master_guards)
    return True


def has_value(q: Queues, t: int, name: str, wanted: str) -> bool:
    """Whether the variable of `t` that is called `name` is fixed to the value that is written `wanted`."""
    place = q.treatments.place_of(q.rows.predicate[t], name)
    if place < 0:
        return False
    v = q.rows.var0[t] + place
    if not q.filters.is_single(v):
        return False
    kind = q.engine.kind[v]
    if kind == KIND_FLOAT:
        value = q.engine.flo[v]
    else:
        value = float(q.engine.lb[v])
    if kind in (KIND_BOOL, KIND_INT, KIND_FLOAT):
        number = TRUTHS.get(wanted)
        try:
            return value == (float(wanted) if number is None else number)
        except ValueError:
            return False
    return q.treatments.vocabulary.value_text(v) == wanted
