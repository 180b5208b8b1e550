"""Fly many random missions beside the second agent: `python -m tests.executive.second.campaign 500 --first 1000`.

A difference is a fault of one of the two, to be judged by the specification, unless a planner had a choice.
"""

import sys
from argparse import ArgumentParser
from collections import Counter

from tests.executive.second.comparing import differences
from tests.executive.second.generator import (
    bounded_mission,
    following_mission,
    prioritised_mission,
    random_mission,
    storing_mission,
    windowed_mission,
)
from tests.executive.second.searching import TooHardError


def main() -> int:
    """Fly COUNT missions from FIRST on; 1 if any differs in which no planner had a choice."""
    parser = ArgumentParser()
    parser.add_argument("count", type=int)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--choices", action="store_true", help="show differences, too, where a planner had a choice")
    parser.add_argument("--bounds", action="store_true", help="of goals that say how long they may take")
    parser.add_argument("--turns", action="store_true", help="of a user whose model says what follows")
    parser.add_argument("--priorities", action="store_true", help="of a planner that decides some goals first")
    parser.add_argument("--windows", action="store_true", help="of a simulator that lets things begin at times only")
    parser.add_argument("--stores", action="store_true", help="of planners and owners that use stores")
    given = parser.parse_args()
    makes = {"bounds": bounded_mission, "turns": following_mission}
    makes |= {"windows": windowed_mission, "priorities": prioritised_mission, "stores": storing_mission}
    make = next((made for name, made in makes.items() if getattr(given, name)), random_mission)
    tally: Counter[str] = Counter()
    for seed in range(given.first, given.first + given.count):
        try:
            found, choices = differences(make(seed))
        except TooHardError:
            tally["too hard for the second agent"] += 1
            continue
        tally[f"{'differ' if found else 'equal'}{', where a planner had a choice' if choices else ''}"] += 1
        if found and (given.choices or not choices):
            print(f"DIFFERS {seed} ({choices} choices)", *found[:12], sep="\n  ", flush=True)
    print("; ".join(f"{count} {name}" for name, count in sorted(tally.items())))
    return 1 if tally["differ"] else 0


if __name__ == "__main__":
    sys.exit(main())
