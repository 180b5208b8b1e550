"""What `check` found out, `explain` tells: causes before the story, lint and Python beside them, no name of ours."""

import re
from pathlib import Path

import pytest

from checker.batch.result import MissionResult
from checker.buckets import group_failures
from checker.counterfactual.ranking import Causes
from checker.excerpts import Excerpts
from checker.explain import page_text
from checker.findings import Fault
from checker.oracle import Judgement, Verdict
from checker.story import Story
from nddlc.main import run
from runtime.executive.configuration import CodeConfiguration
from runtime.executive.outcome import Outcome, PropertyFate
from tests.checker.test_causes import GOAL, MISSION, MODEL

Page = pytest.CaptureFixture[str]


def checked(folder: Path, capsys: Page, model: str, mission: str, *options: str) -> str:
    """What `check` prints of a mission in a folder, where the user stands."""
    (folder / "planner.nddl").write_text(model)
    (folder / "mission.toml").write_text(mission)
    run(["check", "mission.toml", "--missions", "3", *options])
    return capsys.readouterr().out


def explained(capsys: Page, *options: str) -> str:
    assert run(["explain", *options]) == 0
    return capsys.readouterr().out


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def first_cause(page: str) -> str:
    """The change and the line of the first cause of a page of `explain`."""
    return page[page.index("\n   1  ") :].split("\n   2  ")[0].split("what happened:")[0]


@pytest.mark.parametrize("options", [(), ("--flights", "0"), ("-v",)])
def test_causes_that_check_confirmed_are_told_when_something_has_changed_since(
    tmp_path: Path, capsys: Page, options: tuple[str, ...]
) -> None:
    checked(tmp_path, capsys, MODEL, MISSION + GOAL.format(5))
    before = first_cause(explained(capsys))
    assert "passes then" in before or "pass then" in before
    assert "planner.nddl:" in before
    (tmp_path / "planner.nddl").write_text(MODEL + "// more\n")
    page = explained(capsys, *options)
    assert "have changed since this run" in page
    assert first_cause(page) == before
    assert "to blame" not in page


def test_causes_are_told_of_models_that_are_in_error_now(tmp_path: Path, capsys: Page) -> None:
    checked(tmp_path, capsys, MODEL, MISSION + GOAL.format(5))
    before = first_cause(explained(capsys))
    (tmp_path / "planner.nddl").write_text(MODEL + "Survey::\n")
    page = explained(capsys)
    assert page.startswith("the models are in error now; the explanation is of what was flown\n")
    assert first_cause(page) == before


PROMISE = '[[property]]\nname = "soon"\nkind = "reached"\ntimeline = "motor"\npredicate = "Run"\nby = 9\n'


def test_a_missed_promise_is_told_of_models_that_are_in_error_now(tmp_path: Path, capsys: Page) -> None:
    model = MODEL.replace("RUN_MAX = 12", "RUN_MAX = 40")
    told = checked(tmp_path, capsys, model, MISSION + GOAL.format(5) + PROMISE, "--flights", "0")
    assert "the property `soon` is violated" in told
    assert "the mission file requests Transect" in explained(capsys, "--flights", "0")
    (tmp_path / "planner.nddl").write_text(model + "Survey::\n")
    assert "the mission fails (P1" in explained(capsys, "--flights", "0")


def test_where_nothing_was_tried_no_line_is_blamed(tmp_path: Path, capsys: Page) -> None:
    checked(tmp_path, capsys, MODEL, MISSION + GOAL.format(5), "--flights", "0")
    page = explained(capsys, "--flights", "0")
    assert "no change was tried: which line is mistaken is not known" in page
    assert "to blame" not in page
    assert "<== where it breaks" in page


APART = MODEL.replace("contained_by(Motor.Run run);", "contained_by(Motor.Run run);\n    end - run.start <= 10;")


def test_a_part_of_an_expression_is_told_as_its_line_is_written(tmp_path: Path, capsys: Page) -> None:
    checked(tmp_path, capsys, APART, MISSION + GOAL.format(5), "--flights", "0")
    for page in (explained(capsys, "--flights", "0"), explained(capsys, "--flights", "0", "-v")):
        assert "end - run.start <= 10" in page
        assert re.search(r"\b_\d+\b", page) is None


EQUAL = MODEL.replace("contained_by(Motor.Run run);", "contains(Motor.Run run);\n    run.end == start;")


def test_of_an_equality_the_side_that_counts_is_told_with_the_line(tmp_path: Path, capsys: Page) -> None:
    checked(tmp_path, capsys, EQUAL, MISSION + GOAL.format(5), "--flights", "0")
    page = explained(capsys, "--flights", "0")
    assert re.search(r"Motor\.Run#\d+\.end <= Survey\.Transect#\d+\.start, by `run\.end == start`", page)
    assert re.search(r"Survey\.Transect#\d+\.start <= Motor\.Run#\d+\.start\n", page), "contains is no equality"


def test_what_rules_a_plan_out_is_told_before_what_was_tried_in_vain(tmp_path: Path, capsys: Page) -> None:
    checked(tmp_path, capsys, MODEL, MISSION + GOAL.format(5), "--flights", "0")
    page = explained(capsys, "--flights", "0")
    lines = [number for number in (9, 10, 13, 14) if f"--> planner.nddl:{number}\n" in page]
    assert lines
    assert all(page.index(f"--> planner.nddl:{number}\n") < page.index("tried in vain") for number in lines)


AGAINST = MODEL.replace("run);", "run);\n    run.end <= start;").replace("RUN_MAX = 12", "RUN_MAX = 60")


def test_a_line_that_lint_warns_of_is_tried_first_and_says_so(tmp_path: Path, capsys: Page) -> None:
    told = checked(tmp_path, capsys, AGAINST, MISSION + GOAL.format(5))
    assert "[NDDL530]" in told[: told.index("failed (run")]
    cause = told[told.index("   cause: ") :]
    said = " ".join(cause.split())
    assert "lint says of this line: " in said[: said.index(" tried in ")]
    assert re.search(r"--> planner\.nddl:1[23]\n", cause)


MANY = """#include "TREX.nddl"
class Survey extends AgentTimeline {
    predicate Idle { } predicate Transect { }
    Survey(Mode m) { super(m, "Idle"); }
}
class Side extends AgentTimeline { predicate Turn { } Side(Mode m) { super(m, "Turn"); } }
Survey::Transect {
    contains(Side.Turn one);
    contains(Side.Turn two);
    contains(Side.Turn three);
    one before two;
    two before three;
    duration <= 2;
}
Survey survey = new Survey(Internal);
Side motor = new Side(Internal);
close();
"""


def test_what_no_line_says_of_many_tokens_is_told_once(tmp_path: Path, capsys: Page) -> None:
    checked(tmp_path, capsys, MANY, MISSION + GOAL.format(5), "--flights", "0")
    page = explained(capsys, "--flights", "0")
    assert len(re.findall(r"Side\.Turn#\d+\.duration >= 1", page)) == 1
    assert re.search(r"Side\.Turn#\d+\.duration >= 1, and so of 2 more tokens\n", page)


RAISING = """from runtime.user.reactor import Now, Reactor


class Gauge(Reactor):
    def tick(self, now: Now) -> None:
        now.publish("level", "Full", by=now.tick)
        now.wake(now.tick + 1)
        assert now.tick < 7, "dry"
"""
GAUGED = (
    MODEL.replace("RUN_MAX = 12", "RUN_MAX = 60")
    .replace(
        "Survey survey",
        "class Level extends AgentTimeline { predicate Full { int by; } Level(Mode m) { super(m, Full); } }\n"
        "Level level = new Level(External);\nLevel::Full { by <= 4; 0 <= by; }\nSurvey survey",
    )
    .replace("super(m, Full)", 'super(m, "Full")')
)
CODED = """
[[reactor]]
name = "gauge"
code = "gauge.py:Gauge"
internal = ["level"]
"""


def gauged(mission: str) -> str:
    return mission.replace("lookahead = 60\n", 'lookahead = 60\nexternal = ["level"]\n') + CODED


def test_a_line_of_python_that_raised_is_the_place_and_no_line_is_said_to_be_missing(
    tmp_path: Path, capsys: Page
) -> None:
    (tmp_path / "gauge.py").write_text(RAISING)
    model = GAUGED.replace("by <= 4;", "")
    told = checked(tmp_path, capsys, model, gauged(MISSION) + GOAL.format(5), "--trust")
    assert "perhaps a line is missing" not in told
    assert "`gauge` failed here; its Python was not changed" in " ".join(told.split())
    assert '--> gauge.py:8\n    8 |         assert now.tick < 7, "dry"' in told
    page = explained(capsys, "--trust")
    assert "   1  `gauge` failed here" in page
    assert re.search(r"gauge gives up .*<== where it breaks, cause 1\n +--> gauge\.py:8\n", page)


def test_where_python_published_what_failed_it_is_said_that_none_of_it_was_changed(
    tmp_path: Path, capsys: Page
) -> None:
    (tmp_path / "gauge.py").write_text(RAISING.replace('        assert now.tick < 7, "dry"\n', ""))
    checked(tmp_path, capsys, GAUGED, gauged(MISSION) + GOAL.format(5), "--trust")
    page = explained(capsys, "--trust")
    assert "what happened goes through `gauge`, which is Python (gauge.py): none of its lines was changed" in page


def test_where_nothing_helps_it_is_said_all_the_same_that_no_python_was_changed() -> None:
    judgement = Judgement(Verdict.FAIL, "P1", broken=PropertyFate("soon", is_kept=False, tick=9, margin=-1.0))
    (bucket,) = group_failures((MissionResult(1, 1, judgement, Outcome(1, 9, 9, None, (), (), ()), True),))
    fault = Fault(bucket, None, None, Causes((), 3, 40))
    coded = (CodeConfiguration("gauge", "gauge.py", "Gauge"),)
    page = page_text(Story(1, 1, judgement, (), 9, 9, (), fault, coded=coded), None, "run", Excerpts(Path()))
    assert "none of the changes tried makes it pass" in page
    assert "which is Python (gauge.py): none of its lines was changed" in page
