"""A violated property is told with what became of the requests for what it promises."""

import shutil
from pathlib import Path

import pytest

from checker.buckets import group_failures
from checker.findings import Fault
from checker.single_values import single_value
from checker.told_events import promised_events
from nddlc.main import run
from runtime.executive.outcome import Event, EventKind
from tests.checker.fault_study import faults_in, laid_out
from tests.checker.told_steps import failed_mission

pytestmark = pytest.mark.once

LOOKOUT = Path(__file__).parents[2] / "models/templates/lookout"
DEPOT = Path(__file__).parent / "unseen" / "depot"
LATE = 12  # a mission in which a driver leaves too late, and others in time


def test_the_story_of_a_property_tells_what_was_asked_for_and_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for each in ("ship.nddl", "mission.toml", "lookout.py"):
        shutil.copy(LOOKOUT / each, tmp_path)
    monkeypatch.chdir(tmp_path)
    code = Path("lookout.py").read_text(encoding="utf-8")
    Path("lookout.py").write_text(code.replace('"Slow", start', '"Slow", knots=3, start'), encoding="utf-8")
    assert run(["check", "--missions", "2", "--workers", "1", "--flights", "0", "--trust"]) == 1
    capsys.readouterr()
    assert run(["explain", "latest", "--flights", "0", "--trust"]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if " tick " in f" {line}"]
    seen, asked, refused = (
        next(at for at, line in enumerate(lines) if words in line)
        for words in ("publishes whales = Seen", "requests Slow(knots=3) on ship", "refuse Slow(knots=3)")
    )
    assert seen < asked < refused
    assert "there is no parameter `knots` (there is none)" in lines[refused]


def test_requests_that_could_not_keep_the_promise_any_more_are_not_told_in_place_of_the_refusal(tmp_path: Path) -> None:
    place = laid_out(DEPOT, next(faults_in(DEPOT)), tmp_path / "depot")
    given, result = failed_mission(place, LATE)
    assert result.outcome is not None
    told = promised_events(result, result.outcome, given.models.agent)
    numbers = [single_value(dict(one.arguments)["tram"]) for one in told]
    assert [(one.tick, str(one.kind)) for one in told] == [
        (302, "observation"),
        (334, "request"),
        (334, "reject"),
        (335, "recall"),
        (366, "request"),
    ]
    assert set(numbers) == {2}


@pytest.mark.parametrize(
    ("model", "fault", "told"),
    [
        (
            "dam",
            6,
            [(0, "", "Passage", "fish"), (265, "dispatcher", "Open", "ladder")],
        ),  # and not the goal of the sluice
        (
            "wetlab",
            7,
            [
                (49, "ward", "Urgent", "stat"),
                (67, "scheduler", "Run", "slow_one"),
                (99, "scheduler", "Run", "slow_one"),
            ],
        ),
    ],
)
def test_what_leads_to_what_is_promised_is_told(
    model: str, fault: int, told: list[tuple[int, str, str, str]], tmp_path: Path
) -> None:
    unseen = Path(__file__).parent / "unseen" / model
    place = laid_out(unseen, list(faults_in(unseen))[fault - 1], tmp_path / model)
    given, failed = failed_mission(place, 1)
    (bucket,) = group_failures((failed,))
    steps = given.story(failed, Fault(bucket, None, None)).steps
    asked = [one.subject for one in steps if isinstance(one.subject, Event)]
    found = [(one.tick, one.reactor, one.predicate, one.timeline) for one in asked if one.kind is EventKind.REQUEST]
    assert found == told
    lines = [one.place.text for one in steps if one.place is not None]
    assert lines == (["start = [265, 300]"] if model == "dam" else [])
