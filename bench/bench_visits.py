"""Measure visits of planning reactors: microseconds by part of a visit, and missions per second flown and judged.

python bench/bench_visits.py               models/gps and models/auv/inl
python bench/bench_visits.py FILE COUNT    another mission, so often

The time of a part is the median over all visits, so that what else the machine does counts little.
"""

import sys
import time
from collections import defaultdict
from collections.abc import Callable
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any
from unittest.mock import patch

from runtime.build_form import build_form
from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import pinned
from checker.sampling.seeds import mission_seed
from runtime.executive.mission import record_mission
from runtime.executive.plan_reactor import PlanReactor

MODELS = Path(__file__).resolve().parent.parent / "models"
PARTS = ("start_tick", "synchronise", "observations", "step", "recalls", "requests", "refusals", "next_tick", "notify")
Times = dict[tuple[str, str], list[float]]


def timed(times: Times) -> type[PlanReactor]:
    """A planning reactor that notes how long each call takes, by reactor and part."""

    def watched(part: str) -> Callable[..., Any]:
        real = getattr(PlanReactor, part)

        def call(self: PlanReactor, *given: object) -> object:
            begun = time.perf_counter()
            found = real(self, *given)
            times[self.name, part].append(time.perf_counter() - begun)
            return found

        return call

    return type("Timed", (PlanReactor,), {part: watched(part) for part in PARTS})


def measure(file: Path, count: int) -> None:
    """Fly and judge missions, then fly them again with a watch; the first two are not counted."""
    mission, _ = read_mission(file)
    assert mission is not None
    models = load_models(mission)
    agent, load = models.agent, pinned(models)
    fly, programs = load(agent), load.programs_of(agent)
    seeds = [mission_seed(mission.check.seed, number) for number in range(count + 2)]
    spent = {}
    ways: tuple[tuple[str, Callable[[int], object]], ...] = (
        ("flown", partial(record_mission, agent, programs)),
        ("judged, too", fly),
    )
    for name, one in ways:
        for number, seed in enumerate(seeds):
            if number == 2:
                begun = time.process_time()
            one(seed)
        spent[name] = (time.process_time() - begun) / count
    print(f"{file.parent.name}, {count} missions, {build_form()}:")
    for name, seconds in spent.items():
        print(f"  {name:12} {1e3 * seconds:9.2f} ms a mission {1 / seconds:9.1f} missions/s of one core")
    times: Times = defaultdict(list)
    with patch("runtime.executive.mission.PlanReactor", timed(times)):
        for seed in seeds[2:]:
            record_mission(agent, programs, seed)
    for reactor in dict.fromkeys(name for name, _ in times):
        visits = len(times[reactor, "start_tick"])
        parts = {
            part: 1e6 * median(times[reactor, part] or [0.0]) * len(times[reactor, part]) / visits for part in PARTS
        }
        told = ", ".join(f"{part} {parts[part]:.1f}" for part in PARTS)
        print(f"  {reactor:12} {visits / count:7.1f} visits a mission, {sum(parts.values()):6.1f} us each: {told}")


def main() -> None:
    """Measure the missions that are named, or two of the models."""
    if len(sys.argv) == 3:
        measure(Path(sys.argv[1]), int(sys.argv[2]))
        return
    measure(MODELS / "gps/mission.toml", 100)
    measure(MODELS / "auv/inl/mission.toml", 3)


if __name__ == "__main__":
    main()
