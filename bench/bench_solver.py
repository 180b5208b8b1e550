"""Time the search on problems of all sizes against EUROPA: `bench_solver.py [FAMILY[:N,N...]]... [--suite DIR]`.

Prints one row per problem: verdict, steps, milliseconds in the solver and of loading (processor time, the best of some
runs, so that other work on the machine counts little), the ratio to EUROPA, and how time grew since the size before
(the exponent); after each family the exponent that fits all its sizes best.

Families and EUROPA's figures (medians of its runs, not taken here) are those of the conformance suite, whose
folder is found by CONFORMANCE or --suite; without it only the problems of `bench/problems` are timed. These are held
against EUROPA itself if EUROPA_PROBE names a program that answers `load FILE` and `plan FILE CONFIG FROM TO STEPS
DEPTH`: the processor time of the second less that of the first.
"""

import csv
import os
import platform
import resource
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
from runtime.loading import load
from runtime.solver.configuration.read import read_configuration
from runtime.solver.search import Solver
from runtime.solver.tags import RESULT_NAMES

SIZES = {
    "survey_ordered": (8, 16, 32, 64, 128, 256, 512),
    "survey_free": (8, 16, 32, 64, 128, 256),
    "switches": (8, 16, 32, 64, 128, 256, 512),
    "unary": (8, 16, 32, 64),
    "jobshop": (8, 16, 32, 64),
    "chain": (64, 256, 1024, 2048),
    "queens": (8, 10, 12, 16, 20, 24),
}
PROBLEMS = {
    "prospector": ("plain", 0, 1000),  # of the kind of EUROPA's Rover
    "crates": ("plain", 0, 150),  # BlocksWorld
    "project": ("scarce", 0, 49),  # UBO
}
FOLDER = Path(__file__).resolve().parent / "problems"
LIMIT = 60.0  # seconds per problem
ENOUGH = 0.5  # seconds of runs per problem
LEAST_RUNS = 5
PROBES = 5  # runs of EUROPA


@dataclass(frozen=True)
class Measured:
    """One problem, solved."""

    verdict: str
    steps: int
    failures: int
    solving: float  # milliseconds, the best run
    loading: float


@dataclass(frozen=True)
class Deadline:
    """A time of the processor after which a search is stopped."""

    end: float

    def is_past(self) -> bool:
        """Whether it has come."""
        return time.process_time() > self.end


def run(path: Path, configured: Path, lower: int, upper: int, strategy: str) -> Measured:
    """Solve a problem some times."""
    configuration, _ = read_configuration(Source(configured.name, configured.read_text()))
    assert configuration is not None
    spent, runs, solving, loading = 0.0, 0, LIMIT, LIMIT
    while spent < ENOUGH or runs < LEAST_RUNS:
        runs += 1
        begun = time.process_time()
        database = load(path, (), Dialect("nddl3")).database
        assert database is not None
        loading = min(loading, time.process_time() - begun)
        solver = Solver(database, configuration, lower, upper, strategy == "europa")
        began = time.process_time()
        outcome = solver.solve(2**62, 2**62, Deadline(began + LIMIT).is_past)
        done = time.process_time()
        solving = min(solving, done - began)
        spent += done - begun
    return Measured(RESULT_NAMES[outcome], solver.steps, solver.failures, solving * 1e3, loading * 1e3)


def grow(suite: Path, family: str, size: int, strategy: str) -> Measured:
    """Solve one of a family of problems."""
    name, lower, upper = generated(suite, "--run", family, str(size)).split()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "problem.nddl")
        path.write_text(generated(suite, family, str(size)))
        return run(path, suite / "configs" / f"{name}.xml", int(lower), int(upper), strategy)


def generated(suite: Path, *arguments: str) -> str:
    """What the suite's generator prints."""
    command = [sys.executable, str(suite / "scaling" / "gen.py"), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def ask_europa(probe: str, path: Path, configured: Path, lower: int, upper: int) -> float:
    """How many milliseconds EUROPA takes to solve a problem that it has loaded."""
    arguments = [str(path), str(configured), str(lower), str(upper), "100000", "100000"]
    loading = min(child_time([probe, "load", arguments[0]]) for _ in range(PROBES))
    return (min(child_time([probe, "plan", *arguments]) for _ in range(PROBES)) - loading) * 1e3


def child_time(command: list[str]) -> float:
    """How many seconds of the processor a command takes."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def exponent(points: list[tuple[int, float]]) -> float:
    """The slope of the straight line that fits sizes and times best, both as logarithms."""
    xs = [log(size) for size, _ in points]
    ys = [log(time_taken) for _, time_taken in points]
    x, y = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((a - x) * (b - y) for a, b in zip(xs, ys, strict=True)) / sum((a - x) ** 2 for a in xs)


def row(name: str, size: str, found: Measured, theirs: float | None, growth: str) -> None:
    """Print one problem."""
    europa = f"{theirs:>11.2f}{theirs / found.solving:>8.1f}" if theirs else " " * 19
    print(f"{name:<15}{size:>6} {found.verdict:<10}{found.steps:>8}{found.failures:>8}", end="")
    print(f"{found.solving:>11.2f}{found.loading:>10.1f}{europa}{growth:>8}", flush=True)


def main(arguments: list[str]) -> int:
    """Print the table."""
    suite = Path(os.environ.get("CONFORMANCE", ""))
    if "--suite" in arguments:
        at = arguments.index("--suite")
        suite = Path(arguments[at + 1])
        del arguments[at : at + 2]
    strategy = "europa" if "--europa" in arguments else "nddlc"
    figures = suite / "scaling" / "europa.tsv"
    families = list(SIZES) if figures.is_file() else []
    wanted = [argument for argument in arguments if not argument.startswith("--")] or [*families, *PROBLEMS]
    print(f"{processor()}, {os.cpu_count()} cores, engine {build_form()}, {strategy}")
    print(f"{'family':<15}{'N':>6} {'verdict':<10}{'steps':>8}{'failed':>8}{'solve ms':>11}{'load ms':>10}", end="")
    print(f"{'EUROPA ms':>11}{'ratio':>8}{'growth':>8}")
    probe = os.environ.get("EUROPA_PROBE", "")
    for one in wanted:
        family, _, sizes = one.partition(":")
        if family in PROBLEMS:
            configured, lower, upper = PROBLEMS[family]
            text, xml = FOLDER / f"{family}.nddl", FOLDER / f"{configured}.xml"
            theirs = ask_europa(probe, text, xml, lower, upper) if probe else None
            row(family, "", run(text, xml, lower, upper, strategy), theirs, "")
            continue
        with figures.open() as file:
            known = {
                int(each["N"]): float(each["solve_ms"] or 0)
                for each in csv.DictReader(file, delimiter="\t")
                if each["family"] == family
            }
        points: list[tuple[int, float]] = []
        for size in [int(each) for each in sizes.split(",")] if sizes else SIZES[family]:
            found = grow(suite, family, size, strategy)
            points.append((size, found.solving))
            row(family, str(size), found, known.get(size), f"{exponent(points[-2:]):.2f}" if len(points) > 1 else "")
            if found.verdict == "timeout":
                break
        if len(points) > 2:
            print(f"{family:<15} grows as N^{exponent(points):.2f}")
    return 0


def processor() -> str:
    """What the machine calls its processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
