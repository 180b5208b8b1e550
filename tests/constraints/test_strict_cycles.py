"""Cycles of orders among reals: a strict one is a conflict, and its explanation names the cycle."""

import pytest

from runtime.constraints.domains.tags import KIND_FLOAT
from runtime.constraints.engine import Engine
from runtime.constraints.propagators.opcodes import OP_EQ, OP_LEQ, OP_LT


@pytest.mark.parametrize(
    ("links", "holds"),
    [
        ([(OP_LT, 0, 1), (OP_LT, 1, 0)], False),
        ([(OP_LT, 0, 1), (OP_EQ, 1, 0)], False),
        ([(OP_EQ, 0, 1), (OP_LT, 0, 1)], False),
        ([(OP_LEQ, 0, 1), (OP_EQ, 1, 2), (OP_LT, 2, 0)], False),
        ([(OP_LT, 0, 1), (OP_LEQ, 1, 2), (OP_LEQ, 2, 3), (OP_EQ, 3, 0)], False),
        ([(OP_LEQ, 0, 1), (OP_LEQ, 1, 2), (OP_EQ, 2, 0)], True),
        ([(OP_LT, 0, 1), (OP_LT, 1, 2), (OP_LT, 0, 2)], True),
        ([(OP_LT, 0, 1), (OP_EQ, 1, 2), (OP_LT, 3, 2)], True),
    ],
)
def test_a_strict_cycle_of_reals_is_a_conflict(links: list[tuple[int, int, int]], holds: bool) -> None:
    engine = Engine()
    reals = [engine.new_interval(KIND_FLOAT, 0.0, 1.0, 100 + k, -1) for k in range(5)]
    engine.post(OP_LEQ, [reals[0], reals[4]], 50, -1)
    assert engine.propagate()
    engine.mark()
    for k, (op, a, b) in enumerate(links):
        engine.post(op, [reals[a], reals[b]], k, -1)
    assert engine.propagate() == holds
    if not holds:
        assert {cause.span for cause in engine.explain()} >= set(range(len(links)))
