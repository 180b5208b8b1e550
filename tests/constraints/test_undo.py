"""Rewinding and retracting leave the state that would be there had what is gone never been posted."""

import random

import pytest

from runtime.constraints.domains import tags
from runtime.constraints.engine import Engine
from runtime.constraints.propagators import opcodes
from tests.constraints.reference import (
    BATCHES,
    BY_BOUND,
    BY_VALUE,
    ONLY_SOUND,
    Post,
    built,
    domains_of,
    random_problem,
    seeds,
    undecide,
)

ALL = BY_VALUE + BY_BOUND + ONLY_SOUND


def post_and_rewind(seed: int) -> None:
    """Post one random problem bit by bit, and go back again and again."""
    chance = random.Random(seed)
    problem = random_problem(chance, ALL, chance.randint(2, 6), 8)
    engine = built(problem, [])
    count = len(problem.domains)
    stack = []
    for op, arguments in problem.posts:
        stack.append((engine.mark(), domains_of(engine, count)))
        engine.post(op, list(arguments), 0, -1)
        holding = engine.propagate()
        if holding and chance.random() < 0.3:
            v = chance.randrange(count)
            holding = engine.decide(v, chance.choice(sorted(domains_of(engine, count)[v])), 0, -1)
            holding = holding and engine.propagate()
        while stack and (not holding or chance.random() < 0.2):
            mark, before = stack.pop()
            engine.rewind(mark)
            holding = True
            assert domains_of(engine, count) == before
            assert all(engine.decided[v] == 0 for v in range(count)) or stack


@pytest.mark.parametrize("batch", BATCHES)
def test_rewinding_restores_every_domain(batch: int) -> None:
    for seed in seeds(batch):
        post_and_rewind(seed)


def post_and_retract(seed: int) -> None:
    """Post one random problem bit by bit, and retract some of it again and again."""
    chance = random.Random(seed)
    problem = random_problem(chance, ALL, chance.randint(2, 6), 8)
    engine = built(problem, [])
    count = len(problem.domains)
    kept: dict[int, Post] = {}
    restrictions: dict[int, tuple[int, int, int]] = {}
    for post in problem.posts:
        c = engine.post(post[0], list(post[1]), 0, -1)
        engine.propagate()
        engine.commit()
        kept[c] = post
        if engine.consistent and chance.random() < 0.4:
            v = chance.randrange(count)
            lo = chance.randint(-3, 3)
            engine.restrict_base(v, lo, lo + 3, 0, -1)
            restrictions[engine.newest_restriction] = (v, lo, lo + 3)
            engine.propagate()
            engine.commit()
        if chance.random() < 0.4 or not engine.consistent:
            gone = chance.sample(sorted(kept), chance.randint(0, len(kept)))
            relaxed = chance.sample(sorted(restrictions), chance.randint(0, len(restrictions)))
            holding = engine.retract(constraints=gone, restrictions=relaxed)
            for c in gone:
                del kept[c]
            for r in relaxed:
                del restrictions[r]
            fresh = built(problem, list(kept.values()))
            fresh_holding = all(fresh.restrict_base(*r, 0, -1) for r in restrictions.values()) and fresh.propagate()
            assert holding == fresh_holding
            if holding:
                assert domains_of(engine, count) == domains_of(fresh, count)


@pytest.mark.parametrize("batch", BATCHES)
def test_retracting_equals_never_having_posted(batch: int) -> None:
    for seed in seeds(batch):
        post_and_retract(seed)


def test_bounds_that_hold_each_other_up_are_relaxed() -> None:
    engine = Engine()
    x = engine.new_interval(tags.KIND_INT, 0, float("inf"), 0, -1)
    y = engine.new_interval(tags.KIND_INT, 0, float("inf"), 0, -1)
    two = engine.new_constant(tags.KIND_INT, 2, 2)
    engine.restrict_base(y, 0, 10, 1, -1)
    limit = engine.newest_restriction
    twice = engine.new_interval(tags.KIND_INT, 0, float("inf"), 0, -1)
    engine.post(opcodes.OP_MUL_EQ, [x, two, twice], 2, -1)
    engine.post(opcodes.OP_LEQ, [twice, y], 3, -1)
    engine.post(opcodes.OP_LEQ, [y, x], 4, -1)
    assert engine.propagate()
    assert (engine.upper(x), engine.upper(y)) == (0, 0)
    engine.commit()
    assert engine.retract(restrictions=[limit])
    assert (engine.upper(x), engine.upper(y)) == (float("inf"), float("inf"))


def test_a_decision_can_be_taken_back_and_leaves_the_base_domain() -> None:
    engine = Engine()
    a = engine.new_interval(tags.KIND_INT, 1, 9, 0, -1)
    b = engine.new_interval(tags.KIND_INT, float("-inf"), float("inf"), 0, -1)
    engine.post(opcodes.OP_ADD_EQ, [a, engine.new_constant(tags.KIND_INT, 1, 1), b], 1, -1)
    assert engine.propagate() and engine.decide(a, 5, 2, -1) and engine.propagate()
    assert (engine.lower(b), engine.upper(b), engine.base_upper(a), engine.is_decided(a)) == (6, 6, 9, True)
    engine.commit()
    assert undecide(engine, a)
    assert (engine.lower(b), engine.upper(b), engine.is_decided(a)) == (2, 10, False)


def test_a_variable_stays_decided_until_the_last_decision_goes() -> None:
    engine = Engine()
    a = engine.new_interval(tags.KIND_INT, 1, 9, 0, -1)
    decisions = []
    for _ in range(2):
        assert engine.decide(a, 5, 0, -1) and engine.propagate()
        decisions.append(engine.newest_restriction)
    engine.commit()
    assert engine.retract(restrictions=decisions[:1])
    assert (engine.lower(a), engine.is_decided(a)) == (5, True)
    assert engine.retract(restrictions=decisions[1:])
    assert (engine.lower(a), engine.is_decided(a)) == (1, False)


def test_rows_of_what_was_undone_are_used_again() -> None:
    engine = Engine()
    base = [engine.new_interval(tags.KIND_INT, 0, 50, 0, -1) for _ in range(4)]
    engine.commit()
    sizes = []
    for turn in range(300):
        mark = engine.mark()
        first = engine.reserve(3)
        start, duration, end = (engine.new_interval(tags.KIND_INT, 0, 50, 0, -1) for _ in range(3))
        colour = engine.new_values(tags.KIND_SYMBOL, [3, 5, 9], 0, -1)
        assert first == start
        engine.post(opcodes.OP_TEMPORAL_DISTANCE, [start, duration, end], 0, -1)
        engine.post(opcodes.OP_NEQ, [base[turn % 4], base[(turn + 1) % 4]], 0, -1)
        engine.post(opcodes.OP_LEQ, [end, base[turn % 4]], 0, -1)
        engine.post(opcodes.OP_ALL_DIFF, [colour, base[0], base[1]], 0, -1)
        assert engine.propagate()
        engine.decide(base[0], 7, 0, -1)
        assert engine.propagate()
        if turn % 2:
            engine.commit()
            assert undecide(engine, base[0])
            engine.commit()
            left = [c for v in base for c in engine.constraints_of(v)]
            assert engine.retract(constraints=left, variables=[start, duration, end, colour])
            engine.commit()
        else:
            engine.rewind(mark)
            engine.commit()
        sizes.append(
            (
                engine.variables,
                engine.edges_used,
                engine.constraints_used,
                engine.slots_used,
                engine.restrictions_used,
                engine.bits_used,
                engine.holes_used,
            )
        )
    assert sizes[20] == sizes[-1]


def test_sets_of_values_far_apart_come_and_go() -> None:
    engine = Engine()
    v = engine.new_interval(tags.KIND_INT, 0, 10**9, 0, -1)
    x = engine.new_interval(tags.KIND_FLOAT, 0.0, 9.0, 0, -1)
    engine.commit()
    for turn in range(50):
        mark = engine.mark()
        assert engine.restrict_base_values(v, [3, 70000, 10**6 + turn], 1, -1)
        assert engine.restrict_base_values(x, [0.5, 2.25, 7.125], 2, -1)
        engine.post(opcodes.OP_NEQ, [v, engine.new_constant(tags.KIND_INT, 70000, 70000)], 3, -1)
        engine.restrict_base(x, 1.0, 9.0, 4, -1)
        assert engine.propagate()
        assert (engine.values_of(v), engine.values_of(x)) == ([3, 10**6 + turn], [2.25, 7.125])
        engine.rewind(mark)
        assert (engine.upper(v), engine.upper(x), engine.is_finite(x)) == (10**9, 9.0, False)
        mark = engine.mark()
        assert engine.restrict_base_values(v, [2, 4], 5, -1) and engine.values_of(v) == [2, 4]
        engine.rewind(mark)
    assert engine.table_used == 6


def test_what_a_contradicting_restriction_asks_for_is_not_passed_on() -> None:
    engine = Engine()
    a = engine.new_interval(tags.KIND_INT, -19, 14, 0, -1)
    b = engine.new_interval(tags.KIND_INT, float("-inf"), 10, 0, -1)
    engine.decide(a, 4, 1, -1)
    decision = engine.newest_restriction
    assert engine.add_edge(a, b, 1, 2, -1)
    engine.commit()
    assert not engine.restrict_base(b, 11, float("inf"), 3, -1)
    impossible = engine.newest_restriction
    engine.commit()
    assert not engine.retract(restrictions=[decision])
    assert engine.retract(restrictions=[impossible])
    assert (engine.lower(a), engine.upper(b)) == (-19, 10)


def test_bounds_that_a_retraction_pulled_are_explained_later() -> None:
    engine = Engine()
    a, b = (engine.new_interval(tags.KIND_INT, float("-inf"), float("inf"), k, -1) for k in range(2))
    engine.restrict_base(a, float("-inf"), 9, 2, -1)
    engine.add_edge(a, b, 1, 3, -1)
    engine.add_edge(a, b, 0, 4, -1)
    tightest = engine.newest_edge
    engine.commit()
    assert engine.retract(edges=[tightest]) and engine.upper(b) == 10
    engine.restrict_base(a, 0, float("inf"), 5, -1)
    assert not engine.restrict_base(b, 11, float("inf"), 6, -1)
    assert {cause.span for cause in engine.explain()} >= {2, 3, 6}


def test_what_is_removed_is_not_relaxed_and_its_numbers_are_as_good_as_new() -> None:
    engine = Engine()
    kept = engine.new_interval(tags.KIND_INT, 0, 100, 0, -1)
    numbers = set()
    for turn in range(3):
        first, second = (engine.new_interval(tags.KIND_INT, 0, 100, 0, -1) for _ in range(2))
        numbers |= {first, second}
        engine.add_edge(first, second, 1, 0, -1)
        engine.add_edge(second, kept, 1, 0, -1)
        engine.restrict_base(first, 0, 10 + turn, 0, -1)
        limit = engine.newest_restriction
        assert engine.propagate()
        engine.commit()
        assert engine.upper(kept) == 12 + turn
        assert engine.retract(restrictions=[limit]) and engine.upper(second) == engine.upper(kept) == 100
        engine.restrict_base(first, 0, 10 + turn, 0, -1)
        assert engine.propagate()
        engine.commit()
        assert engine.upper(kept) == 12 + turn
        assert engine.retract(variables=[first, second]) and engine.upper(kept) == 100
        assert engine.cone_count == 1
    assert len(numbers) == 2


def test_taking_a_relation_out_of_a_long_chain_touches_its_cone_only() -> None:
    engine = Engine()
    length, station = 10_000, 100
    points = [engine.new_interval(tags.KIND_INT, float("-inf"), float("inf"), 0, -1) for _ in range(length)]
    edges = []
    for k, v in enumerate(points):
        if k % station == 0:
            engine.restrict_base(v, 5 * k, 5 * k + 300, 1, -1)  # here the chain is held by its own dates
        if k:
            assert engine.add_edge(v, points[k - 1], -2, 2, -1)
            edges.append(engine.newest_edge)
    assert engine.propagate()
    engine.commit()
    before = [(engine.lower(v), engine.upper(v)) for v in points]
    visits, updates, runs = engine.visits, engine.updates, engine.runs
    middle = length // 2 + station // 2
    assert engine.retract(edges=[edges[middle - 1]])
    for k, v in enumerate(points):
        low, high = before[k]
        if 0 < middle - k < station // 2:
            high = float("inf")
        if 0 <= k - middle < station // 2:
            low = float("-inf")
        assert (engine.lower(v), engine.upper(v)) == (low, high)
    assert engine.visits - visits <= 4 * station
    assert engine.updates - updates <= station and engine.runs == runs
    engine.commit()
    visits, updates = engine.visits, engine.updates
    mark = engine.mark()
    assert engine.restrict_base(points[middle + 3], 5 * middle, 10**6, 3, -1) and engine.propagate()
    assert engine.updates > updates
    visits, updates = engine.visits, engine.updates
    engine.rewind(mark)
    assert (engine.visits, engine.updates) == (visits, updates)  # going back propagates nothing
