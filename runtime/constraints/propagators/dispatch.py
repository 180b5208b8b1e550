"""Dispatch: run the propagator of a constraint, by its family, or by a call where the registry says so."""

from runtime.constraints.domains.store import Store
from runtime.constraints.propagators.arithmetic import propagate_arithmetic
from runtime.constraints.propagators.comparison import propagate_comparison
from runtime.constraints.propagators.functions import propagate_function
from runtime.constraints.propagators.geodesy import propagate_geodesy
from runtime.constraints.propagators.logic import propagate_logic
from runtime.constraints.propagators.opcodes import (
    FAMILY_ARITHMETIC,
    FAMILY_COMPARISON,
    FAMILY_FUNCTION,
    FAMILY_GEODESY,
    FAMILY_LOGIC,
    FAMILY_SETS,
)
from runtime.constraints.propagators.registry import CALLED, CALLS
from runtime.constraints.propagators.row import CALLED_ALWAYS, CALLED_BESIDE
from runtime.constraints.propagators.sets import propagate_sets


def propagate_constraint(s: Store, c: int) -> bool:
    """Narrow the arguments of a constraint; false on a conflict."""
    op = s.op[c]
    called = CALLED[op]
    if called and (called == CALLED_ALWAYS or s.relational):
        if not CALLS[op](s, c):
            return False
        if called != CALLED_BESIDE:
            return True
    family = op >> 5
    if family == FAMILY_COMPARISON:
        return propagate_comparison(s, c)
    if family == FAMILY_ARITHMETIC:
        return propagate_arithmetic(s, c)
    if family == FAMILY_LOGIC:
        return propagate_logic(s, c)
    if family == FAMILY_SETS:
        return propagate_sets(s, c)
    if family == FAMILY_FUNCTION:
        return propagate_function(s, c)
    if family == FAMILY_GEODESY:
        return propagate_geodesy(s, c)
    return True
