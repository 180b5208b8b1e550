"""Paths that are kept between questions answer as searches of their own do, and sets are counted as they are listed."""

import random

import pytest

from runtime.build_form import build_form
from runtime.constraints.domains.bitset import count_values
from runtime.constraints.domains.tags import KIND_INT, KIND_SYMBOL
from runtime.constraints.engine import Engine
from runtime.constraints.stn.distances import Distances
from runtime.constraints.stn.reach import Reach

assert build_form()


def network(seed: int) -> tuple[Engine, list[int]]:
    """Points between wide bounds, or none, and random edges that agree with each other."""
    draw = random.Random(seed)
    engine = Engine()
    points = [
        engine.new_interval(KIND_INT, *draw.choice([(0, 300), (-float("inf"), float("inf")), (0, 40)]), 0, -1)
        for _ in range(12)
    ]
    assert engine.propagate()
    for _ in range(30):
        mark = engine.mark()
        source, target = draw.sample(points, 2)
        if not engine.add_edge(source, target, draw.randint(-6, 12), 0, -1) or not engine.propagate():
            engine.rewind(mark)
    return engine, points


@pytest.mark.parametrize("seed", range(40))
def test_reach_answers_as_single_searches_do(seed: int) -> None:
    engine, points = network(seed)
    distances = Distances(engine, False)
    forth, back = Reach(engine, False), Reach(engine, False)
    order = random.Random(seed + 1000)
    for origin in points:
        forth.begin(origin, True)
        back.begin(origin, False)
        for other in order.sample(points, len(points)):
            assert forth.is_apart(other) == distances.admits(other, origin, 0)
            assert back.is_apart(other) == distances.admits(origin, other, 0)


@pytest.mark.parametrize("seed", range(40))
def test_what_admits_refuses_is_a_conflict(seed: int) -> None:
    engine, points = network(seed)
    distances = Distances(engine, False)
    for source in points:
        for target in points:
            mark = engine.mark()
            said = distances.admits(source, target, 0)
            assert said == engine.add_edge(source, target, 0, 0, -1)
            engine.rewind(mark)


@pytest.mark.parametrize("seed", range(40))
def test_values_of_a_set_are_counted_within_its_bounds(seed: int) -> None:
    draw = random.Random(seed)
    engine = Engine()
    values = sorted(draw.sample(range(draw.choice([10, 200, 9000])), 9))
    v = engine.new_values(KIND_SYMBOL, [float(x) for x in values], 0, -1)
    low, high = sorted(draw.sample(values, 2))
    engine.restrict_base(v, low, high, 0, -1)
    assert engine.propagate()
    assert count_values(engine, v) == len(engine.values_of(v)) == values.index(high) - values.index(low) + 1
