"""Measure missions per second of models/gps, the engine compiled against interpreted, as a ratio from one run.

python bench/missions.py                both forms, each in a process of its own
python bench/missions.py --json         one object, this form only
python bench/missions.py --missions 40  more of them
"""

import argparse
import json
import os
import platform
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path

from runtime.build_form import build_form
from checker.flight import load
from checker.mission import read_mission
from checker.models import load_models
from checker.sampling.seeds import mission_seed

MISSION = Path(__file__).resolve().parent.parent / "models/gps/mission.toml"


@dataclass(frozen=True)
class MissionFigures:
    """What one form of the engine achieves: seconds of one core, start-up and the reading of models left out."""

    form: str
    missions: int
    failed: int
    events: int
    missions_per_second: float
    ticks_per_second: float


def measure(missions: int) -> MissionFigures:
    """Fly missions one after the other; the first one, which is flown twice, warms up."""
    mission, _ = read_mission(MISSION)
    assert mission is not None
    fly = load(load_models(mission).agent)
    seeds = [mission_seed(mission.check.seed, number) for number in range(missions)]
    fly(seeds[0])
    begun = time.process_time()
    outcomes = [fly(seed) for seed in seeds]
    spent = time.process_time() - begun
    return MissionFigures(
        build_form(),
        missions,
        sum(outcome.abort is not None for outcome in outcomes),
        sum(len(outcome.events) for outcome in outcomes),
        missions / spent,
        sum(outcome.last_tick for outcome in outcomes) / spent,
    )


def measured_elsewhere(missions: int, interpreted: bool) -> MissionFigures:
    """Measure one form in a process of its own."""
    command = [sys.executable, __file__, "--json", "--missions", str(missions)]
    environment = {**os.environ, "NDDLC_INTERPRETED": "1" if interpreted else "0"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    return MissionFigures(**json.loads(done.stdout))


def main() -> None:
    """Print the figures of both forms, and their ratio."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--missions", type=int, default=20)
    arguments = parser.parse_args()
    if arguments.json:
        print(json.dumps(asdict(measure(arguments.missions))))
        return
    both = [measured_elsewhere(arguments.missions, interpreted) for interpreted in (False, True)]
    print(f"{MISSION.parent.name}: {arguments.missions} missions, Python {platform.python_version()}")
    for figures in both:
        print(
            f"{figures.form:>12}: {figures.missions_per_second:8.2f} missions/s {figures.ticks_per_second:8.0f} ticks/s"
            f"  ({figures.failed} failed, {figures.events} events)"
        )
    compiled, interpreted = both
    if compiled.form == interpreted.form:
        print("the engine is not compiled: nothing to compare (`make build`)")
        return
    print(f"{'ratio':>12}: {compiled.missions_per_second / interpreted.missions_per_second:8.2f}")


if __name__ == "__main__":
    main()
