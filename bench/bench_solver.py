"""Time the search on growing problems against EUROPA's figures: `bench_solver.py [FAMILY[:N,N...]]... [--suite DIR]`.

Prints one row per problem: verdict, steps, milliseconds in the solver (the best of some runs), the ratio to EUROPA, and
how time grew since the size before (the exponent). EUROPA's figures and the generator of problems are those of the
conformance suite, whose folder is found by CONFORMANCE or --suite.
"""

import csv
import os
import platform
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from math import log
from pathlib import Path

from runtime.build_form import build_form
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.source import Source
from nddlc.loading import load
from runtime.solver.codes import RESULT_NAMES
from runtime.solver.read import read_configuration
from runtime.solver.search import Solver

SIZES = {
    "survey_ordered": (8, 16, 32, 64, 128, 256, 512),
    "survey_free": (8, 16, 32, 64, 128, 256),
    "switches": (8, 16, 32, 64, 128, 256, 512),
    "unary": (8, 16, 32, 64),
    "jobshop": (8, 16, 32, 64),
    "chain": (64, 256, 1024, 2048),
    "queens": (8, 10, 12, 16, 20, 24),
}
LIMIT = 60.0  # seconds per problem
ENOUGH = 0.5  # seconds of runs per problem


@dataclass(frozen=True)
class Measured:
    """One problem, solved."""

    verdict: str
    steps: int
    failures: int
    solving: float  # milliseconds, the best run
    loading: float


def run(suite: Path, family: str, size: int, strategy: str) -> Measured:
    """Solve a problem some times."""
    text = generated(suite, family, str(size))
    name, lower, upper = generated(suite, "--run", family, str(size)).split()
    source = Source(name, (suite / "configs" / f"{name}.xml").read_text())
    configuration, _ = read_configuration(source)
    assert configuration is not None
    spent, best = 0.0, None
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "problem.nddl")
        path.write_text(text)
        while best is None or spent < ENOUGH:
            begun = time.perf_counter()
            database = load(path, (), Dialect("nddl3")).database
            assert database is not None
            loaded = time.perf_counter()
            solver = Solver(database, configuration, int(lower), int(upper), strategy == "europa")
            began = time.perf_counter()
            end = began + LIMIT
            outcome = solver.solve(2**62, 2**62, lambda end=end: time.perf_counter() > end)
            done = time.perf_counter()
            spent += done - begun
            found = Measured(
                RESULT_NAMES[outcome], solver.steps, solver.failures, (done - began) * 1e3, (loaded - begun) * 1e3
            )
            if best is None or found.solving < best.solving:
                best = found
    return best


def generated(suite: Path, *arguments: str) -> str:
    """What the suite's generator prints."""
    command = [sys.executable, str(suite / "scaling" / "gen.py"), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def main(arguments: list[str]) -> int:
    """Print the table."""
    suite = Path(os.environ.get("CONFORMANCE", ""))
    if "--suite" in arguments:
        at = arguments.index("--suite")
        suite = Path(arguments[at + 1])
        del arguments[at : at + 2]
    strategy = "europa" if "--europa" in arguments else "nddlc"
    wanted = [argument for argument in arguments if not argument.startswith("--")] or list(SIZES)
    with (suite / "scaling" / "europa.tsv").open() as file:
        europa = {(row["family"], int(row["N"])): row for row in csv.DictReader(file, delimiter="\t")}
    print(f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores, engine {build_form()}, {strategy}")
    print(f"{'family':<15}{'N':>6} {'verdict':<10}{'steps':>8}{'failed':>8}{'solve ms':>11}{'load ms':>10}", end="")
    print(f"{'EUROPA ms':>11}{'ratio':>8}{'growth':>8}")
    for one in wanted:
        family, _, sizes = one.partition(":")
        before: tuple[int, float] | None = None
        for size in [int(each) for each in sizes.split(",")] if sizes else SIZES[family]:
            found = run(suite, family, size, strategy)
            theirs = (europa.get((family, size)) or {}).get("solve_ms") or ""
            ratio = f"{float(theirs) / found.solving:.1f}" if theirs else ""
            growth = f"{log(found.solving / before[1]) / log(size / before[0]):.2f}" if before else ""
            print(f"{family:<15}{size:>6} {found.verdict:<10}{found.steps:>8}{found.failures:>8}", end="")
            print(f"{found.solving:>11.2f}{found.loading:>10.1f}{theirs:>11}{ratio:>8}{growth:>8}", flush=True)
            before = (size, found.solving)
            if found.verdict == "timeout":
                break
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
