"""Bounds at the ends of the doubles and beyond: no constraint may fall over them, as it stands or as a relation."""

import random
from math import inf

import pytest

from runtime.constraints.domains import tags
from runtime.constraints.engine import Engine
from runtime.constraints.propagators import opcodes
from tests.constraints.signatures import SIGNATURES

REALS = (
    -inf,
    -1.7e308,
    -1e200,
    -1e160,
    -1e19,
    -1.0,
    -1e-9,
    0.0,
    5e-324,
    1e-300,
    0.5,
    1.0,
    90.0,
    1e19,
    1e200,
    1.7e308,
    inf,
)
WHOLE = (-inf, -(2**52), -(10**6), -1, 0, 1, 7, 2**31, 2**52, inf)
LETTERS = {"b": tags.KIND_BOOL, "i": tags.KIND_INT, "f": tags.KIND_FLOAT, "s": tags.KIND_INT}
OPERATIONS = sorted(set(SIGNATURES) - {opcodes.OP_EXTERNAL, opcodes.OP_ELEMENT})
EACH = 40


def extreme(engine: Engine, letter: str, chance: random.Random) -> int:
    """Make a variable whose bounds are extreme."""
    kind = chance.choice((tags.KIND_INT, tags.KIND_FLOAT)) if letter == "n" else LETTERS[letter]
    ends = (0, 1) if letter == "b" else REALS if kind == tags.KIND_FLOAT else WHOLE
    lo, hi = sorted((chance.choice(ends), chance.choice(ends)))
    lo, hi = (-inf, inf) if lo == inf or hi == -inf else (lo, hi)
    return int(engine.new_interval(kind, lo, hi, 0, -1))


@pytest.mark.parametrize("is_relational", [False, True])
@pytest.mark.parametrize("op", OPERATIONS)
def test_extreme_bounds_are_narrowed_or_refused(op: int, is_relational: bool) -> None:
    for seed in range(EACH):
        chance = random.Random(f"{op} {seed}")
        letters = SIGNATURES[op].draw(chance)
        if not set(letters) <= {"n", *LETTERS}:
            return
        engine = Engine()
        engine.relational = is_relational
        variables = [extreme(engine, letter, chance) for letter in letters]
        engine.post(op, variables, 9, -1)
        holds = engine.propagate()
        assert not holds or all(engine.lower(v) <= engine.upper(v) for v in variables)
        assert holds or engine.explain()
