"""Time the search on hard problems, with a plan and without: `bench_search.py [FAMILY[:N,N...]]... [--strategy S]`.

One row per problem: verdict, steps, failures, milliseconds in the solver. `--strategy europa` is the plain search.
"""

import argparse
import os
import platform
import tempfile
import time
from pathlib import Path

from runtime.build_form import build_form
from bench.hard_models import SIZES, model
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.source import Source
from runtime.loading import load
from runtime.solver.configuration.read import read_configuration
from runtime.solver.search import Solver
from runtime.solver.tags import RESULT_NAMES

LIMIT = 20.0  # seconds per problem
HORIZON = (0, 1000)
CONFIGURATION = """\
[[filter]]
component = "HorizonFilter"
[[manager]]
component = "ThreatManager"
default_priority = 0
[[manager]]
component = "OpenConditionManager"
default_priority = 0
[[manager]]
component = "UnboundVariableManager"
default_priority = 1
filter = [
  { variable = "start" }, { variable = "end" }, { variable = "duration" }, { variable = "time" },
  { component = "InfiniteDynamicFilter" },
]
[[manager]]
component = "ResourceThreatManager"
default_priority = 2
order = "most,earliest,lower"
"""


def run(text: str, strategy: str) -> tuple[str, int, int, float]:
    """Verdict, steps, failures and milliseconds."""
    configuration, complaints = read_configuration(Source("hard.toml", CONFIGURATION))
    assert configuration is not None, complaints
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "problem.nddl")
        path.write_text(text)
        loaded = load(path, (), Dialect("nddl3"))
        assert loaded.database is not None and not loaded.is_refused, [each.message for each in loaded.diagnostics]
        solver = Solver(loaded.database, configuration, *HORIZON, strategy == "europa")
        begun = time.perf_counter()
        end = begun + LIMIT
        outcome = solver.solve(2**62, 2**62, lambda: time.perf_counter() > end)
        done = time.perf_counter()
    return RESULT_NAMES[outcome], solver.steps, solver.failures, (done - begun) * 1e3


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("families", nargs="*", default=list(SIZES))
    parser.add_argument("--strategy", choices=["nddlc", "europa"], default="nddlc")
    options = parser.parse_args()
    print(
        f"{platform.machine()}, {os.cpu_count()} cores, engine {build_form()}, {options.strategy}, limit {LIMIT:.0f} s"
    )
    print(f"{'family':<12}{'N':>4} {'variant':<12}{'verdict':<11}{'steps':>9}{'failed':>9}{'ms':>11}")
    for one in options.families:
        family, _, sizes = one.partition(":")
        for feasible in (True, False):
            for n in [int(each) for each in sizes.split(",")] if sizes else SIZES[family]:
                verdict, steps, failures, ms = run(model(family, n, feasible), options.strategy)
                variant = "feasible" if feasible else "infeasible"
                print(f"{family:<12}{n:>4} {variant:<12}{verdict:<11}{steps:>9}{failures:>9}{ms:>11.1f}", flush=True)
                if verdict == "timeout":
                    break


if __name__ == "__main__":
    main()
