"""Fly many random agents: `python -m tests.executive.generated.campaign 500 --first 1000`; 1 if anything was wrong."""

import sys
from argparse import ArgumentParser
from collections import Counter

from tests.executive.generated.flights import faults_of
from tests.executive.generated.writer import random_agent

PLAIN = 4  # so many agents in a row, one can be written as an agent file of T-REX


def faults_of_seed(
    seed: int,
    wide: bool = False,
    rich: bool = False,
    deep: bool = False,
    ranks: bool = False,
    replays: bool = False,
    batches: bool = False,
) -> tuple[str, list[str]]:
    """How the agent of a seed ended, and what is wrong about its flights."""
    outcome, wrong = faults_of(random_agent(seed, seed % PLAIN == 0, wide, rich, deep, ranks), replays, batches)
    codes = [event.code for event in outcome.events if event.code]
    return codes[0] if codes else "ended", wrong


def main() -> int:
    """Fly COUNT agents from FIRST on."""
    parser = ArgumentParser()
    parser.add_argument("count", type=int)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--wide", action="store_true", help="with guards, ties, clocks and one planner more")
    parser.add_argument("--rich", action="store_true", help="with draws, stores, fractions, early and late timelines")
    parser.add_argument("--deep", action="store_true", help="with long chains, objects, enumerations, few steps")
    parser.add_argument("--ranks", action="store_true", help="with priorities, shared stores, more simulators")
    parser.add_argument("--batches", type=int, default=0, help="each so many agents, a batch of one, too")
    given = parser.parse_args()
    codes: Counter[str] = Counter()
    wrong = 0
    for seed in range(given.first, given.first + given.count):
        batches = bool(given.batches) and seed % given.batches == 0
        code, faults = faults_of_seed(seed, given.wide, given.rich, given.deep, given.ranks, True, batches)
        codes[code] += 1
        wrong += bool(faults)
        for fault in faults:
            print(f"WRONG {seed} {fault}", flush=True)
    print(", ".join(f"{code} {count}" for code, count in sorted(codes.items())))
    print(f"{given.count} agents, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
