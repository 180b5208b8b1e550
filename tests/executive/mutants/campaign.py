"""Mutants of all missions, flown in both forms of the engine: `python -m tests.executive.mutants.campaign 2000`."""

import os
import subprocess
import sys
from argparse import ArgumentParser, Namespace
from collections import Counter
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from tests.executive.mutants.flights import NOT_FLOWN

ROOT = Path(__file__).parents[3]
PORTION = 40  # mutants that one process flies
SLOWER = 30  # so many times as long may a flight take that is interpreted


@dataclass(frozen=True, slots=True)
class Campaign:
    """How mutants are flown; see `flights`."""

    seconds: float = 60.0
    whole: float = 600.0
    until: int | None = None
    only: str = ""
    general: int = sys.maxsize
    general_until: int | None = None
    ticks: tuple[int, int] = (0, sys.maxsize)

    def flown(self, form: str, mutants: Sequence[tuple[int, int]]) -> list[str]:
        """What mutants do in so many missions, in one form of the engine: `1` interpreted, empty compiled."""
        command = [sys.executable, "-m", "tests.executive.mutants.flights", *(f"{one}:{many}" for one, many in mutants)]
        command += ["--seconds", str(self.seconds * (SLOWER if form else 1)), "--whole", str(self.whole)]
        command += ["--general", str(self.general)]
        command += ["--ticks", *map(str, self.ticks), "--only", self.only]
        for option, tick in (("--until", self.until), ("--general-until", self.general_until)):
            command += [option, str(tick)] if tick is not None else []
        environment = os.environ | {"NDDLC_INTERPRETED": form}
        done = subprocess.run(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True, check=False)
        lines = done.stdout.splitlines()
        if done.returncode:
            lines.append(f"WRONG {mutants[0][0]} to {mutants[-1][0]}: the process ended with {done.returncode}")
        return lines

    def tried(self, first: int, last: int, missions: int, *, both: bool) -> "Tally":
        """Some mutants, in both forms or compiled only; what was slow compiled is not flown interpreted."""
        compiled = self.flown("", [(number, missions) for number in range(first, last)])
        tally = Tally()
        tally.count("flights", flights_in(compiled).values())
        tally.wrong += [line for line in compiled if line.startswith("WRONG")]
        carried_out = Counter(int(key[0]) for key in flights_in(compiled))
        if both and carried_out:
            interpreted = self.flown("1", sorted(carried_out.items()))
            tally.wrong += [line for line in interpreted if line.startswith("WRONG") and line not in compiled]
            tally.wrong += departures(compiled, interpreted)
            tally.count("in both forms", flights_in(interpreted).values())
        for line in compiled:
            if line.split()[-1] in NOT_FLOWN:
                tally.counts[line.split()[1], line.split()[-1]] += 1
        for mission in dict.fromkeys(tuple(key[:2]) for key in flights_in(compiled)):
            tally.counts[mission[1], "mutants"] += 1
        return tally


@dataclass(slots=True)
class Tally:
    """How many flights of which kind there were, by mission; and what was wrong."""

    counts: Counter[tuple[str, str]] = field(default_factory=Counter)
    codes: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)

    def count(self, kind: str, lines: Iterable[str]) -> None:
        """Have lines of flights of one kind."""
        for line in lines:
            self.counts[line.split()[1], kind] += 1
            if kind == "flights":
                self.codes[line.split()[4]] += 1

    def add(self, other: "Tally") -> None:
        """Have what another one has."""
        self.counts.update(other.counts)
        self.codes.update(other.codes)
        self.wrong += other.wrong

    def table(self) -> str:
        """One line for each folder of missions whose models are small, and for each other mission."""
        kinds = ("mutants", "flights", "in both forms", *NOT_FLOWN)
        sums: Counter[tuple[str, str]] = Counter()
        for (mission, kind), count in self.counts.items():
            name = mission.rsplit("/", 1)[0] if mission.startswith("tests/") else mission
            sums[name, kind] += count
            sums["all", kind] += count
        names = [*sorted({name for name, _ in sums} - {"all"}), "all"]
        lines = [", ".join(f"{sums[name, kind]} {kind}" for kind in kinds) for name in names]
        codes = ", ".join(f"{code} {count}" for code, count in sorted(self.codes.items()))
        return "\n".join([*(f"{name}: {line}" for name, line in zip(names, lines, strict=True)), f"ended by {codes}"])


def flights_in(lines: Sequence[str]) -> dict[tuple[str, ...], str]:
    """The lines of flights that were carried out, by number, mission, fault and seed."""
    return {
        tuple(line.split()[:4]): line
        for line in lines
        if not line.startswith("WRONG") and line.split()[-1] not in NOT_FLOWN
    }


def departures(compiled: Sequence[str], interpreted: Sequence[str]) -> list[str]:
    """Flights that both forms carried out in their time and that differ, as lines that begin with `WRONG`."""
    ways = [flights_in(lines) for lines in (compiled, interpreted)]
    both = [key for key in ways[0] if key in ways[1]]
    return [
        f"WRONG the forms differ: compiled {ways[0][key]}, interpreted {ways[1][key]}"
        for key in both
        if ways[0][key] != ways[1][key]
    ]


def arguments() -> Namespace:
    """What the command line says."""
    parser = ArgumentParser()
    parser.add_argument("count", type=int)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--missions", type=int, default=20)
    parser.add_argument("--seconds", type=float, default=20.0, help="for one flight, compiled")
    parser.add_argument("--whole", type=float, default=600.0, help="seconds for all flights of a mutant, in each form")
    parser.add_argument("--until", type=int, help="the tick at which missions are ended")
    parser.add_argument("--general", type=int, default=sys.maxsize, help="missions that the general engine flies too")
    parser.add_argument("--general-until", type=int, help="the tick at which the general engine's missions are ended")
    parser.add_argument("--ticks", type=int, nargs=2, default=(0, sys.maxsize), help="final ticks, from and to before")
    parser.add_argument("--only", default="", help="what the paths of mission files begin with: models/auv")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--compiled-only", action="store_true")
    return parser.parse_args()


def main() -> int:
    """Fly COUNT mutants from FIRST on; 1 if anything was wrong."""
    given = arguments()
    campaign = Campaign(
        given.seconds, given.whole, given.until, given.only, given.general, given.general_until, tuple(given.ticks)
    )
    last = given.first + given.count
    whole = Tally()
    with ThreadPoolExecutor(given.workers) as pool:
        portions = [
            pool.submit(campaign.tried, at, min(at + PORTION, last), given.missions, both=not given.compiled_only)
            for at in range(given.first, last, PORTION)
        ]
        for portion in portions:
            tally = portion.result()
            whole.add(tally)
            for line in tally.wrong:
                print(line, flush=True)
            print(f"{whole.counts.total()}", end="\r", file=sys.stderr)
    print(whole.table())
    print(f"{len(whole.wrong)} wrong")
    return 1 if whole.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
