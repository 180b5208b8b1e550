"""Logs of T-REX are read, judged against the models, and flown again to be explained."""

import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from checker.causes import failed_by
from checker.culprit import culprit_of
from checker.logged import read_mission_log
from checker.mission import read_mission
from checker.models import load_models
from checker.oracle import Verdict, judge
from checker.pinned import pinned
from nddlc.explain import command as explain
from nddlc.inputs import Unusable
from nddlc.validate import command as validate
from runtime.executive.outcome import Outcome
from runtime.executive.rendering import trace_json
from runtime.user.transaction_log import TransactionLogError, parse_transaction_log
from tests.checker.transaction_logs import write_logs

GPS = Path(__file__).parents[2] / "models" / "gps" / "mission.toml"
OWNED = {"navigator": ("nav",), "psim": ("helm", "gps", "motion")}
FORMS = pytest.mark.parametrize("is_old", [False, True], ids=["T-REX 2", "2011"])


def flown(verdict: Verdict) -> Outcome:
    mission, _ = read_mission(GPS)
    assert mission is not None
    models = load_models(mission)
    outcomes = map(pinned(models)(models.agent), range(200))
    return next(outcome for outcome in outcomes if judge(outcome).verdict is verdict)


def judged(path: Path) -> tuple[int, str]:
    found = CliRunner().invoke(validate, [str(path), "--mission", str(GPS)], standalone_mode=False)
    if found.exception is not None:
        raise found.exception
    return int(found.return_value or 0), found.output


def explained(path: Path, *more: str) -> str:
    found = CliRunner().invoke(explain, [str(path), "--mission", str(GPS), *more], standalone_mode=False)
    if found.exception is not None:
        raise found.exception
    return found.output


@FORMS
def test_the_logs_of_a_right_mission_hold(tmp_path: Path, is_old: bool) -> None:
    write_logs(tmp_path, flown(Verdict.PASS), OWNED, is_old=is_old)
    code, told = judged(tmp_path)
    assert code == 0, told
    assert "0 disagreements" in told
    assert int(told.split()[0]) > 150
    assert judged(tmp_path / "psim.tr.log")[0] == 0


@FORMS
def test_what_breaks_the_model_in_a_log_is_told_with_its_line(tmp_path: Path, is_old: bool) -> None:
    write_logs(tmp_path, flown(Verdict.PASS), OWNED, is_old=is_old)
    log = tmp_path / "psim.tr.log"
    text = log.read_text()
    ascends = re.search(r'<tick value="(\d+)">[^t]*<Observation on="helm" pred="Ascend">', text)
    assert ascends is not None
    # The ascent now begins a tick earlier, and so lasts a tick longer than it does.
    tick = int(ascends.group(1))
    moved = re.search(r'<Observation on="helm" pred="Ascend">.*</Observation>\n', text)
    assert moved is not None
    text = text.replace(moved.group(), "", 1)
    earlier = f' <tick value="{tick - 1}">\n'
    wrapped = moved.group() if is_old else f"  <synchronize>\n{moved.group()}  </synchronize>\n"
    if earlier in text:
        text = text.replace(earlier, earlier + wrapped, 1)
    else:
        later = next(
            one for one in re.findall(r'  <tick value="\d+">\n', text) if int(re.findall(r"\d+", one)[0]) >= tick
        )
        text = text.replace(later, f'  <tick value="{tick - 1}">\n{wrapped}  </tick>\n{later}', 1)
    log.write_text(text)
    code, told = judged(tmp_path)
    assert code == 1
    assert "rules.nddl:29: `contains(Helm.Ascend up)`" in told


@FORMS
def test_a_mission_that_failed_is_explained_from_its_logs(tmp_path: Path, is_old: bool) -> None:
    outcome = flown(Verdict.FAIL)
    place = culprit_of(failed_by(outcome).conflict).place
    assert place is not None
    write_logs(tmp_path, outcome, OWNED, is_old=is_old)
    data = json.loads(explained(tmp_path, "--flights", "12", "--format", "json"))
    assert data["log"][0] == "played from the log: psim"
    assert data["code"] == judge(outcome).code
    told = explained(tmp_path, "--flights", "0")
    assert f"failed at tick {outcome.last_tick}" in told
    assert f"{Path(place.file).name}:{place.line}" in told
    assert "departs" not in told


def test_of_a_mission_that_passed_nothing_is_explained(tmp_path: Path) -> None:
    write_logs(tmp_path, flown(Verdict.PASS), OWNED)
    told = explained(tmp_path)
    assert "played from the log: psim" in told
    assert "passed" in told
    assert "departs" not in told


def test_a_log_that_breaks_off_counts_as_far_as_it_goes(tmp_path: Path) -> None:
    write_logs(tmp_path, flown(Verdict.PASS), OWNED)
    for log in tmp_path.iterdir():
        text = log.read_text()
        log.write_text(text[: text.index('<tick value="260">') + 9])
    code, told = judged(tmp_path)
    assert code == 0
    assert "psim.tr.log" in told
    assert "breaks off" in told
    read = read_mission_log(tmp_path)
    assert 250 < read.last_tick <= 260
    assert set(read.cut_off) == {"navigator.tr.log", "psim.tr.log"}


def test_a_trace_is_explained_as_a_log_is(tmp_path: Path) -> None:
    outcome = flown(Verdict.FAIL)
    trace = tmp_path / "flight.jsonl"
    trace.write_text("\n".join(trace_json(event) for event in outcome.events) + "\n")
    told = explained(trace, "--flights", "0")
    assert "played from the log: psim" in told
    assert f"failed at tick {outcome.last_tick}" in told
    with pytest.raises(Unusable, match="no log of a mission"):
        explained(tmp_path / "none.jsonl")


def test_a_limit_that_a_record_has_reached_is_a_cause(tmp_path: Path) -> None:
    """Nothing is on record after the abort, so that with any limit what held then would last too long in the end."""
    outcome = flown(Verdict.FAIL)
    assert outcome.abort is not None and outcome.abort.code == "F1"
    trace = tmp_path / "flight.jsonl"
    trace.write_text("\n".join(trace_json(event) for event in outcome.events) + "\n")
    data = json.loads(explained(trace, "--flights", "12", "--format", "json"))
    assert any(f"the record ends at tick {outcome.last_tick}" in line for line in data["log"])
    first = data["causes"]["ranked"][0]
    assert (first["claim"], "SURFACE_MAX" in first["text"]) == ("mends", True)
    assert data["last_tick"] == outcome.last_tick


def test_timelines_that_nobody_owns_are_counted(tmp_path: Path) -> None:
    ping = '<tick value="3"><Observation on="sonar" pred="Ping"/></tick>'
    text = f'<Log><header><provide name="sonar"/></header>{ping}</Log>'
    (tmp_path / "other.tr.log").write_text(text)
    code, told = judged(tmp_path)
    assert code == 0
    assert "`sonar`, a timeline that no reactor of the mission owns" in told
    with pytest.raises(Unusable, match="asks nobody"):
        explained(tmp_path)


def test_all_that_a_log_may_say_is_read() -> None:
    log = parse_transaction_log(
        """<?xml version="1.0"?>
        <Log> <!-- a message -- with dashes & more -->
          <header> <provide name="pose" goals="0" plan="0" /> <use name="sea" goals="1"/> </header>
          <tick value="4"><start>
            <Observation on="pose" pred="Pose.At">
              <Variable name="x"><float min="1.2500" max="1.2500"/></Variable>
              <Variable name="y"><float min="-2.0000"/></Variable>
              <Variable name="n"><int value="7"/></Variable>
              <Variable name="up" type="bool"><bool value="1"/></Variable>
              <Variable name="mode"><enum><elem value="Slow"/><elem value="Fast"/></enum></Variable>
              <Variable name="gear"><enum><elem value="First"/></enum></Variable>
              <Variable name="what"><europa_object value="ship"/></Variable>
            </Observation></start></tick>
          <tick value="5"><has_work> <work value="1"/>
            <request id="0x1f"><Goal on="sea" pred="Calm"><Variable name="start"><int min="6" max="9"/></Variable>
              <Variable name="duration"><int value="3"/></Variable>
              <Variable name="depth"><float max="4.0000"/></Variable>
            </Goal></request>
            <token id="0x2f"><Goal on="pose" pred="At"/></token>
          </has_work></tick>
          <tick value="8"><step><recall id="0x1f"><Goal on="sea" pred="Calm"/></recall><cancel id="0x2f"/></step></tick>
          <tick value="9"><synchronize><failed/></synchronize></tick>
        </Log>""",
        "pilot",
    )
    assert (log.provided, log.used, log.last_tick, log.failed) == (("pose",), ("sea",), 9, 9)
    assert log.is_whole
    assert log.step == pytest.approx(0.0001)
    seen, asked, recalled = log.events
    assert (seen["tick"], seen["timeline"], seen["predicate"]) == (4, "pose", "At")
    assert seen["arguments"] == {
        "x": 1.25,
        "y": [-2.0, "inf"],
        "n": 7,
        "up": True,
        "mode": ["Slow", "Fast"],
        "gear": "First",
        "what": "ship",
    }
    assert (asked["start"], asked["duration"], asked["end"]) == ([6, 9], [3, 3], ["-inf", "inf"])
    assert asked["arguments"] == {"depth": ["-inf", 4.0]}
    assert (recalled["kind"], recalled["tick"], recalled["request"]) == ("recall", 8, asked["request"])


@pytest.mark.parametrize(
    "text",
    [
        "",
        "no log",
        "<Mission></Mission>",
        "<Log><tick></tick></Log>",
        '<Log><tick value="soon"></tick></Log>',
        "<Log><tick value='1'></Log></tick>",
        '<Log><tick value="1"><Observation on="x" pred="y"><Variable name="z"><int value="w"/></Variable>',
        '<!DOCTYPE Log [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><Log>&b;</Log>',
    ],
)
def test_what_is_no_log_is_refused_with_its_line(text: str) -> None:
    with pytest.raises(TransactionLogError, match=r"^line \d+: "):
        parse_transaction_log(text, "x")


def test_open_ends_of_a_trace_are_no_names(tmp_path: Path) -> None:
    outcome = flown(Verdict.PASS)
    text = "\n".join(trace_json(event) for event in outcome.events)
    assert '"distance":240.0' in text
    trace = tmp_path / "flight.jsonl"
    trace.write_text(text.replace('"distance":240.0', '"distance":[240.0,"inf"]'))
    assert judged(trace)[0] == 0
