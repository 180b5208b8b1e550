"""`nddlc check` and `nddlc explain` from the user's side, with a stand-in for the agent."""

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from checker.batch.result import read_record, write_record
from checker.batch.store import open_store
from checker.batch.worker import Load
from checker.counterfactual.ranking import Causes
from checker.faults import faults_of
from nddlc.inputs import STORE
from nddlc.main import run
from tests.checker.fake_agent import load_broken, load_split, load_troubled

pytestmark = pytest.mark.once

GPS = Path("models/gps").resolve()


@pytest.fixture
def agent(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Put the stand-in where the agent is plugged in, and work in an empty folder."""
    monkeypatch.chdir(tmp_path)
    plug(monkeypatch, load_split)


def plug(monkeypatch: pytest.MonkeyPatch, load: Load) -> None:
    monkeypatch.setattr("nddlc.check.pinned", lambda models: load)
    monkeypatch.setattr("nddlc.explanation.pinned", lambda models: load)


def test_a_failing_model_ends_with_findings_and_a_reason(agent: None, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check", str(GPS / "mission.toml")]) == 1
    text = capsys.readouterr().out
    assert "gps: 200 missions, 10 failed" in text
    assert "34 |     duration <= SURFACE_MAX;" in text
    assert "5 | SURFACE_MAX = 64;" in text
    assert "fails when GPS_HIT_RATE > 3.8" in text
    assert len(text.splitlines()) <= 25
    assert sorted(path.name for path in Path("nddlc-report").iterdir()) == [
        "junit.xml",
        "report.html",
        "report.json",
        "report.md",
        "report.sarif",
    ]
    found = re.search(r"nddlc explain (\w+#\d+)", text)
    assert found is not None
    assert run(["explain", found[1]]) == 0
    story = capsys.readouterr().out
    order = ["sampledParameter(GPS_HIT_RATE)", "gpsHitRate * minHits", "SURFACE_MAX;   ", "gives up after 2 repairs"]
    happened = story.partition("what happened:")[2]
    places = [happened.find(words.strip()) for words in order]
    assert -1 not in places
    assert places == sorted(places)
    assert "<== where it breaks" in story
    assert run(["explain", "latest", "--format", "json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["condition"]["text"] == "GPS_HIT_RATE > 3.8"
    assert told["steps"][0]["kind"] == "draw"


def test_a_model_that_keeps_the_limit_holds(agent: None, capsys: pytest.CaptureFixture[str]) -> None:
    assert (
        run(["check", str(GPS / "mission.toml"), "--flights", "2", "--max-failure-rate", "0.2", "--missions", "60"])
        == 0
    )
    assert "HOLDS: the rate is within the accepted 20 %" in capsys.readouterr().out


def test_the_json_does_not_depend_on_the_workers(agent: None, tmp_path: Path) -> None:
    for workers in ("1", "2"):
        mission = str(GPS / "mission.toml")
        assert (
            run(["check", mission, "--flights", "2", "--workers", workers, "--output", f"out{workers}", "--no-store"])
            == 1
        )
    for name in ("report.json", "report.html", "report.sarif", "junit.xml"):
        assert (tmp_path / "out1" / name).read_bytes() == (tmp_path / "out2" / name).read_bytes()


def test_a_batch_is_resumed(agent: None, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    mission = str(GPS / "mission.toml")
    assert run(["check", mission, "--flights", "2", "--missions", "20", "--format", "json"]) == 1
    first = capsys.readouterr().out
    plug(monkeypatch, load_broken)  # nothing that is flown again can succeed
    assert run(["check", mission, "--flights", "2", "--missions", "20", "--format", "json", "--resume"]) == 1
    assert json.loads(capsys.readouterr().out)["missions"] == json.loads(first)["missions"]


def test_errors_of_the_tool_are_counted_apart(
    agent: None, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    plug(monkeypatch, load_troubled)
    Path("m.toml").write_text((GPS / "mission.toml").read_text() + "time_limit = 1.0\n")
    for name in GPS.glob("*.nddl"):
        Path(name.name).write_text(name.read_text())
    assert run(["check", "m.toml", "--missions", "12", "--max-failure-rate", "1"]) == 3
    text = capsys.readouterr().out
    assert "errors of the tool, counted nowhere:" in text
    assert "UNDECIDED" in text


def test_a_mission_that_passed_is_flown_again_on_request(agent: None, capsys: pytest.CaptureFixture[str]) -> None:
    run(["check", str(GPS / "mission.toml"), "--flights", "2", "--missions", "20"])
    capsys.readouterr()
    assert run(["explain", "latest#1", "--events"]) == 0
    text = capsys.readouterr().out
    assert "mission 1 of run" in text
    assert "passed" in text
    assert "mission over at tick 900" in text


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["explain"], "there is no store"),
        (["explain", "latest#x"], "`x` is no number of a mission"),
        (["check", "nowhere.toml"], "no file `nowhere.toml`"),
    ],
)
def test_what_cannot_be_done_is_said(
    agent: None, capsys: pytest.CaptureFixture[str], arguments: list[str], complaint: str
) -> None:
    assert run(arguments) == 2
    assert complaint in capsys.readouterr().err


def test_a_model_with_three_mistakes_has_them_all_reported(agent: None, capsys: pytest.CaptureFixture[str]) -> None:
    lines = ["class Lamp extends Timeline {", "  predicate On { int power; }", "}", "Lamp a = new Lmap();", ""]
    lines += ["Lamp::On {", "  brightness == 3;", "  starts(object.Off o);", "}"]
    Path("lamp.nddl").write_text("\n".join(lines) + "\n")
    assert run(["check", "lamp.nddl", "--format", "json"]) == 2
    found = json.loads(capsys.readouterr().out)["diagnostics"]
    assert [one["line"] for one in found] == [4, 7, 8]
    Path("good.nddl").write_text("class Lamp extends Timeline {\n  predicate On { int power; }\n}\n")
    assert run(["check", "good.nddl"]) == 0


def test_a_mission_with_mistaken_models_flies_nothing(agent: None, capsys: pytest.CaptureFixture[str]) -> None:
    Path("navigator.nddl").write_text("int x = y;\nint x2 = z;\n")
    Path("psim.nddl").write_text("Lamp l;\n")
    Path("mission.toml").write_text((GPS / "mission.toml").read_text())
    assert run(["check", "mission.toml"]) == 2
    text = capsys.readouterr().out
    assert "navigator.nddl:1:" in text
    assert "navigator.nddl:2:" in text
    assert "psim.nddl:1:" in text
    assert "nothing was flown" in text


def test_a_mission_that_does_not_fit_its_models_is_refused(agent: None, capsys: pytest.CaptureFixture[str]) -> None:
    for name in GPS.glob("*.nddl"):
        Path(name.name).write_text(name.read_text())
    text = (GPS / "mission.toml").read_text()
    text = text.replace('"motion"', '"motions"').replace('"Transit"', '"Transot"', 1).replace("distance =", "way =")
    Path("mission.toml").write_text(text)
    assert run(["check", "mission.toml", "--format", "json"]) == 2
    found = json.loads(capsys.readouterr().out)["diagnostics"]
    assert [(one["code"], one["message"], one["help"]) for one in found] == [
        ("NDDL716", "the model `psim.nddl` has no object `motions`", "did you mean `motion`?"),
        ("NDDL717", "`Nav` has no predicate `Transot`", "did you mean `Transit`?"),
        ("NDDL718", "`Nav.Transit` has no parameter `way`", "did you mean `distance`?"),
    ]


def test_a_parameter_that_no_model_samples_is_refused(agent: None, capsys: pytest.CaptureFixture[str]) -> None:
    for name in GPS.glob("*.nddl"):
        Path(name.name).write_text(name.read_text())
    text = (GPS / "mission.toml").read_text().replace("[parameters.GPS_HIT_RATE]", "[parameters.GPS_HITRATE]")
    Path("mission.toml").write_text(text)
    assert run(["check", "mission.toml"]) == 2
    printed = capsys.readouterr().out
    assert "no model samples a parameter `GPS_HITRATE`" in printed
    assert "did you mean `GPS_HIT_RATE`?" in printed


def test_causes_that_the_check_has_found_are_not_sought_again(agent: None, capsys: pytest.CaptureFixture[str]) -> None:
    run(["check", str(GPS / "mission.toml"), "--flights", "3"])
    with open_store(STORE) as store:
        run_id = store.run_ids()[0]
        ((example, text),) = store.causes(run_id).items()
        kept = replace(read_record(Causes, text), tried=12345)
        store.keep_causes(run_id, {example: write_record(kept)})
    capsys.readouterr()
    assert run(["explain", f"{run_id}#{example}", "--flights", "3"]) == 0
    told = capsys.readouterr().out
    assert "(12345 lines tried in 3 flights of the same mission" in told
    other = re.findall(r"more missions fail alike: (\d+)", told)[0]
    assert run(["explain", f"{run_id}#{other}", "--flights", "3"]) == 0
    assert "(12345 lines tried in 3 flights of one that fails alike" in capsys.readouterr().out
    assert run(["explain", f"{run_id}#{example}", "--flights", "4"]) == 0
    assert "12345" not in capsys.readouterr().out


def test_a_run_that_is_stored_is_checked_again_without_seeking(agent: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """And says the same, byte by byte; where it is to be sought otherwise, or among more missions, it is sought."""
    sought: list[object] = []

    def counted(*arguments: Any) -> Any:
        sought.append(arguments)
        return faults_of(*arguments)

    monkeypatch.setattr("checker.findings.faults_of", counted)
    check = ["check", str(GPS / "mission.toml"), "--flights", "3", "--missions", "40"]
    pages = []
    for more, times in (
        ((), 1),
        ((), 1),
        (("--format", "json"), 1),
        (("--flights", "4"), 2),
        (("--flights", "4"), 2),
        (("--missions", "44"), 3),
        (("--no-conditions",), 4),
        (("--fresh",), 5),
        (("--no-store",), 6),
    ):
        assert run([*check, *more]) == 1
        assert len(sought) == times, more
        pages.append(
            [(Path("nddlc-report") / name).read_bytes() for name in ("report.json", "report.html", "junit.xml")]
        )
    assert pages[0] == pages[1] == pages[2]
    assert pages[3] == pages[4] != pages[5]


def test_what_the_clock_cut_off_is_sought_again(agent: None, monkeypatch: pytest.MonkeyPatch) -> None:
    check = ["check", str(GPS / "mission.toml"), "--flights", "3", "--missions", "40"]
    with monkeypatch.context() as patch:
        patch.setattr("nddlc.check._SECONDS_A_FAULT", 0.0)
        run(check)
    cut = Path("nddlc-report/report.json").read_bytes()
    run(check)
    assert Path("nddlc-report/report.json").read_bytes() != cut
