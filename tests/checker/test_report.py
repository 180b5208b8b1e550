"""Every form of the report says the same, stands alone, and is well-formed."""

import json
import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest
from jsonschema import Draft202012Validator

from checker.campaign import Campaign
from checker.excerpts import Excerpts
from checker.findings import Ending, Findings
from checker.mission import read_mission
from checker.models import load_models
from checker.names import relative_name
from checker.oracle import Judgement, Verdict
from checker.report.document import json_report
from checker.report.github import github_report
from checker.report.html import html_report
from checker.report.junit import junit_report
from checker.report.markdown import markdown_report
from checker.report.sarif import sarif_report
from checker.report.sentences import fault_title
from checker.report.svg import Axis
from checker.report.text import text_report
from checker.schemas import schema
from checker.steps import Step, StepKind
from nddl_lang.text.write import write_whole
from nddlc.main import run
from runtime.executive.outcome import SourcePlace
from tests.checker.fake_agent import load_split
from tests.sarif import check_sarif

ROOT = Path("models/gps")


@pytest.fixture(scope="module")
def campaign() -> Campaign:
    mission, _ = read_mission(ROOT / "mission.toml")
    assert mission is not None
    return Campaign(mission, load_models(mission), load_split)


@pytest.fixture(scope="module")
def findings(campaign: Campaign) -> Findings:
    sixty = replace(campaign.mission, check=replace(campaign.mission.check, missions=60))
    results = list(replace(campaign, mission=sixty).fly(1, None).results)
    broken = Judgement(Verdict.ERROR, message="KeyError: <'x' & \x07>")
    results[2] = replace(results[2], judgement=broken, outcome=None, has_trace=False)
    return campaign.assess(tuple(results))


def test_the_text_names_line_condition_and_command(findings: Findings) -> None:
    text = text_report(findings, Excerpts(ROOT))
    assert "gps: 60 missions, 4 failed, 1 not flown to the end because of an error of the tool" in text
    assert "--> models/gps/rules.nddl:34" in text
    assert "fails when GPS_HIT_RATE > 3.8" in text
    assert f"nddlc explain {findings.run_id}#16" in text


def test_missions_that_one_line_ended_in_another_way_are_counted_so(findings: Findings) -> None:
    last = findings.faults[0].bucket.missions[-1]
    missed = Judgement(Verdict.FAIL, "F6")
    results = [replace(one, judgement=missed) if one.number == last else one for one in findings.results]
    assert "them" not in fault_title(findings, 0)
    assert "; 1 of them F6)" in fault_title(replace(findings, results=tuple(results)), 0)


def test_z3_is_asked_once_of_the_conflict_that_a_story_tells(campaign: Campaign, findings: Findings) -> None:
    fault = findings.faults[0]
    example = next(one for one in findings.results if one.number == fault.bucket.example)
    assert fault.confirmation is not None
    assert campaign.story(example, fault).confirmation is fault.confirmation


def test_the_json_is_strict_and_complete(findings: Findings) -> None:
    text = json_report(findings, Excerpts(ROOT))
    data = json.loads(text, parse_constant=lambda word: pytest.fail(word))
    assert data["counts"] == {"pass": 55, "fail": 4, "error": 1}
    assert data["faults"][0]["place"]["file"] == "rules.nddl"
    assert data["faults"][0]["limits"][0]["line"] == 5
    assert len(data["missions"]) == 60
    assert str(Path.cwd()) not in text


def test_the_page_stands_alone(campaign: Campaign, findings: Findings) -> None:
    page = html_report(findings, Excerpts(ROOT), campaign.stories(findings))
    assert page.count("<script") == page.count("<script>") == 1
    assert re.search(r"(src|href)=|url\(|https?:", page) is None
    assert "prefers-color-scheme: dark" in page
    assert page.count("<svg") == page.count("</svg>") == 4
    assert "GPS_HIT_RATE &gt; 3.8" in page
    assert "<mark>duration &lt;= SURFACE_MAX;</mark>" in page
    for svg in re.findall(r"<svg.*?</svg>", page, re.DOTALL):
        ElementTree.fromstring(svg)


def test_a_failing_and_a_passing_mission_stand_beside_each_other(campaign: Campaign, findings: Findings) -> None:
    pairs = campaign.pairs(findings)
    (pair,) = pairs
    assert pair is not None
    assert pair.failing.verdict is Verdict.FAIL
    assert pair.passing.verdict is Verdict.PASS
    assert pair.passing.has_trace
    page = html_report(findings, Excerpts(ROOT), campaign.stories(findings), pairs)
    assert page.count("<figure>") == 2
    assert f"mission {pair.passing.number} passes" in page
    figures = [ElementTree.fromstring(one) for one in re.findall(r"<figure>.*?(<svg.*?</svg>)", page, re.DOTALL)]
    marks = [line for line in figures[0].iter("line") if line.get("class") in ("edge", "edge fault")]
    assert marks, "the steps of the chain are marked in the failing mission"
    assert not [line for line in figures[1].iter("line") if "edge" in str(line.get("class"))]


def test_many_lines_of_one_rule_are_folded_and_steps_keep_their_numbers(campaign: Campaign, findings: Findings) -> None:
    story = next(one for one in campaign.stories(findings) if one is not None)
    draw = story.steps[0]
    lines = [Step(StepKind.LINE, None, rule, draw.place) for rule in ["Motion.Step"] * 30 + ["Gps.Fix"] * 2]
    longer = replace(story, steps=(draw, *lines, *story.steps[1:]))
    page = html_report(findings, Excerpts(ROOT), [longer])
    assert page.count("acts through the rule of Gps.Fix") == 2
    assert "acts through the rule of Motion.Step" not in page
    assert "2–31." in page
    assert "counter-increment: step 30" in page
    assert "it acts through 30 lines of the rule of Motion.Step" in page


def test_the_table_can_be_sorted_and_filtered(campaign: Campaign, findings: Findings) -> None:
    page = html_report(findings, Excerpts(ROOT), campaign.stories(findings))
    table = page[page.index('class="missions"') : page.index("</table>")]
    assert table.count("<tr data-verdict") == 60
    assert table.count('<th class="n" scope="col"><button') + table.count('<th class="" scope="col"><button') >= 8
    assert '<input type="search"' in table


def test_junit_has_a_case_per_mission(findings: Findings) -> None:
    suite = ElementTree.fromstring(junit_report(findings, Excerpts(ROOT)))[0]
    assert (suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("60", "4", "1")
    failure = suite.find("testcase/failure")
    assert failure is not None
    assert failure.text is not None
    assert "models/gps/rules.nddl:34: duration <= SURFACE_MAX;" in failure.text


@pytest.mark.parametrize("kept", ["none", "errors", "gaps", "failures"])
def test_every_form_is_well_formed_whatever_came_of_a_batch(campaign: Campaign, findings: Findings, kept: str) -> None:
    """Ended by a signal before anything was flown, with nothing but errors, with gaps, with nothing but failures."""
    chosen = {
        "none": [],
        "errors": [one for one in findings.results if one.verdict is Verdict.ERROR],
        "gaps": [one for one in findings.results if one.number not in (12, 13)],
        "failures": [one for one in findings.results if one.verdict is Verdict.FAIL],
    }[kept]
    found = campaign.assess(tuple(chosen), may_fly=False, ending=Ending.SIGNAL)
    excerpts = Excerpts(ROOT)
    suite = ElementTree.fromstring(junit_report(found, excerpts))[0]
    for name, tag in (("tests", "testcase"), ("failures", "testcase/failure"), ("errors", "testcase/error")):
        assert suite.get(name) == str(len(suite.findall(tag)))
    check_sarif(json.loads(sarif_report(found, excerpts)))
    data = json.loads(json_report(found, excerpts), parse_constant=lambda word: pytest.fail(word))
    assert (data["verdict"], data["ending"], len(data["missions"])) == ("interrupted", "signal", len(chosen))
    assert data["rate"]["counted"] == (10 if kept == "gaps" else 0)  # of 1 to 11 without the ERROR
    assert "interrupted" in text_report(found, excerpts)
    assert html_report(found, excerpts, campaign.stories(found)).rstrip().endswith("</html>")
    assert markdown_report(found, excerpts).startswith("#")


def test_sarif_points_at_the_line(findings: Findings) -> None:
    log = json.loads(sarif_report(findings, Excerpts(ROOT)))
    check_sarif(log)
    result, error = log["runs"][0]["results"]
    assert error["message"]["text"].startswith("1 mission could not be flown: KeyError")
    assert error["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "models/gps/mission.toml"
    place = result["locations"][0]["physicalLocation"]
    assert place == {
        "artifactLocation": {"uri": "models/gps/rules.nddl"},
        "region": {"startLine": 34, "startColumn": 3},
    }


def test_a_file_is_written_whole_or_not_at_all(tmp_path: Path) -> None:
    path = tmp_path / "deep" / "report.txt"
    write_whole(path, "first")
    with pytest.raises(UnicodeEncodeError):
        write_whole(path, "half \ud800")
    assert path.read_text() == "first"
    assert [child.name for child in path.parent.iterdir()] == ["report.txt"]


def test_a_link_to_itself_is_replaced_and_a_folder_of_links_in_a_circle_is_no_place(tmp_path: Path) -> None:
    """`Path.resolve` makes a RuntimeError of such a link, which was told as a bug of nddlc."""
    link, folder = tmp_path / "report.txt", tmp_path / "folder"
    link.symlink_to(link)
    write_whole(link, "text")
    assert link.read_text() == "text"
    folder.symlink_to(folder)
    with pytest.raises(OSError, match=r"exists|links"):
        write_whole(folder / "report.txt", "text")


def test_an_excerpt_is_of_what_was_flown(tmp_path: Path) -> None:
    (tmp_path / "m.nddl").write_text("int x;\nint changed;\n")
    excerpts = Excerpts(tmp_path)
    assert excerpts.line(SourcePlace("m.nddl", 1, 1, "int x;")) == "int x;"
    assert excerpts.line(SourcePlace("m.nddl", 2, 1, "int y;")) == "int y;"
    assert excerpts.line(SourcePlace("gone.nddl", 2, 1, "int z;")) == "int z;"


def test_names_are_the_same_in_every_checkout(tmp_path: Path) -> None:
    assert relative_name(str(tmp_path / "m" / "a.nddl"), tmp_path / "m") == "a.nddl"
    assert relative_name(str(tmp_path / "common" / "a.nddl"), tmp_path / "m") == "../common/a.nddl"
    assert relative_name("/x/nddl_lang/library/TREX.nddl", tmp_path) == "library/TREX.nddl"


def test_ticks_of_an_axis_are_round() -> None:
    assert Axis(0.0, 4.0, 0.0, 100.0).ticks() == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert Axis(-0.3, 0.3, 0.0, 100.0).ticks() == [-0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3]
    assert Axis(2.0, 2.0, 0.0, 100.0).ticks()


def test_github_marks_the_lines(findings: Findings) -> None:
    lines = github_report(findings, Excerpts(ROOT)).splitlines()
    assert all(re.fullmatch(r"::(error|warning|notice) [^:]*::.+", line) for line in lines)
    assert lines[0].startswith("::error file=models/gps/rules.nddl,line=34,col=3,title=F1 an expected observation")
    assert "fails when GPS_HIT_RATE > 3.8" in lines[0]
    assert "KeyError" in lines[1]
    assert lines[-1].startswith("::notice title=gps%3A 60 missions%2C 4 failed")


def test_markdown_tells_verdict_faults_and_costs(findings: Findings) -> None:
    page = markdown_report(findings, Excerpts(ROOT))
    assert page.startswith("## gps: fails\n")
    assert "| 60 | 4 | 6.78 % | 1 % | 1 |" in page
    assert "models/gps/rules.nddl:34: duration <= SURFACE_MAX;" in page
    assert "Fails when GPS\\_HIT\\_RATE &gt; 3.8" in page
    assert "KeyError: &lt;'x' & \x07&gt;" in page
    assert "* repairs of plans: 4; requests between reactors: 59" in page
    assert "all of them optional" in page


def test_of_no_mission_nothing_is_known_in_any_form(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    mission = str((ROOT / "mission.toml").resolve())
    monkeypatch.chdir(tmp_path)
    assert run(["check", mission, "--seconds", "1e-9", "--workers", "1", "--no-store", "--format", "github"]) == 2
    assert capsys.readouterr().out.startswith("::error title=gps%3A 0 missions of 200 (time was over)")
    forms = {one.name: one.read_text(encoding="utf-8") for one in (tmp_path / "nddlc-report").iterdir()}
    data = json.loads(forms["report.json"])
    assert (data["verdict"], data["rate"]["observed"], data["missions"]) == ("unknown", None, [])
    assert list(Draft202012Validator(schema("report")).iter_errors(data)) == []
    assert '<span class="verdict unknown">unknown</span>' in forms["report.html"]
    assert "## gps: unknown" in forms["report.md"]
    assert "0 %" not in forms["report.md"]
    assert ElementTree.fromstring(forms["junit.xml"]).get("errors") == "1"
    assert [one["level"] for one in json.loads(forms["report.sarif"])["runs"][0]["results"]] == ["error"]
