"""Fly many random missions beside the second agent: `python -m tests.executive.second.campaign 500 --first 1000`.

Each difference is to be judged by the specification. The second agent plans in one go what nddlc plans decision by
decision, by urgency, and goal by goal what nddlc searches as a whole. Of 16 differences in 1000 missions three were
looked at, and one was a fault of the second agent; the others are still to be judged.
"""

import sys
from argparse import ArgumentParser
from collections import Counter

from tests.executive.second.comparing import differences
from tests.executive.second.generator import random_mission

RARE = 30


def main() -> int:
    """Fly COUNT missions from FIRST on; 1 if more than one in `RARE` differs in which no planner had a choice."""
    parser = ArgumentParser()
    parser.add_argument("count", type=int)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--choices", action="store_true", help="show differences, too, where a planner had a choice")
    given = parser.parse_args()
    tally: Counter[str] = Counter()
    for seed in range(given.first, given.first + given.count):
        found, choices = differences(random_mission(seed))
        tally[f"{'differ' if found else 'equal'}{', where a planner had a choice' if choices else ''}"] += 1
        if found and (given.choices or not choices):
            print(f"DIFFERS {seed} ({choices} choices)", *found[:12], sep="\n  ", flush=True)
    print("; ".join(f"{count} {name}" for name, count in sorted(tally.items())))
    return 1 if tally["differ"] * RARE > given.count else 0


if __name__ == "__main__":
    sys.exit(main())
