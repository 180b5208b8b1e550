"""A failed mission is set against one that passes, shrunk, and kept as a case that is flown first."""

import json
import tomllib
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import pytest

from checker.batch.result import MissionResult
from checker.campaign import Campaign
from checker.conditions.space import Space
from checker.contrast import SubsetSearch, find_contrast
from checker.mission import read_mission
from checker.models import load_models
from checker.oracle import Judgement, Verdict
from checker.pinned import pinned
from checker.regression import RegressionCase, RegressionError, agent_of, cases_text, read_cases
from nddlc.main import run
from runtime.executive.configuration import (
    AgentConfiguration,
    GoalConfiguration,
    ParameterConfiguration,
    PropertyConfiguration,
    PropertyKind,
    TokenPattern,
)
from runtime.executive.outcome import Abort, Draw, Outcome, Reason, ReasonKind
from tests.checker.conditions.campaigns import campaign, flown
from tests.sarif import check_sarif

pytestmark = pytest.mark.once

RULE = "bool u; bool v; u == (p > 0.6); v == (q < 0.35); if (u == true) { if (v == true) { r >= 2.0; } }"


def broken(p: float, q: float) -> bool:
    return p > 0.6 and q < 0.35


def test_the_parameters_that_decide_are_told(tmp_path: Path) -> None:
    given = campaign(tmp_path, RULE, missions=60)
    results = flown(given)
    failed = next(one for one in results if one.verdict is Verdict.FAIL)
    found = given.contrast(failed, results)
    assert found is not None and found.is_smallest and found.flights <= 31
    passing = next(one for one in results if one.number == found.passing)
    assert passing.verdict is Verdict.PASS and passing.outcome is not None
    before = {draw.parameter: draw.value for draw in passing.outcome.draws}
    after = before | {one.parameter: one.failing for one in found.decisive}
    assert not broken(before["P"], before["Q"])
    assert broken(after["P"], after["Q"])
    assert "R" not in {one.parameter for one in found.decisive}
    assert found.partings[0].tick == 4
    assert found.partings[0].failing and found.partings[0].passing


NAMES = "ABCDEF"


def six(values: dict[str, float] | None = None) -> AgentConfiguration:
    parameters = tuple(
        ParameterConfiguration(name, 0.0, 1.0)
        if values is None
        else ParameterConfiguration(name, 0.0, 1.0, distribution="fixed", values=(values[name],))
        for name in NAMES
    )
    return AgentConfiguration("six", ".", 10, (), parameters=parameters)


def result(number: int, values: dict[str, float], needed: frozenset[str]) -> MissionResult:
    fails = all(values[name] > 0.5 for name in needed)
    reason = Reason(ReasonKind.NO_PLAN)
    abort = Abort("F3", 5, "sim", (), reason, None, 0, -1) if fails else None
    draws = tuple(Draw(name, 0, value, value) for name, value in values.items())
    judged = Judgement(Verdict.FAIL, "F3", reason) if fails else Judgement(Verdict.PASS)
    return MissionResult(number, number, judged, Outcome(number, 5, 10, abort, draws, (), ()), has_trace=True)


@pytest.mark.parametrize("size", range(1, 7))
def test_six_parameters_take_at_most_31_flights(size: int) -> None:
    for needed in map(frozenset, combinations(NAMES, size)):
        failed = result(1, dict.fromkeys(NAMES, 0.9), needed)
        passed = result(2, dict.fromkeys(NAMES, 0.1), needed)

        def trace(agent: AgentConfiguration, number: int, seed: int, needed: frozenset[str] = needed) -> MissionResult:
            return result(number, {one.name: one.values[0] for one in agent.parameters}, needed)

        found = find_contrast(failed, (failed, passed), six(), trace)
        assert found is not None
        assert {one.parameter for one in found.decisive} == needed
        assert found.flights <= 31
        assert found.is_smallest or size > 3


def test_a_mission_that_fails_otherwise_with_the_redraws_of_the_failed_one_is_no_contrast() -> None:
    needed = frozenset("C")
    failed = result(1, dict.fromkeys(NAMES, 0.9), needed)
    near, far = result(2, dict.fromkeys(NAMES, 0.4), needed), result(3, dict.fromkeys(NAMES, 0.1), needed)

    def trace(agent: AgentConfiguration, number: int, seed: int) -> MissionResult:
        values = {one.name: one.values[0] for one in agent.parameters}
        flown = result(number, values, needed)
        if set(values.values()) == {0.4}:
            return replace(flown, judgement=Judgement(Verdict.FAIL, "F4", Reason(ReasonKind.NO_PLAN)))
        return flown

    found = find_contrast(failed, (failed, near, far), six(), trace)
    assert found is not None and found.passing == 3
    assert find_contrast(failed, (failed, near), six(), trace) is None


def test_a_suspect_that_decides_alone_takes_two_flights() -> None:
    needed = frozenset("C")
    failed, passed = result(1, dict.fromkeys(NAMES, 0.9), needed), result(2, dict.fromkeys(NAMES, 0.1), needed)

    def trace(agent: AgentConfiguration, number: int, seed: int) -> MissionResult:
        return result(number, {one.name: one.values[0] for one in agent.parameters}, needed)

    found = find_contrast(failed, (failed, passed), six(), trace, suspects=("C",))
    assert found is not None and found.flights == 2 and found.is_smallest
    assert [one.parameter for one in found.decisive] == ["C"]
    wrong = find_contrast(failed, (failed, passed), six(), trace, suspects=("A",))
    assert wrong is not None and [one.parameter for one in wrong.decisive] == ["C"]


def test_a_smaller_set_is_found_beside_one_of_which_nothing_can_be_left_out() -> None:
    def is_failing(values: dict[str, float]) -> bool:
        high = {name for name, value in values.items() if value > 0.5}
        return ("F" in high and len(high) == 1) or {"A", "B", "C"} <= high

    failed = result(1, dict.fromkeys(NAMES, 0.9), frozenset())
    space = Space(six(), (failed,))

    def trace(agent: AgentConfiguration, number: int, seed: int) -> MissionResult:
        values = {one.name: one.values[0] for one in agent.parameters}
        return result(number, dict.fromkeys(NAMES, 0.9 if is_failing(values) else 0.1), frozenset(NAMES))

    search = SubsetSearch(space, failed, (0.9,) * 6, (0.1,) * 6, trace)
    assert search.smallest((0, 1, 2, 3, 4, 5), (0, 1, 2, 3, 4, 5)) == ((5,), True)


def test_a_mission_is_shrunk_to_what_matters(tmp_path: Path) -> None:
    given = campaign(tmp_path, RULE, missions=40, final_tick=200)
    results = flown(given)
    failed = next(one for one in results if one.verdict is Verdict.FAIL)
    found = given.shrink(failed, results)
    assert found is not None
    values = dict(found.values)
    assert broken(values["P"], values["Q"])
    assert found.off == ("P", "Q")
    assert all(value == round(value, 1) for value in values.values())
    assert values["R"] == pytest.approx(0.5, abs=0.05)
    assert found.final_tick == 5
    assert found.result.verdict is Verdict.FAIL


def test_a_promoted_mission_is_flown_first_until_it_passes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    campaign(tmp_path, RULE, missions=30)
    monkeypatch.chdir(tmp_path)
    assert run(["check", "mission.toml", "--flights", "2", "--max-failure-rate", "1"]) == 0
    capsys.readouterr()
    assert run(["shrink", "latest", "--format", "json"]) == 0
    shrunk = json.loads(capsys.readouterr().out)
    assert shrunk["off_nominal"] == ["P", "Q"]
    assert run(["promote", "latest", "--name", 'wet "pump"']) == 0
    (case,) = tomllib.loads(Path("mission.regressions.toml").read_text())["case"]
    assert case["name"] == 'wet "pump"'
    assert case["parameters"] == shrunk["parameters"]
    assert "final_tick" not in case  # by the early end of the shrunk mission no goal could be achieved
    capsys.readouterr()
    # The rate is accepted, the case is not.
    assert run(["check", "mission.toml", "--flights", "2", "--missions", "2", "--max-failure-rate", "1"]) == 1
    told = capsys.readouterr().out
    assert 'case `wet "pump"` (F3 at pump.nddl:14' in told
    assert "FAILS: 1 regression case still fails" in told
    (again,) = [one for one in json.loads(Path("nddlc-report/report.json").read_text())["cases"] if one["name"]]
    assert (again["name"], again["passes"], again["verdict"]) == ('wet "pump"', False, "FAIL")
    case_of_ci = ElementTree.parse("nddlc-report/junit.xml").find("testsuite/testcase[failure]")
    assert case_of_ci is not None
    assert 'case `wet "pump"`' in case_of_ci.attrib["name"]
    log = json.loads(Path("nddlc-report/report.sarif").read_text())
    check_sarif(log)
    levels = {one["message"]["text"]: one["level"] for one in log["runs"][0]["results"]}
    assert [level for text, level in levels.items() if 'case `wet "pump"`' in text] == ["error"]
    # What is in the store already does not keep it from being flown.
    again = ["check", "mission.toml", "--flights", "2", "--missions", "2", "--max-failure-rate", "1"]
    assert run([*again, "--format", "github"]) == 1
    marks = [line for line in capsys.readouterr().out.splitlines() if 'case `wet "pump"`' in line]
    assert marks[0].startswith("::error file=pump.nddl,line=14")
    model = Path("pump.nddl")
    model.write_text(model.read_text().replace("r >= 2.0", "r >= -2.0"))
    assert run(["check", "mission.toml", "--flights", "2", "--missions", "2"]) == 0
    assert "flown first: none of them fails any more" in capsys.readouterr().out


PUMP = """#include "TREX.nddl"
float P = [0.0 10.0];
class Pump extends AgentTimeline { predicate Wait { } predicate Stroke { } Pump(Mode m) { super(m, "Wait"); } }
Pump::Stroke { float p; p == sampledParameter(P); duration == ceil(p) + 1; }
Pump pump = new Pump(Internal);
close();
"""
REACHED = """[mission]
name = "pump"
final_tick = 30
[[reactor]]
name = "sim"
model = "pump.nddl"
lookahead = 5
[[goal]]
timeline = "pump"
predicate = "Stroke"
start = [2, 4]
[[property]]
name = "done"
kind = "reached"
timeline = "pump"
predicate = "Stroke"
by = 6
[check]
missions = 4
"""


def test_goals_stay_where_something_promised_was_not_reached(tmp_path: Path) -> None:
    """Without its goal the stroke is never reached, whatever is mended."""
    (tmp_path / "pump.nddl").write_text(PUMP)
    (tmp_path / "mission.toml").write_text(REACHED)
    mission, found = read_mission(tmp_path / "mission.toml")
    assert mission is not None, found
    models = load_models(mission)
    given = Campaign(mission, models, pinned(models))
    results = flown(given)
    failed = next(one for one in results if one.judgement.code == "P1")
    shrunk = given.shrink(failed, results)
    assert shrunk is not None
    assert shrunk.goals == (0,)
    assert dict(shrunk.values)["P"] > 3.0


def test_what_only_a_goal_that_was_left_out_brings_about_is_not_asked_of_a_case() -> None:
    """A case of one goal failed for ever by a property that another goal fulfils, mended or not."""
    properties = tuple(
        PropertyConfiguration(kind.value, kind, TokenPattern("arm"))
        for kind in (PropertyKind.REACHED, PropertyKind.NEVER)
    )
    goals = (GoalConfiguration("task", "Do"), GoalConfiguration("task", "Rest"))
    agent = AgentConfiguration("a", "", 9, (), goals, properties=properties)
    every = ["reached", "never"]
    for was, numbers, kept in (("F1", (1,), ["never"]), ("F1", (0, 1), every), ("P1: it", (1,), every)):
        flown = agent_of(RegressionCase("c", 1, was, goals=numbers), agent)
        assert [one.name for one in flown.properties] == kept


def test_cases_are_read_as_they_were_written(tmp_path: Path) -> None:
    cases = (
        RegressionCase('a \\ "b"\n', 7, "F1", final_tick=30, goals=(0, 2), parameters=(("P Q", 1e-9), ("R", -3.0))),
        RegressionCase("none", 8, "", goals=()),
    )
    place = tmp_path / "x.regressions.toml"
    place.write_text(cases_text(cases))
    assert read_cases(place) == cases
    assert read_cases(tmp_path / "none.toml") == ()


@pytest.mark.parametrize("text", ["[[case]]\nname = 3\n", "case = 1\n", "[[case\n"])
def test_a_broken_file_of_cases_is_told(tmp_path: Path, text: str) -> None:
    place = tmp_path / "x.regressions.toml"
    place.write_text(text)
    with pytest.raises(RegressionError, match=r"x\.regressions\.toml"):
        read_cases(place)
