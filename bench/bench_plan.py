"""Measure the plan database: microseconds per token made, per rule fired, per plan taken back; and loading a chain.

python bench/bench_plan.py            the form of the engine that this process loads
python bench/bench_plan.py --json     one object
"""

import argparse
import json
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass

from runtime.build_form import build_form
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_text
from runtime.plan.database import PlanDatabase

MICRO = 1e6
ROVER = """
enum Mode { slow, fast }
class Site { int place; Site(int v) { place = v; } }
class Rover extends Timeline {
    predicate at { Site site; }
    predicate go { Site to; Mode mode; }
}
Rover::go {
    met_by(object.at here);
    meets(object.at there);
    eq(there.site, to);
    if (mode == fast) { duration <= 5; } else { duration >= 6; }
}
Site a = new Site(1);
Site b = new Site(2);
Rover rover = new Rover();
close();
goal(rover.go trip);
trip.start = [1 50];
"""


@dataclass(frozen=True)
class PlanFigures:
    """What one form of the plan database needs."""

    form: str
    token_us: float  # a token of six variables made, propagated and taken back by a mark
    rule_us: float  # a rule with two children and a guard fired, propagated and taken back by a mark
    cancel_us: float  # the same, taken back by `cancel`
    remove_us: float  # a token made and removed at level 0
    chain_ms: float  # the script of a chain of precedences, per 1000 tokens


def loaded(text: str) -> PlanDatabase:
    """A database whose script has run."""
    database = PlanDatabase(compile_model(analyse_text("bench.nddl", text)))
    assert database.run_script() is None
    return database


def per_call(act: Callable[[], object], calls: int) -> float:
    """Microseconds of processor time per call, the best of three runs."""
    best = float("inf")
    for _ in range(3):
        start = time.process_time()
        for _ in range(calls):
            act()
        best = min(best, time.process_time() - start)
    return best / calls * MICRO


def measure(calls: int, length: int) -> PlanFigures:
    """Run all measurements."""
    database = loaded(ROVER)
    trip = next(t for t, label in database.script.labels.items() if label == "trip")
    rover = database.objects.numbers["rover"]
    at = next(n for n, each in enumerate(database.program.predicates) if each.name == "Rover.at")

    def token() -> None:
        mark = database.mark()
        database.new_token(at, rover, 1, -1)
        database.fire()
        database.release(mark)

    def rule() -> None:
        mark = database.mark()
        database.activate(trip)
        database.release(mark)

    def cancel() -> None:
        database.activate(trip)
        database.cancel(trip)
        database.commit()

    def remove() -> None:
        t = database.new_token(at, rover, 1, -1)
        database.fire()
        database.remove_tokens([t])
        database.commit()

    few = max(calls // 5, 1)
    timed = (per_call(token, calls), per_call(rule, calls), per_call(cancel, few), per_call(remove, few))
    chain = PlanDatabase(compile_model(analyse_text("chain.nddl", chain_text(length))))
    start = time.process_time()
    assert chain.run_script() is None
    seconds = time.process_time() - start
    return PlanFigures(build_form(), timed[0], timed[1], timed[2], timed[3], seconds * 1e6 / length)


def chain_text(length: int) -> str:
    """A chain of tokens, each before the next."""
    lines = ["class Link extends Timeline { predicate hold { } } Link link = new Link(); close();"]
    for i in range(length):
        lines.append(f"goal(link.hold g{i}); g{i}.duration = 2;")
        if i:
            lines.append(f"g{i - 1} before g{i};")
    return "\n".join(lines)


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    arguments = parser.parse_args()
    calls, length = (20000, 500) if build_form() == "compiled" else (300, 60)
    figures = measure(calls, length)
    if arguments.json:
        print(json.dumps(asdict(figures)))
        return
    print(f"plan database, {figures.form}")
    print(f"  token made and taken back          {figures.token_us:9.1f} us")
    print(f"  rule with two children, a guard    {figures.rule_us:9.1f} us")
    print(f"  the same, undone by cancel         {figures.cancel_us:9.1f} us")
    print(f"  token made and removed             {figures.remove_us:9.1f} us")
    print(f"  chain loaded, per 1000 tokens      {figures.chain_ms:9.1f} ms")


if __name__ == "__main__":
    main()
