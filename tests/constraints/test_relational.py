"""Relations narrow the arguments of functions before these are known: soundly, and so that explanations are small."""

import math
import random

import pytest

from runtime.constraints.domains import tags
from runtime.constraints.engine import Engine
from runtime.constraints.minimisation.case_split import Budget, fails_in_all_cases
from runtime.constraints.minimisation.minimise import minimise
from runtime.constraints.propagators import opcodes
from tests.constraints import meaning
from tests.constraints.reference import BATCHES, seeds
from tests.constraints.signatures import FORWARD, KINDS, SIGNATURES, draw_values
from tests.constraints.sufficient import sufficient
from tests.constraints.witness import repairs

WIDTHS = (0.0, 0.0, 1.0, 4.0, 60.0, math.inf)


def solved(chance: random.Random, op: int) -> tuple[list[int], list[float]] | None:
    """Draw kinds and values of a function's arguments that hold."""
    kinds = [chance.choice(KINDS[letter]) for letter in SIGNATURES[op].draw(chance)]
    x = [
        chance.choice(draw_values(chance, op, "i" if k == tags.KIND_INT else "f", place)[1])
        for place, k in enumerate(kinds)
    ]
    for _ in range(8):
        if meaning.holds(op, x):
            return kinds, x
        options = [each for each in repairs(op, x) if kinds[each[0]] == tags.KIND_FLOAT or each[1] == int(each[1])]
        if not options:
            return None
        place, value = chance.choice(options)
        x[place] = float(value)
    return None


@pytest.mark.parametrize("op", FORWARD)
@pytest.mark.parametrize("batch", BATCHES[:4])
def test_no_solution_is_lost_before_arguments_are_known(op: int, batch: int) -> None:
    for seed in seeds(batch):
        chance = random.Random(1000 * seed + op)
        found = solved(chance, op)
        if found is None:
            continue
        kinds, x = found
        engine = Engine(relational=True)
        variables = []
        for kind, value in zip(kinds, x, strict=True):
            below, above = (chance.choice(WIDTHS) * chance.choice((1.0, 0.25)) for _ in range(2))
            if kind == tags.KIND_INT:
                below, above = below // 1.0, above // 1.0
            variables.append(engine.new_interval(kind, value - below, value + above, -1, -1))
        engine.post(op, variables, -1, -1)
        assert engine.propagate(), f"{x} is refuted"
        for v, value in zip(variables, x, strict=True):
            lo, hi = engine.lower(v), engine.upper(v)
            assert lo - meaning.TOLERANCE <= value <= hi + meaning.TOLERANCE, f"{value} of {x} is lost: {lo} to {hi}"
        assert not fails_in_all_cases(engine, variables, Budget(2000)), f"{x} fails in all cases"


def test_solutions_are_drawn_for_every_function() -> None:
    for op in FORWARD:
        assert any(solved(random.Random(seed), op) for seed in range(200)), op


def needed(op: int, domains: list[tuple[int, float, float]]) -> set[int]:
    """Give the places of the arguments that the explanation of a conflict names; none of them is a constant."""
    engine = Engine()
    variables = [engine.new_interval(kind, lo, hi, k, -1) for k, (kind, lo, hi) in enumerate(domains)]
    engine.post(op, variables, 99, -1)
    assert not engine.propagate()
    return {cause.span for cause in minimise(engine, sufficient(engine))} - {99}


INT, FLOAT = tags.KIND_INT, tags.KIND_FLOAT


@pytest.mark.parametrize(
    ("op", "x", "places"),
    [
        (opcodes.OP_ABS, [(INT, -3, -3), (INT, 3, 3)], {0}),
        (opcodes.OP_MIN, [(INT, 5, 5), (INT, 2, 2), (INT, 8, 8)], {0, 1}),
        (opcodes.OP_POW, [(FLOAT, -4, -4), (FLOAT, 3, 3), (INT, 2, 2)], {0, 1}),
        (opcodes.OP_POW, [(FLOAT, 2.5, 2.5), (INT, 3, 3), (INT, 2, 2)], {0}),
        (opcodes.OP_MOD, [(INT, 7, 7), (INT, 9, 9), (INT, 4, 4)], {0, 2}),
        (opcodes.OP_MOD, [(INT, -1, -1), (INT, 9, 9), (INT, 4, 4)], {0, 1}),
        (opcodes.OP_CALC_DISTANCE, [(FLOAT, 1.5, 1.5), (INT, 0, 0), (INT, 0, 0), (INT, 3, 3), (INT, 4, 4)], {0}),
        (opcodes.OP_TOWARDS, [(FLOAT, 2, 2), (FLOAT, 0, 1), *[(INT, k, k) for k in range(4)]], {0}),
        (opcodes.OP_TRAVEL_TIME, [(INT, 0, 0), *[(INT, k, k) for k in range(4)], (FLOAT, 1, 1)], {0}),
        (
            opcodes.OP_TRAVEL_TIME,
            [(INT, 2, 2), (INT, 0, 0), (INT, 0, 0), (INT, 9, 9), (INT, 7, 7), (FLOAT, 1, 1)],
            {0, 1, 3, 5},
        ),
        (opcodes.OP_TICK_DATE, [(INT, 0, 0), (INT, 0, 0), (INT, 5, 5), (INT, 1980, 1980)], {0, 3}),
        (opcodes.OP_LL_DIST, [(FLOAT, 7e5, 7e5), *[(FLOAT, k, k) for k in range(3)], (INT, 4, 4)], {0, 1, 2, 3}),
        (opcodes.OP_LL_DIST, [(FLOAT, 3e7, 3e7), *[(FLOAT, k, k) for k in range(4)]], {0}),
    ],
)
def test_an_explanation_names_only_what_matters(op: int, x: list[tuple[int, float, float]], places: set[int]) -> None:
    assert needed(op, x) == places


def test_few_values_are_tried() -> None:
    engine = Engine()
    truth = engine.new_interval(tags.KIND_BOOL, 0, 1, 0, -1)
    engine.post(opcodes.OP_NEQ, [truth, truth], 1, -1)
    assert engine.propagate()
    assert fails_in_all_cases(engine, [truth], Budget(1000))
    assert not fails_in_all_cases(engine, [truth], Budget(1)), "the budget ends before"
    assert engine.size(truth) == 2, "trying leaves nothing behind"
