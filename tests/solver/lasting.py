"""Planning and undoing, ticks that restrict and retract, again and again: how much memory is held after each part."""

import os
from array import array
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

from runtime.constraints.domains import tags
from runtime.constraints.engine import Engine
from runtime.constraints.propagators import opcodes
from runtime.plan.database import PlanDatabase
from runtime.solver.configuration.configuration import default_configuration
from runtime.solver.search import Solver
from runtime.solver.tags import PLAN
from tests.constraints.reference import undecide
from tests.plan.models import loaded
from tests.plan.test_undo import MODEL

PARTS = 10


def held(*holders: Any) -> int:
    """Add up the bytes of all arrays, and the lengths of all lists and dicts, of some objects."""
    total = 0
    for holder in holders:
        for name in dir(holder):
            value = getattr(holder, name) if not name.startswith("__") else None
            if isinstance(value, array | memoryview) or hasattr(value, "nbytes"):
                total += memoryview(value).nbytes  # type: ignore[arg-type]
            elif isinstance(value, list | dict | set):
                total += len(value)
    return total


def resident() -> int:
    """Give the bytes of memory that this process has; 0 where the system does not tell."""
    table = Path("/proc/self/statm")
    return int(table.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") if table.exists() else 0


def repeated(count: int, turn: Callable[[int], None], *holders: Any) -> list[tuple[int, int]]:
    """Take `count` turns; give what is held, and what the process has, after each tenth of them."""
    found = []
    for part in range(PARTS):
        for k in range(part * count // PARTS, (part + 1) * count // PARTS):
            turn(k)
        found.append((held(*holders), resident()))
    return found


def plan_and_undo(count: int) -> list[tuple[int, int]]:
    """Solve one problem, take all decisions back, and so on."""
    database: PlanDatabase = loaded(MODEL)
    solver = Solver(database, default_configuration(), 0, 1000, False)

    def turn(_: int) -> None:
        assert solver.solve(10**6, 10**6, lambda: False) == PLAN
        solver.undo_all()

    return repeated(count, turn, database.engine, database.plan, database.plan.rows, database)


def post_and_undo(count: int) -> list[tuple[int, int]]:
    """Post all kinds of things, decide, and rewind."""
    engine = Engine()
    base = [engine.new_interval(tags.KIND_INT, 0, 50, k, -1) for k in range(6)]
    chance = Random(1)
    engine.commit()

    def turn(k: int) -> None:
        mark = engine.mark()
        fresh = [engine.new_interval(tags.KIND_INT, 0, 50, 0, -1) for _ in range(k % 4)]
        colour = engine.new_values(tags.KIND_SYMBOL, [3, 5, 9], 0, -1)
        far = engine.new_values(tags.KIND_INT, [k % 100, 5000, 90000], 0, -1)
        able = base + fresh
        engine.post(opcodes.OP_TEMPORAL_DISTANCE, chance.sample(able, 3), 0, -1)
        engine.post(opcodes.OP_ALL_DIFF, [colour, far, *fresh], 0, -1)
        engine.post(opcodes.OP_ADD_EQ, chance.sample(able, 3), 0, -1)
        source, target = chance.sample(able, 2)
        engine.add_edge(source, target, 7, 0, -1)
        if engine.propagate():
            engine.decide(far, 5000, 0, -1)
            engine.propagate()
        engine.rewind(mark)

    return repeated(count, turn, engine)


def tick(count: int) -> list[tuple[int, int]]:
    """Live as an agent does: each tick a token comes and is restricted, and the oldest of some is retracted."""
    engine = Engine()
    clock = engine.new_interval(tags.KIND_INT, 0, float("inf"), 0, -1)
    tokens: list[list[int]] = []

    def turn(k: int) -> None:
        engine.reserve(4)
        start, end = (engine.new_interval(tags.KIND_INT, k, float("inf"), 0, -1) for _ in range(2))
        length = engine.new_interval(tags.KIND_INT, 1, float("inf"), 0, -1)
        mode = engine.new_values(tags.KIND_SYMBOL, [1, 2, 4], 0, -1)
        engine.post(opcodes.OP_TEMPORAL_DISTANCE, [start, length, end], 0, -1)
        if tokens:
            engine.add_edge(start, tokens[-1][1], 0, 0, -1)
        engine.restrict_base(start, k, k, 0, -1)
        expected = engine.newest_restriction
        assert engine.decide(mode, 2, 0, -1) and engine.propagate()
        engine.commit()
        assert engine.retract(restrictions=[expected]) and undecide(engine, mode)
        assert engine.restrict_base(start, k, k + 2, 0, -1) and engine.propagate()
        tokens.append([start, end, length, mode])
        if len(tokens) > 5:
            assert engine.retract(variables=tokens.pop(0))
        engine.commit()
        assert engine.lower(clock) == 0

    return repeated(count, turn, engine)
