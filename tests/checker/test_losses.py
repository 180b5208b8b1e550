"""What missions lose on the way is in every report, and a limit on it fails a mission."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from checker.batch.result import MissionResult
from checker.excerpts import Excerpts
from checker.limits import Limit
from checker.losses import GoalFate, amount, losses_of
from checker.report.losses import goal_text, unmet_text
from checker.tally import GoalTally, UnmetTally
from nddlc.main import run
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.outcome import Event, EventKind, Outcome, Phase, Reason, ReasonKind, SourcePlace
from runtime.executive.rendering import reason_text
from runtime.plan.readout.names import TokenName

pytestmark = pytest.mark.once

GPS = Path("models/gps").resolve()
EXTRA = """
[[goal]]
timeline = "nav"
predicate = "Transit"
start = [5, 60]
[goal.parameters]
distance = 200.0

[[goal]]
timeline = "nav"
predicate = "Transit"
at = 400
start = [100, 200]
"""


def event(kind: EventKind, tick: int, request: int | None = None, **more: object) -> Event:
    return Event(tick, Phase.OBSERVE, kind, request=request, **more)  # type: ignore[arg-type]


def outcome(*events: Event) -> Outcome:
    return Outcome(1, 90, 90, None, (), events, ())


def test_every_fate_of_goals_and_requests_is_read_from_the_trace() -> None:
    late, full = Reason(ReasonKind.TOO_LATE), Reason(ReasonKind.REJECTED)
    found = losses_of(
        outcome(
            *(event(EventKind.REQUEST, 0, number, timeline="nav") for number in (-1, -2, -3, -4, -6, -7, -8)),
            event(EventKind.REQUEST, 1, 5, reactor="a", timeline="gps", predicate="On"),
            event(EventKind.REQUEST, 1, 6, reactor="a", timeline="gps", predicate="On"),
            event(EventKind.REQUEST, 1, 7, reactor="a", timeline="helm", predicate="Go"),
            event(EventKind.REQUEST, 1, 8, reactor="a", timeline="helm", predicate="Go"),
            event(EventKind.REQUEST, 1, 9, reactor="a", timeline="helm", predicate="Go"),
            event(EventKind.RECALL, 2, 8),
            event(EventKind.RECALL, 2, -7),
            event(EventKind.RECALL, 2, -8),
            event(EventKind.REJECT, 3, -2, reason=full),
            event(EventKind.REJECT, 3, -3, reason=full),
            event(EventKind.RELAX, 3, reactor="a", reason=Reason(ReasonKind.NO_PLAN)),
            event(EventKind.RELAX, 4, reactor="a", reason=Reason(ReasonKind.NO_PLAN)),
            event(EventKind.REFUSE, 5, 5, reason=Reason(ReasonKind.NO_OWNER)),
            event(EventKind.REJECT, 5, 6, reason=full),
            event(EventKind.ACHIEVED, 6, -1),
            event(EventKind.ACHIEVED, 6, -3),
            event(EventKind.ACHIEVED, 6, -8),  # it had begun
            event(EventKind.REFUSE, 7, -4, reason=late),
            event(EventKind.OBSERVATION, 7, reactor="b", timeline="helm", predicate="Failed"),
            event(EventKind.ACHIEVED, 7, 9),
            event(EventKind.KILL, 8, reactor="b"),
            event(EventKind.OBSERVATION, 8, reactor="b", timeline="helm", predicate="Failed"),
            event(EventKind.OBSERVATION, 8, reactor="b", timeline="nav", predicate="Failed"),
        )
    )
    assert {one.number: (one.fate, one.tick) for one in found.goals} == {
        0: (GoalFate.ACHIEVED, 6),
        1: (GoalFate.REJECTED, 3),
        2: (GoalFate.ACHIEVED, 6),
        3: (GoalFate.LATE, 7),
        5: (GoalFate.REJECTED, 8),
        6: (GoalFate.RECALLED, 2),
        7: (GoalFate.ACHIEVED, 6),
    }
    assert (found.repaired, found.requests, found.lost, found.dropped) == (2, 5, 2, 1)
    assert [(one.timeline, one.kind) for one in found.undelivered] == [
        ("gps", ReasonKind.NO_OWNER),
        ("helm", ReasonKind.NO_OWNER),
    ]
    assert [amount(found, limit) for limit in Limit] == [3, 1, 2, 2]


@pytest.fixture
def mission(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The mission of models/gps with a goal too many and one that comes too late; every mission comes to its end."""
    for path in GPS.glob("*.nddl"):
        (tmp_path / path.name).write_text(path.read_text().replace("SURFACE_MAX = 64;", "SURFACE_MAX = 90;"))
    (tmp_path / "mission.toml").write_text((GPS / "mission.toml").read_text().replace("[check]", EXTRA + "[check]"))
    monkeypatch.chdir(tmp_path)
    return tmp_path / "mission.toml"


def test_a_check_that_holds_says_what_was_lost(mission: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "mission.toml", "--flights", "0", "--missions", "10"]) == 0
    text = capsys.readouterr().out
    assert "HOLDS" in text
    assert "cost: 10 goals rejected, 10 goals late, 10 repairs of plans" in text
    assert "10 missions passed after repairs, which may set aside what a rule says" in text
    assert "goals: 20 achieved, 10 late, 10 rejected, 0 open (4 goals a mission, all of them optional)" in text
    assert "given up: Transit on `nav` (optional), mission.toml:51, in 10 missions: 10 × too late; first in 1" in text
    data = json.loads(Path("nddlc-report/report.json").read_text())
    assert data["losses"]["goals"] == {"achieved": 20, "late": 10, "rejected": 10, "open": 0}
    assert data["losses"]["optional_goals"] == 4
    first = data["missions"][0]["losses"]
    assert [(one["goal"], one["fate"], one["line"]) for one in first["rejected"]] == [
        (3, "rejected", 44),
        (4, "late", 51),
    ]
    page = Path("nddlc-report/report.html").read_text()
    assert "10 goals rejected, 10 goals late" in page
    assert "mission.toml:51" in page
    assert "10 missions passed after repairs" in page


def test_a_limit_on_losses_fails_the_missions_without_flying_again(
    mission: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def flown_beside(*given: object) -> MissionResult:
        raise AssertionError("without flights for causes nothing is flown beside the missions")

    monkeypatch.setattr("checker.campaign.Flyer.fly", flown_beside)
    assert run(["check", "mission.toml", "--flights", "0", "--missions", "10"]) == 0
    mission.write_text(mission.read_text().replace("[check]", "[check]\nmax_repairs = 3\nmax_rejected = 1"))
    capsys.readouterr()
    assert run(["check", "mission.toml", "--flights", "0", "--missions", "10"]) == 1
    text = capsys.readouterr().out
    assert "gps: 10 missions, 10 failed" in text
    assert "L1 more goals were given up than [check] allows: 10 missions (100 %)" in text
    assert "2 goals were given up, and `max_rejected` is 1" in text
    assert run(["explain", "latest#4", "--flights", "0"]) == 0
    story = capsys.readouterr().out
    assert "too late" in story
    assert "the planner found no place for it" in story
    mission.write_text(mission.read_text().replace("max_rejected = 1", "max_rejected = 2"))
    assert run(["check", "mission.toml", "--flights", "0", "--missions", "10"]) == 0
    mission.write_text(mission.read_text().replace("max_rejected = 2", "max_rejected = -1"))
    assert run(["check", "mission.toml", "--flights", "0", "--missions", "10"]) == 2
    assert "`max_rejected` must be at least 0, not -1" in capsys.readouterr().out


def test_too_many_repairs_are_blamed_on_the_line_that_was_repaired(
    mission: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    mission.write_text(mission.read_text().replace(EXTRA, ""))
    psim = mission.parent / "navigator.nddl"
    psim.write_text(psim.read_text().replace("SURFACE_MAX = 90;", "SURFACE_MAX = 64;"))
    mission.write_text(mission.read_text().replace("[check]", "[check]\nmax_repairs = 0"))
    assert run(["check", "mission.toml", "--flights", "4", "--missions", "20"]) == 1
    data = json.loads(Path("nddlc-report/report.json").read_text())
    repaired = [one for one in data["missions"] if one["losses"]["repairs"]]
    assert repaired
    assert all(one["verdict"] == "FAIL" for one in repaired)
    assert data["losses"]["by_repair"][0]["place"]["text"] == data["faults"][0]["place"]["text"]


def test_reasons_that_differ_in_ticks_and_numbers_of_tokens_are_one_sort() -> None:
    at = [Reason(ReasonKind.DID_NOT_START, TokenName("Drone.Follow", n), tick=900 + n) for n in (3, 8, 8, 5)]
    other = replace(at[0], token=TokenName("Drone.Hover", 3))
    goal = GoalTally(
        GoalConfiguration("task", "Refill"),
        SourcePlace("mission.toml", 7, 1, ""),
        ((GoalFate.REJECTED, 9), (GoalFate.LATE, 0)),
        ((at[0], 4), (other, 3), (at[1], 1), (at[3], 1)),
        2,
    )
    text = goal_text(goal, Excerpts(Path()))
    assert f"9 missions: 6 × {reason_text(at[0])} (and the like), 3 × {reason_text(other)}; first in 2" in text


def test_what_happened_once_is_told_as_once() -> None:
    assert ", 1 time in 1 mission: " in unmet_text(UnmetTally("pilot", "comms", "Report", None, 1, 1, 3))
