"""Measure what the checker adds to bare missions, and what a second worker gains.

python bench/overhead.py                           models/gps
python bench/overhead.py models/auv/inl/mission.toml --missions 60

Start-up is left out: a figure is the difference between a long and a short batch, by the missions between them.
A bare mission is flown, judged and has its behaviour noted, as in a batch: what a batch adds are draws of the schedule,
workers, the process that feeds them, and the store. Overhead is in processor time. What else a machine does slows that
too, so bare missions and batches take turns, in rounds; the middle one of their overheads is told, with the least and
the greatest. Scaling is in time by the clock and wants an idle machine.
"""

import argparse
import os
import resource
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median

from checker.batch.store import open_store
from checker.campaign import Campaign
from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import pinned
from checker.sampling.seeds import mission_seed

MISSION = Path(__file__).resolve().parent.parent / "models/gps/mission.toml"
SHORT = 10


@dataclass(frozen=True)
class Spent:
    """Seconds of processors, and by the clock."""

    processor: float
    clock: float

    def __sub__(self, other: "Spent") -> "Spent":
        return Spent(self.processor - other.processor, self.clock - other.clock)


def now() -> Spent:
    """Of this process, its children, and those that they have waited for: workers are children of a server of forks."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    ended = sum(one.ru_utime + one.ru_stime for one in used)
    return Spent(ended + sum(map(_of_child, Path("/proc").glob("[0-9]*/stat"))), time.perf_counter())


def _of_child(stat: Path) -> float:
    """Seconds of a living child of this process, and of what that has waited for; 0 for other processes."""
    try:
        fields = stat.read_text().rpartition(")")[2].split()
    except OSError:  # it has ended
        return 0.0
    is_child = int(fields[1]) == os.getpid()
    return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK") if is_child else 0.0


def bare(fly: Callable[[int], object], seeds: list[int]) -> float:
    """Processor seconds of a mission flown and judged in this process; the first one, flown twice, warms up."""
    fly(seeds[0])
    begun = now()
    for seed in seeds:
        fly(seed)
    return (now() - begun).processor / len(seeds)


def batch(campaign: Campaign, missions: int, workers: int) -> Spent:
    """What a batch of missions takes, store and start-up included."""
    check = replace(campaign.mission.check, missions=missions)
    campaign = replace(campaign, mission=replace(campaign.mission, check=check))
    with tempfile.TemporaryDirectory() as folder:
        begun = now()
        with open_store(Path(folder) / "runs.sqlite") as store:
            campaign.fly(workers, store)
        return now() - begun


def main() -> None:
    """Print overhead and scaling."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mission", nargs="?", type=Path, default=MISSION)
    parser.add_argument("--missions", type=int, default=400)
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    mission, _ = read_mission(arguments.mission)
    assert mission is not None
    models = load_models(mission)
    campaign = Campaign(mission, models, pinned(models))
    count = arguments.missions
    fly = campaign.load(campaign.models.agent)
    seeds = [mission_seed(mission.check.seed, number) for number in range(SHORT + 1, count + 1)]
    alone: list[float] = []
    each: dict[int, list[float]] = {1: [], 2: []}
    clock: dict[int, list[float]] = {1: [], 2: []}
    batch(campaign, SHORT, 1)  # the server of forks is started once
    for _ in range(arguments.rounds):
        for workers in (1, 2):
            before = bare(fly, seeds)
            spent = batch(campaign, count, workers) - batch(campaign, SHORT, workers)
            alone.append((before + bare(fly, seeds)) / 2)
            each[workers].append(spent.processor / len(seeds) / alone[-1] - 1.0)
            clock[workers].append(spent.clock)
    print(f"{mission.agent.name}: {1000 * median(alone):.2f} ms of a processor for a bare mission")
    for workers, more in each.items():
        least, middle, most = (100.0 * one for one in (min(more), median(more), max(more)))
        print(f"with {workers} worker{'s' if workers > 1 else ''}: {middle:.1f} % more ({least:.1f} to {most:.1f})")
    others = os.getloadavg()[0] if hasattr(os, "getloadavg") else 0.0
    print(f"scaling on 2 workers: {median(clock[1]) / median(clock[2]):.2f} (load of the machine: {others:.1f})")


if __name__ == "__main__":
    main()
