"""Measure the constraint engine: time per edge visit and per bound update, bytes per edge, compiled against not.

python bench/bench_engine.py            both forms, the second in a process of its own
python bench/bench_engine.py --json     one object, this form only
"""

import argparse
import json
import os
import platform
import random
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from runtime.build_form import build_form
from runtime.constraints.domains import tags
from runtime.constraints.engine import Engine
from runtime.constraints.propagators import opcodes

NANO = 1e9


@dataclass(frozen=True)
class EngineFigures:
    """What one form of the engine needs."""

    form: str
    visit_ns: float  # all of propagation, per edge visited
    update_ns: float  # all of propagation and undo, per bound changed
    sum_run_ns: float  # per run of an addition that narrows its result
    rule_us: float  # a token with its five variables, its distance and two relations, made and undone
    retract_us: float  # one relation taken out of a chain of tokens and put back
    chain_ns: float  # per bound changed, trail and support and undo included, as of all figures of this kind: a chain
    insert_ns: float  # ... whose relations come one by one, each of which moves all of it
    fan_ns: float  # ... one point before a thousand others
    grid_ns: float  # ... points in a square, each before its two neighbours
    decide_ns: float  # ... a sparse network in which points are decided one by one
    edge_bytes: float  # of all arrays, with the room that doubling leaves empty at worst
    edges_5_bytes: float  # at 10^5 edges
    edges_6_bytes: float  # at 10^6 edges (10^5 uncompiled)
    edges_6_process_bytes: float  # what the process grew by meanwhile, points and all, per edge


def measure(scale: int) -> EngineFigures:
    """Run all measurements; `scale` says how long."""
    visit_ns, update_ns = measure_network(scale)
    return EngineFigures(
        build_form(),
        visit_ns,
        update_ns,
        measure_sums(scale),
        measure_tokens(scale),
        measure_retraction(scale),
        *measure_shapes(scale),
        edge_bytes(),
        *many_edges(),
    )


def plan_network(engine: Engine, chance: random.Random, tokens: int) -> list[tuple[int, int]]:
    """Lay tokens on ten timelines, with durations and relations across, as a plan has them."""
    points = []
    for _ in range(tokens):
        start = engine.new_interval(tags.KIND_INT, 0, 100000, 0, -1)
        end = engine.new_interval(tags.KIND_INT, 0, 100000, 0, -1)
        engine.add_edge(start, end, chance.randint(20, 60), 0, -1)
        engine.add_edge(end, start, -chance.randint(1, 20), 0, -1)
        points.append((start, end))
    for k in range(10, tokens):
        engine.add_edge(points[k][0], points[k - 10][1], 0, 0, -1)
        other = chance.randint(max(0, k - 30), k - 1)
        engine.add_edge(points[k][0], points[other][0], -1, 0, -1)
    return points


def measure_network(scale: int) -> tuple[float, float]:
    """Push tokens of a plan about, as observations and choices do, and take it back."""
    chance = random.Random(1)
    engine = Engine()
    points = plan_network(engine, chance, 300)
    engine.propagate()
    engine.commit()
    pushes = [(chance.choice(points)[0], chance.randint(200, 2000)) for _ in range(64)]
    visits = engine.visits
    updates = engine.updates
    begun = time.process_time()
    for k in range(60 * scale):
        mark = engine.mark()
        for v, x in pushes[k % 60 : k % 60 + 4]:
            if engine.restrict_base(v, x, 90000, 0, -1):
                engine.propagate()
        engine.rewind(mark)
    spent = time.process_time() - begun
    return spent / (engine.visits - visits) * NANO, spent / (engine.updates - updates) * NANO


def measure_sums(scale: int) -> float:
    """Push a bound through a chain of sums."""
    engine = Engine()
    last = first = engine.new_interval(tags.KIND_INT, 0, 10**9, 0, -1)
    for _ in range(200):
        step = engine.new_interval(tags.KIND_INT, 0, 3, 0, -1)
        total = engine.new_interval(tags.KIND_INT, 0, 10**9, 0, -1)
        engine.post(opcodes.OP_ADD_EQ, [last, step, total], 0, -1)
        last = total
    engine.propagate()
    engine.commit()
    runs = engine.runs
    begun = time.process_time()
    for k in range(40 * scale):
        mark = engine.mark()
        engine.restrict_base(first, k + 1, 10**9, 0, -1)
        engine.propagate()
        engine.rewind(mark)
    return (time.process_time() - begun) / (engine.runs - runs) * NANO


def measure_tokens(scale: int) -> float:
    """Make a token with its constraints, propagate, and undo it."""
    engine = Engine()
    plan_network(engine, random.Random(2), 50)
    parent = engine.new_interval(tags.KIND_INT, 0, 1000, 0, -1)
    engine.propagate()
    engine.commit()
    begun = time.process_time()
    for _ in range(100 * scale):
        mark = engine.mark()
        engine.reserve(5)
        engine.new_interval(tags.KIND_SYMBOL, 0, 2, 0, 1)
        engine.new_interval(tags.KIND_OBJECT, 0, 5, 0, 1)
        duration = engine.new_interval(tags.KIND_INT, 1, float("inf"), 0, 1)
        start = engine.new_interval(tags.KIND_INT, float("-inf"), float("inf"), 0, 1)
        end = engine.new_interval(tags.KIND_INT, float("-inf"), float("inf"), 0, 1)
        engine.post(opcodes.OP_TEMPORAL_DISTANCE, [start, duration, end], 0, 1)
        engine.add_edge(start, parent, 0, 0, 1)
        engine.add_edge(parent, end, 50, 0, 1)
        engine.propagate()
        engine.rewind(mark)
    return (time.process_time() - begun) / (100 * scale) * 1e6


def measure_retraction(scale: int) -> float:
    """Take a relation out of the middle of a plan and put it back."""
    chance = random.Random(3)
    engine = Engine()
    points = plan_network(engine, chance, 300)
    engine.propagate()
    engine.commit()
    begun = time.process_time()
    for _ in range(20 * scale):
        k = chance.randint(20, 280)
        engine.add_edge(points[k][0], points[k - 15][1], -7, 0, -1)
        e = engine.newest_edge
        engine.commit()
        engine.retract(edges=[e])
        engine.commit()
    return (time.process_time() - begun) / (20 * scale) * 1e6


def measure_shapes(scale: int) -> Iterator[float]:
    """Push the first point of networks of some shapes about; give the nanoseconds per bound changed of each."""
    chance = random.Random(4)
    size = 30 if scale > 1 else 10
    chain = [(k, k + 1) for k in range(size**2 - 1)]
    fan = [(0, k) for k in range(1, size**2)]
    grid = [(k, k + 1) for k in range(size**2) if (k + 1) % size]
    grid += [(k, k + size) for k in range(size**2 - size)]
    sparse = sorted((min(a, b), max(a, b)) for a, b in (chance.sample(range(size**2), 2) for _ in range(2 * size**2)))
    yield measure_shape(size**2, chain, 20 * scale, push)
    yield measure_shape(size**2, [], scale, lambda engine, points, _: insert(engine, points))
    yield measure_shape(size**2, fan, 20 * scale, push)
    yield measure_shape(size**2, grid, 10 * scale, push)
    plans = [sorted((chance.randrange(size**2), chance.randint(0, 40)) for _ in range(10)) for _ in range(50)]
    yield measure_shape(size**2, sparse, 20 * scale, lambda engine, points, k: decide(engine, points, plans[k % 50]))


def measure_shape(
    count: int, relations: list[tuple[int, int]], turns: int, turn: Callable[[Engine, list[int], int], None]
) -> float:
    """Lay out points, each relation's first at least 1 before its second; take turns and undo each."""
    engine = Engine()
    points = [engine.new_interval(tags.KIND_INT, 0, 10**7, 0, -1) for _ in range(count)]
    for before, after in relations:
        engine.add_edge(points[after], points[before], -1, 0, -1)
    engine.propagate()
    engine.commit()
    updates = engine.updates
    begun = time.process_time()
    for k in range(turns):
        mark = engine.mark()
        turn(engine, points, k)
        engine.rewind(mark)
    return (time.process_time() - begun) / (engine.updates - updates) * NANO


def push(engine: Engine, points: list[int], k: int) -> None:
    """Have the first point be later."""
    engine.restrict_base(points[0], k % 50 + 1, 10**7, 0, -1)
    engine.propagate()


def insert(engine: Engine, points: list[int]) -> None:
    """Chain all points, the last relation first."""
    for k in range(len(points) - 1, 0, -1):
        engine.add_edge(points[k], points[k - 1], -1, 0, -1)


def decide(engine: Engine, points: list[int], plan: list[tuple[int, int]]) -> None:
    """Decide some points somewhat later than they might be."""
    for k, later in plan:
        if not (engine.decide(points[k], engine.lower(points[k]) + later, 0, -1) and engine.propagate()):
            return


def many_edges() -> Iterator[float]:
    """Give bytes per edge with 10^5 and with 10^6 edges, then those of the process."""
    for count in (10**5, 10**6 if build_form() == "compiled" else 10**5):
        before = resident()
        engine = Engine()
        points = [engine.new_interval(tags.KIND_INT, float("-inf"), float("inf"), 0, -1) for _ in range(count // 10)]
        for k in range(count):
            engine.add_edge(points[k % len(points)], points[k * 7 % len(points)], 1000, 0, -1)
            if k % 1000 == 0:
                engine.commit()
        grown = resident() - before
        yield row_bytes(engine) / count
    yield grown / count


def resident() -> int:
    """Give the bytes of memory that this process has; 0 where the system does not tell."""
    table = Path("/proc/self/statm")
    return int(table.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") if table.exists() else 0


def row_bytes(engine: Engine) -> int:
    """Add up the rows of all edges."""
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
    return sum(memoryview(row).nbytes for row in rows)


def edge_bytes() -> float:
    """Give the bytes that one edge takes, with the room that doubling leaves empty at worst."""
    engine = Engine()
    return 2.0 * row_bytes(engine) / len(memoryview(engine.edge_weight))


def main() -> None:
    """Print the figures of this form, and of the other one beside them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true", help="print this form's figures as one object")
    parser.add_argument("--scale", type=int, default=0, help="how long to measure (20 compiled, 1 not)")
    asked = parser.parse_args()
    scale = asked.scale or (20 if build_form() == "compiled" else 1)
    here = asdict(measure(scale))
    if asked.json:
        print(json.dumps(here))
        return
    print(f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}")
    other = None
    if build_form() == "compiled":
        command = [sys.executable, __file__, "--json"]
        answer = subprocess.run(command, env=os.environ | {"NDDLC_INTERPRETED": "1"}, capture_output=True, check=True)
        other = json.loads(answer.stdout)
    for name, value in here.items():
        if isinstance(value, str):
            print(f"{name:21} {value:>12}" + (f" {other[name]:>12} {'ratio':>8}" if other else ""))
        else:
            print(f"{name:21} {value:12.2f}" + (f" {other[name]:12.2f} {other[name] / value:8.1f}" if other else ""))


if __name__ == "__main__":
    main()
