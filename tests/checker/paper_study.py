"""What the founding paper found (trex 4 rows 28 to 31, 33 and 39), flown again in portions: `make study`.

    python -m tests.checker.paper_study 200          all of it, some 8000 missions
    python -m tests.checker.paper_study 20           20 missions of each cell; more may follow later

Each part says what was asked and what was found. What is flown is kept in build/study.sqlite, and the next call goes on
from there.
"""

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from checker.batch.store import RunStore, open_store
from checker.campaign import Campaign
from checker.mission import read_mission
from checker.models import load_models
from checker.oracle import Verdict
from checker.pinned import pinned
from checker.sampling.sampler import RandomSampler, Sampler, Setting
from checker.study.cells import campaign_of, lay_out
from checker.study.reading import StudyFile, Variant, read_study
from nddlc.main import run
from nddlc.samplers import find_sampler

ROOT = Path(__file__).parents[2]
STUDY = ROOT / "models/auv/study.toml"
_OUT = ROOT / "build/study"
_STORE = ROOT / "build/study.sqlite"
_HOT = 0.54 / 0.9  # B2 fails beyond this share of the half-range of both error rates


def campaign(study: StudyFile, variant: Variant, sampling: str, sampler: str = "random") -> Campaign:
    """The batch of a variant under a sampling, by a sampler."""
    mission, found = read_mission(lay_out(study, variant, _OUT / "variants"))
    assert mission is not None, found
    models = load_models(mission)
    assert not models.has_errors, models.diagnostics
    make: Callable[[Setting], Sampler] = RandomSampler if sampler == "random" else find_sampler(sampler)[1]
    flown = campaign_of(study, variant, sampling, Campaign(mission, models, pinned(models)))
    return replace(flown, sampler_name=sampler, make_sampler=make)


def adaptive(study: StudyFile, variants: dict[str, Variant], missions: int, store: RunStore) -> bool:
    """Row 39: of B2 the adaptive sampler has twice the failures, a quarter of its missions elsewhere, a right rate."""
    asked = replace(variants["B2"], missions=missions)
    flight = campaign(study, asked, "uniform inter", "adaptive")
    flown = flight.fly(1, store, keeps_failures=False)
    findings = flight.assess(flown.results, may_fly=False, ending=flown.ending, sampling=flown.sampling)
    failures = findings.count(Verdict.FAIL)
    outside = 0
    for one in flown.results:
        assert one.outcome is not None
        values = {draw.parameter: draw.value for draw in one.outcome.draws}
        outside += any(abs(values[name]) <= _HOT * 0.9 for name in ("ERROR_RATE_X", "ERROR_RATE_Y"))
    rate, truth = findings.rate, (1.0 - _HOT) ** 2
    assert rate.interval is not None
    print(
        f"B2, uniform inter, adaptive: {failures} of {missions} missions fail, {failures / missions / truth:.1f} times "
        f"the rate of {truth:.0%} that two independent limits have (asked: 2); {outside / missions:.0%} lie outside "
        f"of what fails (asked: 25 %); the rate is stated as {rate.observed:.1%}, "
        f"{rate.interval[0]:.1%} to {rate.interval[1]:.1%}"
    )
    covers = rate.interval[0] <= truth <= rate.interval[1]
    return failures >= 2.0 * truth * missions and outside >= 0.25 * missions and covers


def at_sea(study: StudyFile, variants: dict[str, Variant], missions: int, store: RunStore) -> bool:
    """Row 31: one batch of the models with all three mistakes that were found at sea meets each of them.

    A failure is of the mistake that, put in alone, ends the mission of that seed at the same tick with the same code.
    """
    edits = (*variants["R1"].edits, *variants["R2"].edits)  # the edits of R1 contain that of R3
    flight = campaign(study, Variant("at-sea", "", edits, {}, missions), "uniform intra")
    failed = [one for one in flight.fly(1, store, keeps_failures=False).results if one.verdict is Verdict.FAIL]
    missing, met = ["R3", "R1", "R2"], []
    alone = {name: campaign(study, variants[name], "uniform intra") for name in missing}
    fly = {name: each.load(each.models.agent) for name, each in alone.items()}
    for one in failed:
        assert one.outcome is not None and one.outcome.abort is not None
        for name in missing:
            outcome = fly[name](one.seed)
            if outcome.abort is not None and (outcome.last_tick, outcome.abort.code) == (
                one.outcome.last_tick, one.outcome.abort.code,
            ):  # fmt: skip
                met.append(f"{name} in mission {one.number} at tick {outcome.last_tick}")
                missing.remove(name)
                break
        if not missing:
            break
    print(
        f"R1, R2 and R3 at once, uniform intra: {len(failed)} of {missions} missions fail; met: "
        f"{', '.join(met) or 'none'}; not met: {', '.join(missing) or 'none'}"
    )
    return not missing


def main(missions: int) -> int:
    """Fly all parts with so many missions a cell; 0 where all of it is found."""
    print("rows 28, 29, 30 and 33: five mistakes and three from sea, two distributions, two rhythms")
    options = ["--missions", str(missions), "--store", str(_STORE), "--output", str(_OUT)]
    code = run(["study", str(STUDY), *options])
    if code not in (0, 1):
        return code
    study, _ = read_study(STUDY)
    assert study is not None
    variants = {one.name: one for one in study.variants}
    short = ["28 to 30"] if code else []
    with open_store(_STORE) as store:
        for row, part in (("39", adaptive), ("31", at_sea)):
            print(f"\nrow {row}")
            if not part(study, variants, missions, store):
                short.append(row)
    if short:
        few = "" if missions >= study.missions else f" (with fewer than {study.missions} missions that may be chance)"
        print(f"\nfalls short of row {', '.join(short)}{few}")
    return int(bool(short))


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1])))
