"""Temporal edges give the distances of Floyd and Warshall, also among points without bounds."""

import random
from math import inf

import pytest

from runtime.constraints.domains import tags
from runtime.constraints.engine import Engine
from tests.constraints.reference import BATCHES, Edge, seeds, shortest_distances


def random_network(chance: random.Random) -> tuple[int, list[Edge], list[tuple[float, float]]]:
    """Draw points, some of them without bounds, and edges."""
    count = chance.randint(2, 9)
    edges = [
        (chance.randrange(count), chance.randrange(count), chance.randint(-4, 9))
        for _ in range(chance.randint(1, 3 * count))
    ]
    bounds = []
    for _ in range(count):
        lo = chance.choice((-inf, -inf, float(chance.randint(-20, 5))))
        hi = chance.choice((inf, inf, float(chance.randint(5, 30))))
        bounds.append((lo, hi))
    return count, edges, bounds


def expected_bounds(
    count: int, edges: list[Edge], bounds: list[tuple[float, float]]
) -> list[tuple[float, float]] | None:
    """Give the tightest bounds, by distances from and to an origin."""
    origin = count
    all_edges = list(edges)
    for v, (lo, hi) in enumerate(bounds):
        if hi < inf:
            all_edges.append((origin, v, int(hi)))
        if lo > -inf:
            all_edges.append((v, origin, -int(lo)))
    d = shortest_distances(count + 1, all_edges)
    return None if d is None else [(-d[v][origin], d[origin][v]) for v in range(count)]


def build(bounds: list[tuple[float, float]]) -> Engine:
    """Make an engine with a point for each pair of bounds."""
    engine = Engine()
    for lo, hi in bounds:
        engine.new_interval(tags.KIND_INT, lo, hi, 0, -1)
    return engine


def bounds_of(engine: Engine, count: int) -> list[tuple[float, float]]:
    """List the bounds of the first variables."""
    return [(engine.lower(v), engine.upper(v)) for v in range(count)]


def compare_with_distances(seed: int) -> None:
    """Add the edges of one random network, one by one."""
    count, edges, bounds = random_network(random.Random(seed))
    engine = build(bounds)
    holding = all(engine.add_edge(*edge, 0, -1) for edge in edges) and engine.propagate()
    expected = expected_bounds(count, edges, bounds)
    assert holding == (expected is not None)
    if expected is not None:
        assert bounds_of(engine, count) == expected


@pytest.mark.parametrize("batch", BATCHES)
def test_bounds_and_verdict_equal_all_pairs_distances(batch: int) -> None:
    for seed in seeds(batch):
        compare_with_distances(seed)


def add_and_undo(seed: int) -> None:
    """Add the edges of one random network, and go back again and again."""
    chance = random.Random(seed)
    count, edges, bounds = random_network(chance)
    engine = build(bounds)
    states = []
    for edge in edges:
        before = bounds_of(engine, count)
        mark = engine.mark()
        if engine.add_edge(*edge, 0, -1):
            states.append((mark, before))
        else:
            engine.rewind(mark)
            assert bounds_of(engine, count) == before
        while states and chance.random() < 0.2:
            mark, before = states.pop()
            engine.rewind(mark)
            assert bounds_of(engine, count) == before


@pytest.mark.parametrize("batch", BATCHES)
def test_undoing_restores_every_bound(batch: int) -> None:
    for seed in seeds(batch):
        add_and_undo(seed)


def add_and_take_out(seed: int) -> None:
    """Add the edges of one random network, and take some out again and again."""
    chance = random.Random(seed)
    count, edges, bounds = random_network(chance)
    engine = build(bounds)
    kept: dict[int, Edge] = {}
    for edge in edges:
        mark = engine.mark()
        if engine.add_edge(*edge, 0, -1):
            kept[engine.newest_edge] = edge
        else:
            engine.rewind(mark)
        engine.commit()
        if kept and chance.random() < 0.5:
            gone = chance.sample(sorted(kept), chance.randint(1, len(kept)))
            assert engine.retract(edges=gone)
            for e in gone:
                del kept[e]
            assert bounds_of(engine, count) == expected_bounds(count, list(kept.values()), bounds)


@pytest.mark.parametrize("batch", BATCHES)
def test_taking_edges_out_leaves_what_the_others_ask_for(batch: int) -> None:
    for seed in seeds(batch):
        add_and_take_out(seed)


def fail_and_mend(seed: int) -> None:
    """Add all edges of one random network, consistent or not, then take them out one by one."""
    chance = random.Random(seed)
    count, edges, bounds = random_network(chance)
    engine = build(bounds)
    ids = []
    for edge in edges:
        engine.add_edge(*edge, 0, -1)
        ids.append(engine.newest_edge)
    engine.propagate()
    left = list(range(len(edges)))
    while left:
        expected = expected_bounds(count, [edges[k] for k in left], bounds)
        assert engine.consistent == (expected is not None)
        if expected is not None:
            assert bounds_of(engine, count) == expected
        gone = chance.choice(left)
        left.remove(gone)
        engine.retract(edges=[ids[gone]])


@pytest.mark.parametrize("batch", BATCHES)
def test_a_conflict_among_edges_can_be_taken_back(batch: int) -> None:
    for seed in seeds(batch):
        fail_and_mend(seed)


def test_an_edge_costs_at_most_a_hundred_bytes() -> None:
    engine = build([(-inf, inf)] * 100)
    for k in range(5000):
        engine.add_edge(k % 100, (k * 7) % 100, 1000 + k, 0, -1)
    rows = (
        engine.edge_source,
        engine.edge_target,
        engine.edge_weight,
        engine.out_next,
        engine.out_prev,
        engine.in_next,
        engine.in_prev,
        engine.edge_span,
        engine.edge_owner,
        engine.edge_link,
    )
    room = len(engine.edge_weight)
    assert sum(memoryview(row).nbytes for row in rows) / room <= 50  # doubling leaves at most half of the room empty
    assert room < 2 * 5000
