"""Measure missions per second of one core, with the judge and without, and the memory of a mission.

python bench/missions.py                models/gps in both forms of the engine, models/auv/inl compiled
python bench/missions.py --json         one object: models/gps, this form only
python bench/missions.py --missions 40  more of them

The memory of a mission is what the process holds beyond what it held after loading, at half length and at full length.
"""

import argparse
import json
import os
import platform
import resource
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path

from runtime.build_form import build_form
from checker.batch.garbage import seldom_collected
from checker.flight import fly_programs
from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import pinned
from checker.sampling.seeds import mission_seed
from runtime.executive.mission import record_mission
from runtime.executive.outcome import Outcome

MODELS = Path(__file__).resolve().parent.parent / "models"
GPS, INL = MODELS / "gps/mission.toml", MODELS / "auv/inl/mission.toml"
MEBI = 1 << 20


@dataclass(frozen=True)
class MissionFigures:
    """What one form of the engine achieves: seconds of one core, start-up and the reading of models left out."""

    form: str
    missions: int
    failed: int
    events: int
    judged_per_second: float
    flown_per_second: float
    ticks_per_second: float  # of missions that are judged


def measure(file: Path, missions: int) -> MissionFigures:
    """Fly missions one after the other; the first one is flown twice before, for the second loads what is kept."""
    mission, _ = read_mission(file)
    assert mission is not None
    models = load_models(mission)
    agent = models.agent
    programs = pinned(models).programs_of(agent)
    seeds = [mission_seed(mission.check.seed, number) for number in range(missions)]
    with seldom_collected():  # as in a batch
        for _ in range(2):
            fly_programs(agent, programs, seeds[0])
        begun = time.process_time()
        for seed in seeds:
            record_mission(agent, programs, seed)
        flown = time.process_time() - begun
        figures = [_figures(fly_programs(agent, programs, seed)) for seed in seeds]  # no batch keeps its outcomes
        judged = time.process_time() - begun - flown
    failed, events, ticks = (sum(column) for column in zip(*figures, strict=True))
    return MissionFigures(build_form(), missions, failed, events, missions / judged, missions / flown, ticks / judged)


def _figures(outcome: Outcome) -> tuple[int, int, int]:
    """Whether a mission failed, its events, its ticks."""
    return int(outcome.abort is not None), len(outcome.events), outcome.last_tick


def memory(file: Path) -> list[tuple[int, float]]:
    """Ticks and MiB of a mission that is flown and judged to half its length, and to its end."""
    mission, _ = read_mission(file)
    assert mission is not None
    models = load_models(mission)
    agent = models.agent
    programs = pinned(models).programs_of(agent)
    fly_programs(agent, programs, 1, until=1)
    loaded = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    found = []
    for until in (agent.final_tick // 2, agent.final_tick):
        fly_programs(agent, programs, 1, until=until)
        most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        found.append((until, (most - loaded) * (1 if sys.platform == "darwin" else 1024) / MEBI))
    return found


def measured_elsewhere(missions: int, interpreted: bool) -> MissionFigures:
    """Measure one form in a process of its own."""
    command = [sys.executable, __file__, "--json", "--missions", str(missions)]
    environment = {**os.environ, "NDDLC_INTERPRETED": "1" if interpreted else "0"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    return MissionFigures(**json.loads(done.stdout))


def show(figures: MissionFigures) -> None:
    """Print one line."""
    print(
        f"{figures.form:>12}: {figures.judged_per_second:8.2f} missions/s judged {figures.flown_per_second:8.2f} flown"
        f" {figures.ticks_per_second:9.0f} ticks/s  ({figures.failed} failed, {figures.events} events)"
    )


def main() -> None:
    """Print the figures of both forms, their ratio, and those of a long mission."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--missions", type=int, default=20)
    arguments = parser.parse_args()
    if arguments.json:
        print(json.dumps(asdict(measure(GPS, arguments.missions))))
        return
    both = [measured_elsewhere(arguments.missions, interpreted) for interpreted in (False, True)]
    print(
        f"{GPS.parent.name}: {arguments.missions} missions, Python {platform.python_version()} (400 missions/s wanted)"
    )
    for figures in both:
        show(figures)
    compiled, interpreted = both
    if compiled.form == interpreted.form:
        print("the engine is not compiled: nothing to compare (`make build`)")
        return
    print(f"{'ratio':>12}: {compiled.judged_per_second / interpreted.judged_per_second:8.2f}")
    used = memory(INL)
    print(f"{INL.parent.name}: {max(arguments.missions // 4, 1)} missions (50 missions/s wanted)")
    show(measure(INL, max(arguments.missions // 4, 1)))
    told = ", ".join(f"{megabytes:.0f} MiB at {ticks} ticks" for ticks, megabytes in used)
    print(f"{'memory':>12}: {told} (50 MiB wanted, flat in its length)")


if __name__ == "__main__":
    main()
