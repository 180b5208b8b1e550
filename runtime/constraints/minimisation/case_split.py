"""Case split: refute constraints by halving or listing the values of one variable after the other, and propagating."""

from math import inf

from runtime.constraints.domains.tags import KIND_FLOAT
from runtime.constraints.engine import Engine

_STEPS_OF_CASE = 20
_MOST_LISTED = 8  # so many values are tried one by one; more are halved
_THIN = 1e-3  # intervals of reals are not halved below: near the tolerance, what is known is not exact


class Budget:
    """How many steps may still be taken: a count, so that what is found depends on no clock."""

    def __init__(self, steps: int) -> None:
        self.steps = steps

    def is_spent(self, steps: int) -> bool:
        """Take steps; tell whether there were not enough left."""
        self.steps -= steps
        return self.steps < 0


def fails_in_all_cases(engine: Engine, variables: list[int], budget: Budget) -> bool:
    """Tell whether propagation refutes all cases of a propagated engine; false too if the budget ends before.

    The variable with the fewest values is taken first. The first case that leaves nothing to choose ends it: then
    there is a solution, or what there is cannot be told by values. The engine is left as it was.
    """
    v = _narrowest(engine, variables)
    if v < 0:
        return False
    for lo, hi in _cases(engine, v):
        if budget.is_spent(_STEPS_OF_CASE):
            return False
        mark = engine.mark()
        holds = engine.restrict_base(v, lo, hi, -1, -1) and engine.propagate()
        fails = not holds or fails_in_all_cases(engine, variables, budget)
        engine.rewind(mark)
        if not fails:
            return False
    return True


def _narrowest(engine: Engine, variables: list[int]) -> int:
    """Give the bounded variable with the fewest values of those that have several; -1 if there is none."""
    best, least = -1, inf
    for v in variables:
        width = engine.upper(v) - engine.lower(v)
        if not 0.0 < width < inf or engine.is_singleton(v):
            continue
        if engine.is_finite(v):
            width = engine.size(v) - 1.0
        elif width < _THIN:
            continue
        else:
            width += _MOST_LISTED  # what can be listed goes first
        if width < least:
            best, least = v, width
    return best


def _cases(engine: Engine, v: int) -> list[tuple[float, float]]:
    """Give the parts of a domain: its values if they are few, else its halves."""
    lo, hi = engine.lower(v), engine.upper(v)
    if engine.is_finite(v) and engine.size(v) <= _MOST_LISTED:
        return [(x, x) for x in engine.values_of(v)]
    middle = lo + (hi - lo) / 2.0
    if engine.kind[v] == KIND_FLOAT:
        return [(lo, middle), (middle, hi)]
    return [(lo, middle // 1.0), (middle // 1.0 + 1.0, hi)]
