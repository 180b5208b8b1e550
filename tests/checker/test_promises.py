"""A violated property is told with what became of the requests for what it promises."""

import shutil
from pathlib import Path

import pytest

from checker.single_values import single_value
from checker.told_events import promised_events
from nddlc.main import run
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
