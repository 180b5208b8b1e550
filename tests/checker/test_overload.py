"""A token that alone overloads a resource, and missions that lose more than they may: candidates, stories, traces."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from checker.batch.result import MissionResult
from checker.batch.worker import Task, fly_one
from checker.causes import failed_by
from checker.counterfactual.candidates import candidates_of
from checker.counterfactual.damage import is_farther
from checker.counterfactual.dependence import Dependence
from checker.counterfactual.search import is_late, sites_in
from checker.explain import result_text
from checker.limits import Limit
from checker.losses import Exceeded, GoalEnd, GoalFate, Losses, Repairs
from checker.mission import read_mission
from checker.models import ModelSet, load_models
from checker.oracle import Verdict
from checker.pinned import pinned
from checker.proofs.places import text_of
from checker.rendering import beside, step_text
from checker.steps import StepKind
from checker.story import tell
from runtime.executive.outcome import ReasonKind, SourcePlace
from runtime.plan.readout.open_levels import LevelUser, OpenLevel
from runtime.solver.learning.attempts import Flaw
from runtime.solver.learning.rendering import flaw_words
from runtime.solver.tags import RESOURCE_THREAT

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
class Oven extends AgentTimeline {
  predicate Empty { }
  predicate Bake { }
  predicate Clean { }
  Oven(Mode m) { super(m, "Empty"); }
}
Reusable bus = new Reusable(100.0, 0.0);
Reservoir tank = new Reservoir(50.0, 0.0, 60.0);
Oven::Bake {
  duration == 20;
  any(Reusable.uses power);
  power.start == start;
  power.end == end;
  power.quantity == 140.0;
}
Oven::Clean {
  duration == 5;
  any(Reservoir.consume water);
  water.time == end;
  water.quantity == 10.0;
}
Oven oven = new Oven(Internal);
close();
"""
MISSION = """[mission]
name = "oven"
final_tick = 100
[[reactor]]
name = "cook"
model = "oven.nddl"
solver = "cook.toml"
latency = 1
lookahead = 100
internal = ["oven"]
[[goal]]
timeline = "oven"
predicate = "Bake"
mandatory = true
"""

MANAGERS = ("ResourceThreatManager", "ThreatManager", "OpenConditionManager", "UnboundVariableManager")


def loaded(folder: Path, mission_text: str, model: str = MODEL) -> ModelSet:
    """The models of a mission, written into a folder."""
    (folder / "oven.nddl").write_text(model, encoding="utf-8")
    managers = "".join(f'[[manager]]\ncomponent = "{name}"\n' for name in MANAGERS)
    (folder / "cook.toml").write_text(managers, encoding="utf-8")
    (folder / "mission.toml").write_text(mission_text, encoding="utf-8")
    mission, _ = read_mission(folder / "mission.toml")
    assert mission is not None
    return load_models(mission)


@pytest.fixture(scope="module")
def flown(tmp_path_factory: pytest.TempPathFactory) -> tuple[ModelSet, MissionResult]:
    models = loaded(tmp_path_factory.mktemp("oven"), MISSION)
    return models, fly_one(pinned(models)(models.agent), Task(1, 1), keep_trace=True)


def test_lines_that_overload_a_resource_alone_are_candidates(flown: tuple[ModelSet, MissionResult]) -> None:
    models, result = flown
    assert result.outcome is not None
    assert failed_by(result.outcome).conflict is None  # nothing was tried against it, so no conflict names a line
    sites = sites_in(models.agent)
    graph = Dependence([models.programs[each.model] for each in models.agent.reactors], sites)
    found = candidates_of(result.outcome, graph, Path(models.agent.root))
    near = [one.site.text for one in found if one.far <= 0.5]
    assert near[:1] == ["any(Reusable.uses power);"]
    assert {"power.quantity == 140.0;", "Reusable bus = new Reusable(100.0, 0.0);"} <= set(near)
    assert "water.quantity == 10.0;" not in near


def test_the_story_tells_which_resource_leaves_no_choice(flown: tuple[ModelSet, MissionResult]) -> None:
    models, result = flown
    story = tell(result, models.agent, models.influence, None, text_of(models.agent, models.programs))
    told = [step_text(step, story) for step in story.steps]
    assert any(one.startswith("`bus` might be used too much at ") for one in told)


def test_the_story_tells_who_uses_how_much_of_a_resource_and_by_which_lines(tmp_path: Path) -> None:
    named = MODEL.replace(
        "Reusable bus = new Reusable(100.0,", "float BUS;\nBUS = 100.0;\nReusable bus = new Reusable(BUS,"
    )
    named = named.replace("Reusable bus", "float RING = 70.0;\nReusable bus").replace("== 140.0;", "== 2.0 * RING;")
    models = loaded(tmp_path, MISSION, named)
    result = fly_one(pinned(models)(models.agent), Task(1, 1), keep_trace=True)
    story = tell(result, models.agent, models.influence, None, text_of(models.agent, models.programs))
    told = [(step_text(step, story), step) for step in story.steps if step.kind in (StepKind.LEVEL, StepKind.TRIED)]
    (user, use), (over, flaw) = told[-2:]
    assert user == "Oven.Bake#1 may take up to 140 of `bus`"
    assert re.fullmatch(
        r"`bus` might be used too much at \d+, 140 of 100 available: Oven.Bake#1 140; there is nothing to choose", over
    )
    assert [place.text for place in (use.place, *use.limits) if place is not None] == [
        "power.quantity == 2.0 * RING;",
        "float RING = 70.0;",
    ]
    assert [place.text for place in (flaw.place, *flaw.limits) if place is not None] == [
        "Reusable bus = new Reusable(BUS, 0.0);",
        "BUS = 100.0;",
    ]
    assert [said for said, *_ in beside(use)] == ["with the number of"]
    assert [said for said, *_ in beside(flaw)] == ["where the limit is set"]


@pytest.mark.parametrize(
    ("is_low", "is_lent", "words"),
    [
        (True, True, "`sand` might be used too much at 12, 8 of 6 available: Survey#3 8"),
        (True, False, "the level of `sand` might fall to -2 at 12, its least is 0: Survey#3 8"),
        (False, False, "the level of `sand` might rise to -2 at 12, its greatest is 0: Survey#3 8"),
    ],
)
def test_a_level_that_may_get_past_its_limit_is_told_with_how_far_and_by_whom(
    is_low: bool, is_lent: bool, words: str
) -> None:
    level = OpenLevel("sand", 12, is_low, 0.0, -2.0, 6.0, is_lent)
    users = (LevelUser("sand", "Survey#3", "Flight.Survey", "Reservoir.consume", 8.0, is_low),)
    assert flaw_words(Flaw(RESOURCE_THREAT, "sand", at=12, level=level, users=users)) == words
    assert flaw_words(Flaw(RESOURCE_THREAT, "sand", at=12)) == "`sand` might be used too much at 12"


def test_the_trace_of_a_mission_that_fails_by_a_limit_is_kept(tmp_path: Path) -> None:
    models = loaded(tmp_path, MISSION.replace("mandatory = true\n", ""))
    fly = pinned(models)(models.agent)
    for most, is_kept in ((1, False), (0, True)):
        result = fly_one(fly, Task(1, 1, limits=((Limit.REJECTED, most),)))
        assert result.verdict is Verdict.PASS  # the limits of [check] are applied to what is stored
        assert result.outcome is not None
        assert (result.has_trace, bool(result.outcome.events)) == (is_kept, is_kept)


def test_a_mission_that_passed_after_repairs_has_these_to_explain(flown: tuple[ModelSet, MissionResult]) -> None:
    _, result = flown
    assert "nothing to explain" in result_text(result, "r")
    place = SourcePlace("oven.nddl", 10, 3, "duration == 20;")
    repairs = Repairs("cook", ReasonKind.GOES_ON, place, 2, 7)
    told = result_text(replace(result, losses=Losses(repairs=(repairs,))), "r")
    assert "; after 2 repairs of plans\n" in told
    why = "a token went on longer than planned, by oven.nddl:10 `duration == 20;`"
    assert f"  repaired: cook 2 times, first at tick 7: {why}\n" in told


def test_a_mission_that_loses_more_than_it_may_is_late(flown: tuple[ModelSet, MissionResult]) -> None:
    _, result = flown
    assert result.outcome is not None
    ended = replace(result, outcome=replace(result.outcome, open_goals=()))
    assert not is_late(ended)
    repaired = replace(ended, judgement=replace(ended.judgement, exceeded=Exceeded(Limit.REPAIRS, 2, 0)))
    assert is_late(repaired)


def test_a_mission_that_gives_a_goal_up_has_come_no_farther(flown: tuple[ModelSet, MissionResult]) -> None:
    _, result = flown
    assert result.outcome is not None
    rejected, waiting = (
        replace(result, losses=Losses((GoalEnd(0, fate, 3),))) for fate in (GoalFate.REJECTED, GoalFate.OPEN)
    )
    failed = replace(
        waiting,
        outcome=replace(result.outcome, last_tick=50),
        judgement=replace(result.judgement, code="F1"),
    )
    assert is_farther(waiting, failed)
    assert not is_farther(rejected, failed)
    assert is_farther(rejected, replace(failed, losses=rejected.losses))
