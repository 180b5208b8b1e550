"""Strict cycles of orders among reals: without a solution, though bounds creep there one step at a time."""

from runtime.constraints.domains.store import Store
from runtime.constraints.propagators.opcodes import OP_EQ, OP_LEQ, OP_LT
from runtime.constraints.stn.watch_lists import watchers_of


def is_in_strict_cycle(s: Store, c: int) -> bool:
    """Whether an order or equality is part of a cycle that says x < x. Asked of what creeps only: uncompiled."""
    variables = [s.slot_variable[k] for k in range(s.first[c], s.first[c] + s.arity[c])]
    if s.op[c] == OP_EQ:
        return any(_is_below(s, v, other, True) for v in variables for other in variables)
    return _is_below(s, variables[1], variables[0], s.op[c] == OP_LEQ)


def _is_below(s: Store, a: int, b: int, strictly: bool) -> bool:
    """Whether orders and equalities say, one after the other, that a <= b, or a < b."""
    waiting = [(a, not strictly)]
    found = set(waiting)
    for v, is_strict in waiting:
        if v == b and is_strict:
            return True
        for c in watchers_of(s, v):
            first = s.first[c]
            above: list[int] = []
            if s.op[c] == OP_EQ:
                above = [s.slot_variable[k] for k in range(first, first + s.arity[c])]
            elif s.op[c] in (OP_LEQ, OP_LT) and s.slot_variable[first] == v:
                above = [s.slot_variable[first + 1]]
            for u in above:
                step = (u, is_strict or s.op[c] == OP_LT)
                if step not in found:
                    found.add(step)
                    waiting.append(step)
    return False
