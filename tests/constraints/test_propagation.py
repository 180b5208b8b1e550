"""The engine narrows as enumeration says, loses no solution, and decides known values."""

import random

import pytest

from runtime.constraints.domains import tags
from runtime.constraints.engine import Engine
from runtime.constraints.minimisation.minimise import minimise
from runtime.constraints.propagators import opcodes
from tests.constraints.reference import (
    BATCHES,
    BY_BOUND,
    BY_VALUE,
    ONLY_SOUND,
    built,
    domains_of,
    random_problem,
    seeds,
)
from tests.constraints.sufficient import sufficient


def compare_with_naive_fixpoint(seed: int) -> None:
    """Narrow one random problem both ways."""
    chance = random.Random(seed)
    problem = random_problem(chance, BY_VALUE + BY_BOUND, chance.randint(2, 6), chance.randint(1, 6))
    engine = built(problem)
    expected = problem.propagated()
    assert engine.propagate() == (expected is not None)
    if expected is not None:
        assert domains_of(engine, len(expected)) == expected


@pytest.mark.parametrize("batch", BATCHES)
def test_bounds_and_values_equal_those_of_the_naive_fixpoint(batch: int) -> None:
    for seed in seeds(batch):
        compare_with_naive_fixpoint(seed)


def compare_with_all_solutions(seed: int) -> None:
    """Narrow one random problem, then decide it, beside all of its solutions."""
    chance = random.Random(seed)
    problem = random_problem(chance, BY_VALUE + BY_BOUND + ONLY_SOUND, chance.randint(2, 5), chance.randint(1, 5))
    solutions = problem.solutions()
    engine = built(problem)
    if not engine.propagate():
        assert not solutions
        return
    domains = domains_of(engine, len(problem.domains))
    for solution in solutions:
        assert all(x in domain for x, domain in zip(solution, domains, strict=True))
    values = tuple(chance.choice(sorted(domain)) for domain in domains)
    holding = all(engine.decide(v, x, 0, -1) for v, x in enumerate(values)) and engine.propagate()
    assert holding == (values in solutions)


@pytest.mark.parametrize("batch", BATCHES)
def test_no_solution_is_lost_and_known_values_are_judged(batch: int) -> None:
    for seed in seeds(batch):
        compare_with_all_solutions(seed)


def keep_whole_solutions(seed: int) -> None:
    """Narrow one random problem with floats in it."""
    chance = random.Random(seed)
    problem = random_problem(chance, BY_BOUND[:1] + BY_BOUND[2:] + ONLY_SOUND[1:], chance.randint(2, 5), 3)
    problem.kinds = [
        tags.KIND_FLOAT if kind == tags.KIND_INT and chance.random() < 0.6 else kind for kind in problem.kinds
    ]
    solutions = problem.solutions()
    engine = built(problem)
    if not engine.propagate():
        assert not solutions
        return
    for solution in solutions:
        assert all(engine.contains(v, x) for v, x in enumerate(solution))


@pytest.mark.parametrize("batch", BATCHES)
def test_reals_keep_every_whole_solution(batch: int) -> None:
    for seed in seeds(batch):
        keep_whole_solutions(seed)


def test_floats_whose_bounds_touch_are_not_smaller() -> None:
    engine = Engine()
    a = engine.new_interval(tags.KIND_FLOAT, 0.0, 9.0, 0, -1)
    nine = engine.new_constant(tags.KIND_FLOAT, 9.0, 9.0)
    engine.post(opcodes.OP_LT, [a, nine], 1, -1)
    assert engine.propagate() and engine.upper(a) == 9.0 - tags.STRICT_STEP
    b = engine.new_interval(tags.KIND_FLOAT, 0.0, 9.0, 2, -1)
    engine.post(opcodes.OP_LT, [nine, b], 3, -1)
    assert not engine.propagate()
    assert {cause.span for cause in minimise(engine, sufficient(engine))} == {2, 3}
