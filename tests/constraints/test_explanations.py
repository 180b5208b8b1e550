"""Explanations are inconsistent by themselves, as z3 judges, and minimal; chains of supports end at restrictions."""

import random
from collections.abc import Sequence
from functools import partial
from itertools import count, pairwise
from typing import Any

import pytest
import z3

from runtime.constraints.domains import tags
from runtime.constraints.engine import Engine
from runtime.constraints.explanation.cause import Cause, CauseKind
from runtime.constraints.explanation.support_walk import SupportWalk
from runtime.constraints.minimisation.case_split import Budget
from runtime.constraints.minimisation.minimise import Scratch, minimise
from runtime.constraints.propagators import opcodes
from runtime.limits import TIME_LIMIT
from tests.constraints.reference import (
    BATCHES,
    BY_BOUND,
    BY_VALUE,
    RUNS,
    Problem,
    built,
    domains_of,
    random_problem,
    seeds,
)
from tests.constraints.sufficient import sufficient

JUDGED = tuple(op for op in BY_VALUE + BY_BOUND if op not in (opcodes.OP_EQ_MAXIMUM, opcodes.OP_EQ_MINIMUM))


def claim(op: int, x: list[Any]) -> Any:
    """Say in z3 what a constraint says."""
    match op:
        case opcodes.OP_EQ:
            return z3.And([x[0] == y for y in x[1:]])
        case opcodes.OP_NEQ:
            return x[0] != x[1]
        case opcodes.OP_LT:
            return x[0] < x[1]
        case opcodes.OP_LEQ:
            return x[0] <= x[1]
        case opcodes.OP_TEMPORAL_DISTANCE:
            return x[2] - x[0] == x[1]
        case opcodes.OP_ADD_EQ:
            return x[0] + x[1] == x[2]
        case opcodes.OP_EQ_SUM:
            return x[0] == z3.Sum(x[1:])
        case opcodes.OP_TEST_EQ:
            return (x[0] != 0) == (x[1] == x[2])
        case opcodes.OP_TEST_NEQ:
            return (x[0] != 0) == (x[1] != x[2])
        case opcodes.OP_TEST_LEQ:
            return (x[0] != 0) == (x[1] <= x[2])
        case opcodes.OP_TEST_LT:
            return (x[0] != 0) == (x[1] < x[2])
        case opcodes.OP_TEST_AND:
            return (x[0] != 0) == z3.And(x[1] != 0, x[2] != 0)
        case opcodes.OP_TEST_OR:
            return (x[0] != 0) == z3.Or(x[1] != 0, x[2] != 0)
        case opcodes.OP_OR:
            return z3.Or([y != 0 for y in x])
    raise AssertionError(op)


def is_satisfiable(engine: Engine, causes: Sequence[Cause]) -> bool:
    """Ask z3 whether some values satisfy all causes; only bools are bounded by themselves."""
    solver = z3.Solver()
    names = [z3.Int(f"v{v}") for v in range(engine.variables)]
    for v in range(engine.variables):
        if engine.kind[v] == tags.KIND_BOOL:
            solver.add(names[v] >= 0, names[v] <= 1)
        if engine.constant[v]:
            solver.add(names[v] == engine.lb[v])
    for cause in causes:
        if cause.kind is CauseKind.EDGE:
            source, target = engine.edge_source[cause.id], engine.edge_target[cause.id]
            solver.add(names[target] - names[source] <= engine.edge_weight[cause.id])
        elif cause.kind is CauseKind.RESTRICTION:
            name = names[engine.restriction_variable[cause.id]]
            if engine.restriction_flags[cause.id] & tags.FLAG_VALUES:
                solver.add(z3.Or([name == int(x) for x in engine.restriction_values[cause.id]]))
            else:
                solver.add(name >= int(engine.restriction_lo[cause.id]))
                solver.add(name <= int(engine.restriction_hi[cause.id]))
        else:
            op = engine.op[cause.id]
            solver.add(
                claim(
                    opcodes.OP_ADD_EQ if op == opcodes.OP_PLUS else op, [names[v] for v in engine.arguments(cause.id)]
                )
            )
    return bool(solver.check() == z3.sat)


def first_conflict(seed: int, commits: bool) -> Engine | None:
    """Post a random problem bit by bit, deciding values in between, until something fails."""
    chance = random.Random(seed)
    problem: Problem = random_problem(chance, JUDGED, chance.randint(3, 6), 10)
    engine = built(problem, [])
    count = len(problem.domains)
    for k, (op, arguments) in enumerate(problem.posts):
        engine.post(op, list(arguments), k, -1)
        ints = [v for v in range(count) if problem.kinds[v] == tags.KIND_INT]
        if len(ints) > 1 and chance.random() < 0.3:
            source, target = chance.sample(ints, 2)
            if not engine.add_edge(source, target, chance.randint(-3, 3), 100 + k, -1):
                return engine
        if not engine.propagate():
            return engine
        if chance.random() < 0.5:
            v = chance.randrange(count)
            engine.decide(v, chance.choice(sorted(domains_of(engine, count)[v])), 200 + k, -1)
            if not engine.propagate():
                return engine
        if commits and chance.random() < 0.5:
            engine.commit()
    return None


def explain_and_shrink(seed: int, commits: bool) -> None:
    """Explain the first conflict of one random problem."""
    engine = first_conflict(seed, commits)
    if engine is None:
        return
    assert Scratch(engine).refutes(engine.explain()) or commits
    causes = sufficient(engine)
    assert not is_satisfiable(engine, causes)
    least = minimise(engine, causes)
    assert set(least) <= set(causes)
    assert not is_satisfiable(engine, least)
    others = [[cause for cause in least if cause is not spare] for spare in least]
    for scratch in (Scratch(engine), Scratch(engine, Budget(100_000))):
        assert scratch.refutes(least) or scratch.budget is None
        assert not any(scratch.refutes(each) for each in others)


@pytest.mark.parametrize("commits", [False, True])
@pytest.mark.parametrize("batch", BATCHES)
def test_an_explanation_is_inconsistent_and_nothing_in_it_is_spare(batch: int, commits: bool) -> None:
    for seed in seeds(batch)[::5]:
        explain_and_shrink(seed, commits)


def test_nearly_every_explanation_is_minimal_for_z3_too() -> None:
    spare = total = 0
    for seed in range(RUNS // 5):
        engine = first_conflict(seed, False)
        if engine is not None:
            least = minimise(engine, sufficient(engine))
            for cause in least:
                total += 1
                spare += not is_satisfiable(engine, [other for other in least if other is not cause])
    assert total > 0 and spare <= 0.05 * total


def test_a_cycle_among_unbounded_points_is_explained_by_its_edges() -> None:
    engine = Engine()
    a, b, c, d = (engine.new_interval(tags.KIND_INT, float("-inf"), float("inf"), 9, -1) for _ in range(4))
    assert engine.add_edge(a, d, 1, 1, -1)
    assert engine.add_edge(b, a, -1, 2, -1)
    assert engine.add_edge(c, b, -1, 3, 7)
    assert not engine.add_edge(a, c, 1, 4, -1)
    assert engine.conflict_kind == tags.CONFLICT_CYCLE
    assert sorted((cause.span, cause.owner) for cause in engine.explain()) == [(2, -1), (3, 7), (4, -1)]


def test_a_late_observation_is_explained_back_to_its_causes() -> None:
    engine = Engine()
    start = engine.new_interval(tags.KIND_INT, 0, 10, 1, -1)
    duration = engine.new_interval(tags.KIND_INT, 1, float("inf"), 2, -1)
    end = engine.new_interval(tags.KIND_INT, float("-inf"), float("inf"), 3, -1)
    rate = engine.new_interval(tags.KIND_FLOAT, 2.5, 2.5, 4, -1)
    length = engine.new_interval(tags.KIND_FLOAT, 10.0, 10.0, 5, -1)
    engine.post(opcodes.OP_MUL_EQ, [rate, duration, length], 6, 42)
    engine.post(opcodes.OP_TEMPORAL_DISTANCE, [start, duration, end], 7, 42)
    assert engine.propagate()
    engine.restrict_base(start, 8, 8, 8, -1)
    assert engine.propagate() and engine.lower(end) == 12
    chain = engine.support_chain(end, tags.SIDE_LOWER)
    assert chain[0].variable == end and chain[0].value == 12
    assert {link.cause.span for link in chain} >= {4, 5, 6, 7, 8}
    assert all(link.cause.owner == 42 for link in chain if link.cause.kind is CauseKind.CONSTRAINT)


def test_a_walk_by_itself_goes_back_as_far_as_the_trail_and_visits_each_change_once() -> None:
    engine = Engine()
    a, b, c = (engine.new_interval(tags.KIND_INT, 0, 99, 1, -1) for _ in range(3))
    engine.post(opcodes.OP_EQ, [a, b, c], 2, -1)
    assert engine.propagate()
    engine.mark()
    engine.restrict_base(a, 7, 99, 3, -1)
    assert engine.propagate() and engine.lower(c) == 7
    walk = SupportWalk(engine)
    walk.start()
    walk.ask(c, tags.SIDE_LOWER, 2**60)
    walk.walk()
    asked = {walk.asked_key[k] >> 2 for k in range(walk.asked_count)}
    assert a in asked and walk.answered == walk.asked_count < 20


def test_a_set_is_among_the_causes_of_what_it_leaves_out() -> None:
    engine = Engine()
    x = engine.new_interval(tags.KIND_FLOAT, 0.0, 9.0, 1, -1)
    engine.restrict_base_values(x, [1.0, 4.0, 8.0], 2, -1)
    engine.restrict_base(x, 2.0, 9.0, 3, -1)
    engine.restrict_base(x, 0.0, 7.0, 4, -1)
    assert engine.propagate() and engine.is_singleton(x)
    y = engine.new_interval(tags.KIND_FLOAT, 5.0, 9.0, 5, -1)
    engine.post(opcodes.OP_EQ, [x, y], 6, -1)
    assert not engine.propagate()
    assert {cause.span for cause in minimise(engine, sufficient(engine))} == {2, 4, 5, 6}


def test_taking_the_last_value_of_a_bool_blames_what_fixed_it() -> None:
    engine = Engine()
    a, b, c = (engine.new_interval(tags.KIND_BOOL, 0, 1, k, -1) for k in range(3))
    engine.post(opcodes.OP_LT, [b, c], 3, -1)
    engine.post(opcodes.OP_LEQ, [c, a], 4, -1)
    engine.post(opcodes.OP_NEQ, [c, a], 5, -1)
    assert not engine.propagate()
    assert {3, 4, 5} <= {cause.span for cause in engine.explain()}
    assert Scratch(engine).refutes(engine.explain())


@pytest.mark.once
def test_an_explanation_is_shrunk_no_further_when_the_time_of_the_mission_is_over() -> None:
    engine = Engine()
    x = [engine.new_interval(tags.KIND_INT, 0, 900, 1, -1) for _ in range(300)]
    for number, (one, other) in enumerate(pairwise(x)):
        engine.add_edge(one, other, -4, 2 + number, -1)
    assert not engine.propagate()
    needed = sufficient(engine)
    spare = [Cause(CauseKind.EDGE, edge, 2 + edge, -1) for edge in range(len(needed), len(x) - 1)]
    causes = [*spare, *needed]
    least = minimise(engine, causes)
    with TIME_LIMIT.lasting(0.0, partial(next, count())):
        kept = minimise(engine, causes)
    assert len(least) < len(kept) <= len(causes)
    assert Scratch(engine).refutes(kept)
