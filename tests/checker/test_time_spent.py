"""What is too late by the clock: the mistake is the likelier in what took most of the time, however long ago."""

import math
from pathlib import Path

import pytest

from checker.buckets import group_failures
from checker.counterfactual.candidates import candidates_of
from checker.counterfactual.dependence import Dependence
from checker.counterfactual.search import sites_in
from checker.counterfactual.time_spent import LongPart, limited_token, time_inside, time_spent
from checker.findings import Fault
from checker.rendering import beside
from checker.steps import Step, StepKind
from runtime.executive.outcome import Outcome
from tests.checker.checked import faults_of
from tests.checker.fault_study import faults_in, laid_out
from tests.checker.told_steps import failed_mission

pytestmark = pytest.mark.once

FAB = Path(__file__).parent / "unseen" / "fab"
BALLOON = FAB.parent / "balloon"
VENTING, QUEUE_MAX = 3, 6  # 120 for 12; 160 for 300
BALLAST = 3  # sand for as many frames as for metres


def flown(number: int, folder: Path) -> Outcome:
    place = laid_out(FAB, list(faults_in(FAB))[number], folder / "fab")
    _, result = failed_mission(place, 1)
    assert result.outcome is not None
    return result.outcome


def test_what_is_done_before_a_deadline_has_its_share_of_the_time(tmp_path: Path) -> None:
    outcome = flown(VENTING, tmp_path)
    shares = time_spent(outcome)
    assert max(shares.keys() - {"Wafer"}, key=shares.__getitem__) == "Vent"
    assert shares["Vent"] == pytest.approx(360 / outcome.last_tick)  # three wafers
    assert "Vacuum" not in shares  # nobody asked for it


def test_a_limit_on_a_duration_asks_nothing_of_what_was_before(tmp_path: Path) -> None:
    outcome = flown(QUEUE_MAX, tmp_path)
    assert outcome.abort is not None
    assert time_spent(outcome) == {}


def test_a_limit_on_a_duration_asks_what_was_done_since_the_token_began(tmp_path: Path) -> None:
    outcome = flown(QUEUE_MAX, tmp_path)
    assert limited_token(outcome) == "Flow.Wafer"
    shares = time_inside(outcome)
    assert max(shares.keys() - {"Wafer"}, key=shares.__getitem__) == "Process"
    assert shares["Process"] == pytest.approx(71 / 160)
    assert shares["Vent"] == pytest.approx(12 / 160)  # of two before it began, 24 more


def test_what_a_part_of_a_limited_token_took_leads_to_the_line_that_asked_for_so_much(tmp_path: Path) -> None:
    place = laid_out(BALLOON, list(faults_in(BALLOON))[BALLAST], tmp_path / "balloon")
    campaign, result = failed_mission(place, 1)
    assert result.outcome is not None
    models = campaign.models
    graph = Dependence(list(models.programs.values()), sites_in(models.agent))
    assert {"Climbs", "Shoots", "Sends"} <= graph.children("Flight.Survey")
    assert "Braced" not in graph.children("Flight.Survey")
    steps = {graph.sites[number].text: step for number, step in graph.lengthening("Climbs")}
    assert steps["duration == ceil(time);"] < steps["rate == lift * ballast;"]
    assert steps["climb.ballast == sand_for(frames);"] == steps["rate == lift * ballast;"] + 1
    found = candidates_of(result.outcome, graph, place, models.agent.properties, coded=models.agent.coded)
    far = {one.site.text: one.far for one in found}
    share = time_inside(result.outcome)["Climbs"]
    assert far["duration == ceil(time);"] == pytest.approx(-math.log(share))
    assert far["duration == ceil(time);"] < far["rate == lift * ballast;"] < far["film != none;"]
    assert far["climb.ballast == sand_for(frames);"] < -math.log(share) + 1.0

    (bucket,) = group_failures((result,))
    told = campaign.story(result, Fault(bucket, None, None)).steps
    (climb, shoot) = (number for number, step in enumerate(told) if step.kind is StepKind.PART)
    assert told[shoot + 1].kind is StepKind.FAULT
    assert element_of(told[climb]) == (200, "Climbs", 63, "Flight.Survey", 200, 150)
    assert texts_of(told[climb]) == [
        "duration == ceil(time);",
        "mulEq(rate, time, metres);",
        "rate == lift * ballast;",
    ]
    assert texts_of(told[shoot]) == ["duration == ceil(frames * each * dusk);"]  # its films differ, so do their times
    asked = [place.text for said, place, _ in beside(told[climb]) if said == "as asked for by"]
    assert asked == ["climb.metres == metres;", "climb.ballast == sand_for(frames);"]  # not what it hands on


def element_of(step: Step) -> tuple[object, ...]:
    part = step.subject
    assert isinstance(part, LongPart)
    return step.tick, part.predicate, part.ticks, part.whole, part.begun, part.total


def texts_of(step: Step) -> list[str]:
    return [place.text for place in (step.place, *step.limits) if place is not None]


def test_the_line_that_made_a_deadline_late_hours_ago_is_the_first_cause(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fault = list(faults_in(FAB))[VENTING]
    files = {path.name: path.read_text() for path in FAB.glob("*.*") if path.name != "hand.toml"} | fault.texts
    files["mission.toml"] = files["mission.toml"].replace("missions = 30", "missions = 3")
    (found,) = faults_of(tmp_path, capsys, files)
    assert found["causes"]["ranked"][0]["text"] == "int VENTING = 120;"
