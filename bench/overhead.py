"""Measure what the checker adds to bare missions, and what a second worker gains.

python bench/overhead.py                           models/gps
python bench/overhead.py models/auv/inl/mission.toml --missions 60

Start-up is left out: a figure is the difference between a long and a short batch, by the missions between them.
Overhead is in processor time (workers, the process that feeds them, and the store), so that it is right on a busy
machine too; scaling is in time by the clock and wants an idle one.
"""

import argparse
import os
import resource
import tempfile
import time
from dataclasses import dataclass, replace
from pathlib import Path

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
    """Of this process and of those that it has waited for."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return Spent(sum(one.ru_utime + one.ru_stime for one in used), time.perf_counter())


def bare(campaign: Campaign, missions: int) -> float:
    """Processor seconds of a mission flown and judged in this process; the first one, flown twice, warms up."""
    fly = campaign.load(campaign.models.agent)
    seeds = [mission_seed(campaign.mission.check.seed, number) for number in range(1, missions + 1)]
    fly(seeds[0])
    begun = now()
    for seed in seeds[SHORT:]:
        fly(seed)
    return (now() - begun).processor / (missions - SHORT)


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
    arguments = parser.parse_args()
    mission, _ = read_mission(arguments.mission)
    assert mission is not None
    models = load_models(mission)
    campaign = Campaign(mission, models, pinned(models))
    count = arguments.missions
    alone = bare(campaign, count)
    print(f"{mission.agent.name}: {1000 * alone:.2f} ms of a processor for a bare mission")
    clock = {}
    for workers in (1, 2):
        spent = batch(campaign, count, workers) - batch(campaign, SHORT, workers)
        each = spent.processor / (count - SHORT)
        clock[workers] = spent.clock
        more = 100.0 * (each / alone - 1.0)
        print(f"with {workers} worker{'s' if workers > 1 else ''}: {1000 * each:.2f} ms, {more:.1f} % more")
    others = os.getloadavg()[0] if hasattr(os, "getloadavg") else 0.0
    print(f"scaling on 2 workers: {clock[1] / clock[2]:.2f} (load of the machine: {others:.1f})")


if __name__ == "__main__":
    main()
