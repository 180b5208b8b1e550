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
from dataclasses import asdict, dataclass

from runtime.build_form import build_form
from runtime.constraints import codes
from runtime.constraints.engine import Engine

NANO = 1e9


@dataclass(frozen=True)
class Figures:
    """What one form of the engine needs."""

    form: str
    visit_ns: float  # all of propagation, per edge visited
    update_ns: float  # all of propagation and undo, per bound changed
    sum_run_ns: float  # per run of an addition that narrows its result
    rule_us: float  # a token with its five variables, its distance and two relations, made and undone
    retract_us: float  # one relation taken out of a chain of tokens and put back
    edge_bytes: float


def measure(scale: int) -> Figures:
    """Run all measurements; `scale` says how long."""
    visit_ns, update_ns = measure_network(scale)
    return Figures(
        build_form(),
        visit_ns,
        update_ns,
        measure_sums(scale),
        measure_tokens(scale),
        measure_retraction(scale),
        edge_bytes(),
    )


def plan_network(engine: Engine, chance: random.Random, tokens: int) -> list[tuple[int, int]]:
    """Lay tokens on ten timelines, with durations and relations across, as a plan has them."""
    points = []
    for _ in range(tokens):
        start = engine.new_interval(codes.KIND_INT, 0, 100000, 0, -1)
        end = engine.new_interval(codes.KIND_INT, 0, 100000, 0, -1)
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
    last = first = engine.new_interval(codes.KIND_INT, 0, 10**9, 0, -1)
    for _ in range(200):
        step = engine.new_interval(codes.KIND_INT, 0, 3, 0, -1)
        total = engine.new_interval(codes.KIND_INT, 0, 10**9, 0, -1)
        engine.post(codes.OP_ADD_EQ, [last, step, total], 0, -1)
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
    parent = engine.new_interval(codes.KIND_INT, 0, 1000, 0, -1)
    engine.propagate()
    engine.commit()
    begun = time.process_time()
    for _ in range(100 * scale):
        mark = engine.mark()
        engine.reserve(5)
        engine.new_interval(codes.KIND_SYMBOL, 0, 2, 0, 1)
        engine.new_interval(codes.KIND_OBJECT, 0, 5, 0, 1)
        duration = engine.new_interval(codes.KIND_INT, 1, float("inf"), 0, 1)
        start = engine.new_interval(codes.KIND_INT, float("-inf"), float("inf"), 0, 1)
        end = engine.new_interval(codes.KIND_INT, float("-inf"), float("inf"), 0, 1)
        engine.post(codes.OP_TEMPORAL_DISTANCE, [start, duration, end], 0, 1)
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


def edge_bytes() -> float:
    """Give the bytes that one edge takes, with the room that doubling leaves empty at worst."""
    engine = Engine()
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
    return 2.0 * sum(memoryview(row).nbytes for row in rows) / len(memoryview(engine.edge_weight))


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
            print(f"{name:12} {value:>12}" + (f" {other[name]:>12} {'ratio':>8}" if other else ""))
        else:
            print(f"{name:12} {value:12.2f}" + (f" {other[name]:12.2f} {other[name] / value:8.1f}" if other else ""))


if __name__ == "__main__":
    main()
