"""Measure explanations on faults drawn before any was flown: `python -m tests.checker.scheme_study ward lab`.

Each model of `unseen` that has a `faults.toml` was written with its faults for this: nine were looked at while rules
were made (ward, theatre, orchard; brewery, apron, lab; canal, bakery, icecore), three are only measured (laundry,
quarry, tram). Four are of somebody who knew the docs alone (greenhouse, cablecar, drill, papermill), three of another
one (crane, groomer, observatory).
"""

import sys
import tomllib
from collections.abc import Collection
from pathlib import Path

from checker.counterfactual.effort import Bounds
from checker.counterfactual.search import sites_in
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.choice import Mutant
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import EditKind
from checker.yardstick import TOP, Fate, MutantReport, measure_mutant, open_flyer, prepare
from nddl_lang.text.read import real_path

UNSEEN = Path(__file__).resolve().parent / "unseen"
MISSIONS, SECONDS = 3, 300.0


def mutant_of(fault: dict[str, str | int], folder: Path, sites: list[EditSite]) -> Mutant:
    """The mutant that a fault of the file stands for: a whole line gives way to another one."""
    file, line = str(real_path(folder / str(fault["file"]))), int(fault["line"])
    old, new = str(fault["old"]), str(fault["new"])
    before = "".join((folder / str(fault["file"])).read_text().splitlines(keepends=True)[: line - 1])
    begin = (folder / str(fault["file"])).read_text().index(old, len(before))
    kind = EditKind.CONSTANT if new else EditKind.DROPPED_CONSTRAINT
    site = next(one for one in sites if one.holds(file, line) and not one.is_rule)
    return Mutant(site, SmallEdit(kind, file, begin, begin + len(old), old, new, line))


def reports(name: str, lines: Collection[str] = ()) -> list[MutantReport]:
    """All faults of one model, flown and explained; or those alone that leave one of these lines."""
    mission, found = read_mission(UNSEEN / name / "mission.toml")
    assert mission is not None, found
    models = load_models(mission)
    faults = tomllib.loads((UNSEEN / name / "faults.toml").read_text())["fault"]
    faults = [one for one in faults if not lines or one["new"] in lines]
    sites = sites_in(models.agent)
    with open_flyer(mission, models) as flyer:
        ground = prepare(mission, models, MISSIONS, flyer)
        tried = (
            measure_mutant(ground, mutant_of(one, UNSEEN / name, sites), flyer, Bounds(seconds=SECONDS))
            for one in faults
        )
        return [one for one in tried if one is not None]


def main() -> None:
    """Print the figures of each model that is named."""
    for name in sys.argv[1:]:
        failing = [one for one in reports(name) if one.fate is Fate.FAILS]
        for is_drop, what in ((False, "changed lines"), (True, "dropped lines, by rule")):
            group = [one for one in failing if one.is_drop is is_drop]
            first, top = sum(one.place == 1 for one in group), sum(1 <= one.place <= TOP for one in group)
            print(f"{name}: {len(group)} {what}: {first} first, {top} in the top {TOP}")
        print(f"{name}: {sum(one.faults == 1 for one in failing)} of {len(failing)} are one fault", flush=True)


if __name__ == "__main__":
    main()
