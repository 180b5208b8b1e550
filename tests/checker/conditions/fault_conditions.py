"""The conditions that a report prints of models with a fault, each measured on fresh missions: `make fault-conditions`.

    python -m tests.checker.conditions.fault_conditions [--missions 60] [--fresh 2000] [--seconds 120] MODEL...

A MODEL is a folder with faults, as for `fault_study`. A condition is wrong that lacks precision or recall and is not
marked as partial. Where no mission fails, or all do, there is none.
"""

import sys
import time
from argparse import ArgumentParser
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from checker.batch.worker import Task, fly_one
from checker.campaign import Campaign
from checker.conditions.condition import Condition
from checker.conditions.flights import label_of
from checker.conditions.measure import Quality, measured_on
from checker.conditions.rendering import condition_text
from checker.conditions.space import Space
from checker.counterfactual.effort import Bounds
from checker.mission import read_mission
from checker.models import load_models
from checker.oracle import Verdict
from checker.pinned import pinned
from checker.sampling.seeds import mission_seed
from tests.checker.conditions.truth_study import FRESH_SEED, LEAST
from tests.checker.fault_study import Fault, faults_in, laid_out

_LEAST_FRESH = 30  # missions that fail, to speak of a recall


@dataclass(frozen=True, slots=True)
class Printed:
    """A condition as a report prints it, and what fresh missions say of it; `failing` of them are of its fault."""

    condition: Condition
    quality: Quality
    failing: int

    @property
    def is_right(self) -> bool:
        """Whether it separates failing from passing missions."""
        return min(self.quality.precision.value, self.quality.recall.value) >= LEAST

    @property
    def is_honest(self) -> bool:
        """Whether it is right, or marked as partial."""
        return self.is_right or self.condition.is_partial


def printed_conditions(
    folder: Path, fault: Fault, place: Path, missions: int, fresh: int, seconds: float
) -> list[Printed]:
    """The conditions of a model with a fault of which some missions fail and some pass."""
    mission, _ = read_mission(laid_out(folder, fault, place) / "mission.toml")
    models = load_models(mission) if mission is not None else None
    if mission is None or models is None or models.has_errors:
        return []
    given = Campaign(mission, models, pinned(models))
    fly = given.load(models.agent)
    results = tuple(given.judged(fly_one(fly, given.task(number))) for number in range(1, missions + 1))
    failed = sum(one.verdict is Verdict.FAIL for one in results)
    if failed in (0, missions) or any(one.verdict is Verdict.ERROR for one in results):
        return []
    faults = given.assess(results, bounds=Bounds(seconds=seconds), seconds=seconds).faults
    told = [(one.bucket, one.condition) for one in faults if one.condition is not None]
    space = Space(models.agent, results)
    ends, begun = [], time.process_time()
    for number in range(fresh if told else 0):
        if time.process_time() - begun > seconds:
            break
        ends.append(given.judged(fly_one(fly, Task(number, mission_seed(FRESH_SEED, number)))))
    found = []
    for bucket, condition in told:
        labels = [(space.row(one), label_of(one, bucket)) for one in ends]
        rows = [(row, label) for row, label in labels if row is not None and label is not None]
        failing = sum(bucket.holds(one) for one in ends if one.verdict is Verdict.FAIL)
        found.append(Printed(condition, measured_on(rows, condition.conjunctions), failing))
    return found


def conditions_of(
    folder: Path, missions: int, fresh: int, seconds: float
) -> Iterator[tuple[int, Fault, list[Printed]]]:
    """The conditions that are printed of each fault of a model."""
    with TemporaryDirectory() as place:
        for number, fault in enumerate(faults_in(folder), 1):
            shown = printed_conditions(folder, fault, Path(place) / str(number), missions, fresh, seconds)
            yield number, fault, shown


def main() -> int:
    """Print each condition with its figures, and totals; the number of those that claim too much."""
    parser = ArgumentParser(prog="fault_conditions")
    parser.add_argument("models", nargs="+", type=Path)
    parser.add_argument("--missions", type=int, default=60)
    parser.add_argument("--fresh", type=int, default=2000)
    parser.add_argument("--seconds", type=float, default=120.0)
    chosen = parser.parse_args()
    everything: list[Printed] = []
    for folder in chosen.models:
        for number, fault, shown in conditions_of(folder, chosen.missions, chosen.fresh, chosen.seconds):
            for one in shown:
                print(f"{folder.name} {number} {fault.kind}: {tell(one)}", flush=True)
            everything += shown
    enough = [one for one in everything if one.failing >= _LEAST_FRESH]
    counts = (sum(one.is_right for one in enough), sum(one.condition.is_partial for one in enough), len(enough))
    print(f"{len(everything)} conditions; of {counts[2]} with {_LEAST_FRESH} failing fresh missions or more ", end="")
    print(f"{counts[0]} are right, {counts[1]} marked as partial")
    return sum(not one.is_honest for one in enough)


def tell(one: Printed) -> str:
    """A condition with its figures on fresh missions."""
    mark = "right" if one.is_right else "partial" if one.condition.is_partial else "WRONG"
    quality = one.quality
    figures = f"precision {quality.precision.value:.3f}, recall {quality.recall.value:.3f}"
    where = f"{quality.fresh} fresh missions, {one.failing} of which fail so"
    return f"{mark} {figures} on {where}: {condition_text(one.condition)}"


if __name__ == "__main__":
    sys.exit(main() > 0)
