"""Faults are put into the GPS mission, and the line is found among its causes; every claim has been flown."""

import math
import shutil
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest

from checker.batch.process import Flyer
from checker.batch.result import MissionResult
from checker.batch.worker import Task
from checker.counterfactual.candidates import candidates_of
from checker.counterfactual.damage import damage_of
from checker.counterfactual.dependence import Dependence
from checker.counterfactual.effort import Bounds
from checker.counterfactual.missions import Missions
from checker.counterfactual.ranking import Causes, Claim, rank
from checker.counterfactual.rendering import causes_data, claim_text, effort_text
from checker.counterfactual.search import Suspended, find_causes, sites_in
from checker.counterfactual.tried import TrialsEnd
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.variant import load_over
from checker.oracle import Verdict
from checker.pinned import pinned
from checker.sampling.seeds import mission_seed

pytestmark = pytest.mark.once

GPS = Path("models/gps").resolve()
MISSIONS = 3


@pytest.fixture(scope="module")
def flyer() -> Iterator[Flyer]:
    """One process for all trials."""
    mission, _ = read_mission(GPS / "mission.toml")
    assert mission is not None
    models = load_models(mission)
    with Flyer(pinned(models), models.agent, 60.0) as one:
        yield one


class Faulty:
    """The GPS mission with one text changed, and its missions that fail."""

    def __init__(self, folder: Path, flyer: Flyer, old: str, new: str) -> None:
        shutil.copytree(GPS, folder, dirs_exist_ok=True)
        (file,) = (
            one for one in folder.glob("*.nddl") if old in one.read_text() and one.name != "navigator_mended.nddl"
        )
        self.name = file.name
        self.line = file.read_text().partition(old)[0].count("\n") + 1
        file.write_text(file.read_text().replace(old, new))
        mission, _ = read_mission(folder / "mission.toml")
        assert mission is not None
        models = load_models(mission)
        assert not models.has_errors
        programs = [models.programs[each.model] for each in models.agent.reactors]
        self.world = Suspended(models.agent, programs, (), flyer)
        results = [self.fly(number, mission_seed(mission.check.seed, number)) for number in range(1, MISSIONS + 1)]
        self.failed = [one for one in results if one.verdict is Verdict.FAIL]
        self.missions = Missions(self.failed, [one for one in results if one.verdict is Verdict.PASS])
        assert self.failed

    def fly(self, number: int, seed: int) -> MissionResult:
        return self.world.flyer.fly(self.world.agent, number, seed, partial(load_over, ()))

    def causes(self, bounds: Bounds | None = None) -> Causes:
        return rank(find_causes(self.missions, self.world, bounds or Bounds()), Path(self.world.agent.root))

    def rank_in(self, causes: Causes) -> int:
        at = (self.name, self.line)
        return next((k for k, one in enumerate(causes.ranked, 1) if (one.place.file, one.place.line) == at), 0)


@pytest.mark.parametrize(
    ("old", "new", "most"),
    [
        ("SURFACE_MAX = 64", "SURFACE_MAX = 30", 1),  # a constant of the reactor that gives up
        ("FIX_HITS = 10", "FIX_HITS = 40", 3),  # one that is asked for, published, observed and only then too late
        ("duration <= SURFACE_MAX", "duration <= FIX_HITS", 1),
        ("duration == ASCENT", "duration == CRUISE", 1),  # in the simulator
        ("met_by(Inactive p)", "ends(Inactive p)", 1),
        ("CRUISE + current", "current - CRUISE", 3),
    ],
)
def test_the_changed_line_is_found(tmp_path: Path, flyer: Flyer, old: str, new: str, most: int) -> None:
    faulty = Faulty(tmp_path, flyer, old, new)
    causes = faulty.causes()
    assert 1 <= faulty.rank_in(causes) <= most, [(one.place, one.claim) for one in causes.ranked]
    assert causes.flights <= 40
    first = causes.ranked[0]
    assert first.claim is Claim.MENDS
    assert first.helped == first.missions == len(faulty.failed)


def test_of_a_line_that_is_gone_the_rule_is_named_by_what_it_leaves_loose(tmp_path: Path, flyer: Flyer) -> None:
    faulty = Faulty(tmp_path, flyer, "    ticks == ceil(span);\n", "\n")
    causes = faulty.causes()
    first = causes.ranked[0]
    assert (first.claim, first.rule) == (Claim.LOOSE_END, "Helm.Run")
    assert first.variable in ("span", "ticks")
    assert claim_text(first).startswith("perhaps a line is missing: ")


def test_a_claim_passes_its_trial_when_it_is_flown_again(tmp_path: Path, flyer: Flyer) -> None:
    faulty = Faulty(tmp_path, flyer, "SURFACE_MAX = 64", "SURFACE_MAX = 30")
    trials = find_causes(faulty.missions, faulty.world, Bounds())
    for one in trials.causes[:4]:
        text = Path(one.edit.file).read_text()
        Path(one.edit.file).write_text(text[: one.edit.begin] + one.edit.new + text[one.edit.end :])
        again = faulty.fly(faulty.failed[0].number, faulty.failed[0].seed)
        Path(one.edit.file).write_text(text)
        assert again.verdict is Verdict.PASS
        assert damage_of(again) <= one.damage


def test_a_trial_that_passes_tells_what_happened(tmp_path: Path, flyer: Flyer, monkeypatch: pytest.MonkeyPatch) -> None:
    flown: list[MissionResult] = []
    fly = flyer.fly_task

    def recorded(task: Task, most_seconds: float = math.inf) -> MissionResult:
        flown.append(fly(task, most_seconds))
        return flown[-1]

    faulty = Faulty(tmp_path, flyer, "SURFACE_MAX = 64", "SURFACE_MAX = 30")
    monkeypatch.setattr(flyer, "fly_task", recorded)
    find_causes(faulty.missions, faulty.world, Bounds(flights=2))
    passed = [one for one in flown if one.verdict is Verdict.PASS]
    assert passed
    assert all(one.outcome is not None and one.outcome.events for one in passed)  # what takes no time is seen there


def test_trials_keep_to_their_bounds_and_can_be_ended(tmp_path: Path, flyer: Flyer) -> None:
    faulty = Faulty(tmp_path, flyer, "SURFACE_MAX = 64", "SURFACE_MAX = 30")
    few = faulty.causes(Bounds(flights=5))
    assert (few.flights, few.ended) == (5, TrialsEnd.FLIGHTS)
    assert effort_text(few).endswith("no more are made")
    assert faulty.causes(Bounds(seconds=0.0)).ended is TrialsEnd.SECONDS
    cancelled = faulty.causes(Bounds(is_cancelled=lambda: True))
    assert (cancelled.flights, cancelled.ended) == (0, TrialsEnd.CANCELLED)
    assert causes_data(cancelled)["ended"] == "cancelled"


def test_equal_failures_have_equal_causes(tmp_path: Path, flyer: Flyer) -> None:
    faulty = Faulty(tmp_path, flyer, "SURFACE_MAX = 64", "SURFACE_MAX = 30")
    assert faulty.causes() == faulty.causes()


def test_an_observed_argument_leads_into_the_reactor_that_asked_for_it(tmp_path: Path, flyer: Flyer) -> None:
    faulty = Faulty(tmp_path, flyer, "FIX_HITS = 10", "FIX_HITS = 40")
    sites = sites_in(faulty.world.agent)
    graph = Dependence(faulty.world.programs, sites)
    outcome = faulty.failed[0].outcome
    assert outcome is not None
    far = {one.site.text: one.far for one in candidates_of(outcome, graph, Path(faulty.world.agent.root))}
    way = ["fix.minHits == minHits;", "fix.minHits == FIX_HITS;", "FIX_HITS = 40;"]
    assert [far[text] for text in way] == sorted(far[text] for text in way)


def test_a_pass_that_loses_goals_is_no_mending(tmp_path: Path, flyer: Flyer) -> None:
    faulty = Faulty(tmp_path, flyer, "    run.distance == distance;\n", "\n")
    causes = faulty.causes()
    evading = [one for one in causes.ranked if one.claim is Claim.EVADES]
    assert evading
    assert "do less" in claim_text(evading[0]) or "does less" in claim_text(evading[0])
    assert causes.ranked[0].claim is not Claim.EVADES
