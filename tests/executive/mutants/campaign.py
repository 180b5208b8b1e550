"""Mutants of all missions, flown in both forms of the engine: `python -m tests.executive.mutants.campaign 2000`."""

import os
import subprocess
import sys
from argparse import ArgumentParser
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).parents[3]
PORTION = 10  # mutants that one process flies


def flown(form: str, first: int, last: int, missions: int, seconds: int) -> list[str]:
    """What mutants do in one form of the engine: `1` interpreted, empty compiled."""
    command = [sys.executable, "-m", "tests.executive.mutants.flights", str(first), str(last)]
    command += ["--missions", str(missions), "--seconds", str(seconds)]
    done = subprocess.run(
        command, cwd=ROOT, env=os.environ | {"NDDLC_INTERPRETED": form}, stdout=subprocess.PIPE, text=True, check=False
    )
    lines = done.stdout.splitlines()
    return (
        lines
        if done.returncode == 0
        else [*lines, f"WRONG {first} to {last}: the process ended with {done.returncode}"]
    )


def departures(compiled: Sequence[str], interpreted: Sequence[str]) -> list[str]:
    """Flights that both forms carried out in their time and that differ, as lines that begin with `WRONG`."""
    ways = [
        {tuple(line.split()[:4]): line for line in lines if not line.startswith("WRONG") and not line.endswith(" slow")}
        for lines in (compiled, interpreted)
    ]
    both = [key for key in ways[0] if key in ways[1]]
    return [
        f"WRONG the forms differ: compiled {ways[0][key]}, interpreted {ways[1][key]}"
        for key in both
        if ways[0][key] != ways[1][key]
    ]


def tried(first: int, last: int, missions: int, seconds: int, *, both: bool) -> list[str]:
    """Some mutants, in both forms or compiled only: all lines of the compiled form, and what is wrong in either."""
    compiled = flown("", first, last, missions, seconds)
    if not both:
        return compiled
    interpreted = flown("1", first, last, missions, seconds * 30)
    wrong = [line for line in interpreted if line.startswith("WRONG") and line not in compiled]
    return [*compiled, *wrong, *departures(compiled, interpreted)]


def main() -> int:
    """Fly COUNT mutants from FIRST on; 1 if anything was wrong."""
    parser = ArgumentParser()
    parser.add_argument("count", type=int)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--missions", type=int, default=20)
    parser.add_argument("--seconds", type=int, default=60, help="for one flight, compiled")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--compiled-only", action="store_true")
    given = parser.parse_args()
    last = given.first + given.count
    counts: Counter[str] = Counter()
    wrong = 0
    with ThreadPoolExecutor(given.workers) as pool:
        portions = [
            pool.submit(tried, at, min(at + PORTION, last), given.missions, given.seconds, both=not given.compiled_only)
            for at in range(given.first, last, PORTION)
        ]
        for portion in portions:
            for line in portion.result():
                if line.startswith("WRONG"):
                    wrong += 1
                    print(line, flush=True)
                else:
                    counts[(line.split()[4:] or line.split()[3:])[0]] += 1
    print(f"{given.count} mutants: " + ", ".join(f"{name} {count}" for name, count in sorted(counts.items())))
    print(f"{wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
