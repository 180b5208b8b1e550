"""Find the propagator of a constraint: operations are numbered by families, each with a file of its own."""

from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    FAMILY_ARITHMETIC,
    FAMILY_COMPARISON,
    FAMILY_FUNCTION,
    FAMILY_GEOMETRY,
    FAMILY_LOGIC,
    FAMILY_SETS,
    OP_EXTERNAL,
)
from runtime.constraints.propagators.arithmetic import run_arithmetic
from runtime.constraints.propagators.comparison import run_comparison
from runtime.constraints.propagators.functions import run_function
from runtime.constraints.propagators.geodesy import run_geometry
from runtime.constraints.propagators.logic import run_logic
from runtime.constraints.propagators.sets import run_sets


def carry_out(s: Store, c: int) -> bool:
    """Have the family of a constraint's operation narrow its arguments; false on a conflict."""
    family = s.op[c] >> 5
    if family == FAMILY_COMPARISON:
        return run_comparison(s, c)
    if family == FAMILY_ARITHMETIC:
        return run_arithmetic(s, c)
    if family == FAMILY_LOGIC:
        return run_logic(s, c)
    if family == FAMILY_SETS:
        return run_sets(s, c)
    if family == FAMILY_FUNCTION:
        return run_function(s, c)
    if family == FAMILY_GEOMETRY:
        return run_geometry(s, c)
    if s.op[c] == OP_EXTERNAL:
        return bool(s.externals[c].propagate(s, c))
    return True
