"""What a story tells of tokens, draws and askers is what happened: faults of models that others wrote."""

from pathlib import Path

import pytest

from checker.batch.worker import fly_one
from checker.campaign import Campaign
from checker.influence import InfluenceLine
from checker.mission import read_mission
from checker.models import load_models
from checker.oracle import Verdict
from checker.pinned import pinned
from checker.steps import Step, StepKind
from runtime.executive.outcome import Draw, Event, EventKind
from tests.checker.fault_study import faults_in, laid_out

pytestmark = pytest.mark.once

UNSEEN = Path(__file__).parent / "unseen"


def steps_of(model: str, fault: int, folder: Path, mission_number: int = 1) -> tuple[Step, ...]:
    """The steps of the story of a mission of a model with one of its faults."""
    file = UNSEEN / model / "hand.toml"
    place = laid_out(UNSEEN / model, list(faults_in(UNSEEN / model, file))[fault - 1], folder / model)
    mission, _ = read_mission(place / "mission.toml")
    assert mission is not None
    models = load_models(mission)
    campaign = Campaign(mission, models, pinned(models))
    result = fly_one(campaign.load(models.agent), campaign.task(mission_number))
    assert result.verdict is Verdict.FAIL
    return campaign.story(result, None).steps


def published(steps: tuple[Step, ...], timelines: set[str]) -> list[tuple[int, str]]:
    subjects = [one.subject for one in steps if isinstance(one.subject, Event)]
    seen = [one for one in subjects if one.kind is EventKind.OBSERVATION and one.timeline in timelines]
    return [(one.tick, one.timeline) for one in seen]


@pytest.mark.parametrize(("fault", "tick"), [(5, 40), (9, 246)])
def test_the_token_is_told_that_the_conflict_speaks_of_with_who_asked_for_it(
    fault: int, tick: int, tmp_path: Path
) -> None:
    steps = steps_of("terminal", fault, tmp_path)
    assert published(steps, {"red", "blue"}) == [(tick, "red")]  # blue was loaded later, and had nothing to do with it
    asking = [one.subject for one in steps if one.kind is StepKind.ASKED]
    assert [one.rule for one in asking if isinstance(one, InfluenceLine)] == ["Job.Discharge"]  # and not Job.Deliver


def test_a_draw_that_nothing_had_read_yet_broke_no_plan(tmp_path: Path) -> None:
    draws = [one.subject[0] for one in steps_of("tunnel", 7, tmp_path) if isinstance(one.subject, tuple)]
    told = [(one.tick, one.value) for one in draws if isinstance(one, Draw)]
    assert told == [(40, 4.0), (140, 5.0)]  # the one of tick 60 is read at tick 62, after the repair of tick 61


def test_of_two_branches_that_an_argument_decides_the_one_is_told_that_the_token_took(tmp_path: Path) -> None:
    lines = [one.place.text for one in steps_of("hospital", 9, tmp_path) if one.kind is StepKind.LINE and one.place]
    assert "time == metres / pace;" in lines
    assert "time == metres / (pace * CAREFUL);" not in lines


def test_what_the_owner_of_a_token_says_is_not_told_as_missing(tmp_path: Path) -> None:
    chosen = [one for one in steps_of("bioreactor", 10, tmp_path) if one.kind is StepKind.CHOSEN]
    assert chosen == []  # the incubator says at what rate it grows


def test_rules_by_which_a_draw_acts_too_are_left_out_where_the_conflict_speaks_of_one(tmp_path: Path) -> None:
    steps = steps_of("fire", 3, tmp_path, mission_number=3)
    assert published(steps, {"truck", "two"}) == [(277, "truck")]
    places = [one.place.line for one in steps if one.kind in (StepKind.DRAW, StepKind.LINE) and one.place]
    assert places == [50, 51]  # of Truck.Charge, and not of Drone.Docked


def test_what_goes_on_is_told_from_its_beginning_and_not_what_python_published_last(tmp_path: Path) -> None:
    """The cart brings since tick 20 what the plan wanted long before 220, when an analyser of the same reactor ran."""
    steps = steps_of("wetlab", 6, tmp_path, 2)
    told = [one.subject for one in steps if isinstance(one.subject, Event)]
    assert [(one.tick, one.timeline, one.predicate) for one in told][-2:] == [
        (19, "cart", "Bring"),  # asked for
        (20, "cart", "Bring"),
    ]
