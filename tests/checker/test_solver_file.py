"""A solver's configuration is held against the models of the missions that name it, from the command and the editor."""

import re
from pathlib import Path

import pytest

from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Source
from nddlc.editor import examine_for_editor
from nddlc.main import run

MODEL = """\
class Rover extends Timeline { predicate Idle { } predicate Go { float speed; } }
Rover::Go { duration <= 5; speed <= 3.0; }
Rover rover = new Rover();
close();
"""
MISSION = """\
[mission]
name = "a"
final_tick = 9
[[reactor]]
name = "a"
model = "{model}"
solver = "planner.toml"
internal = ["rover"]
"""
SOLVER = """\
[[manager]]
component = "OpenConditionManager"
[[manager]]
component = "UnboundVariableManager"
[[manager.handler]]
component = "ValEnum"
class = "{class_name}"
predicate = "{predicate}"
variable = "{variable}"
values = [1.0]
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "rover.nddl").write_text(MODEL)
    (tmp_path / "a.toml").write_text(MISSION.format(model="rover.nddl"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def solver(class_name: str = "Rover", predicate: str = "Go", variable: str = "speed") -> str:
    return SOLVER.format(class_name=class_name, predicate=predicate, variable=variable)


def in_editor(folder: Path, text: str) -> list[Diagnostic]:
    return list(examine_for_editor(Source(str(folder / "planner.toml"), text), folder, is_trusted=False))


@pytest.mark.parametrize(("field", "wrong"), [("class_name", "Rovr"), ("predicate", "Goo"), ("variable", "sped")])
def test_a_name_that_no_model_has_is_told_with_its_fix(
    folder: Path, capsys: pytest.CaptureFixture[str], field: str, wrong: str
) -> None:
    text = solver(**{field: wrong})
    (folder / "planner.toml").write_text(text)
    told = {}
    for words in (["planner.toml"], ["."], ["a.toml"]):
        assert run(["lint", *words]) == 1
        shown = capsys.readouterr().out
        (message,) = re.findall(r"^warning\[NDDL738\]: (.*)$", shown, re.MULTILINE)
        told[words[0]] = message
    assert len(set(told.values())) == 1
    (found,) = in_editor(folder, text)
    (fix,) = found.fixes
    (edit,) = fix.edits
    assert (found.message, edit.span.text) == (told["."], wrong)
    assert text[: edit.span.begin] + edit.text + text[edit.span.finish :] == solver()
    assert in_editor(folder, solver()) == []
    assert run(["lint", ".", "--unsafe-fixes"]) == 0
    assert (folder / "planner.toml").read_text() == solver()


def test_what_one_of_two_missions_can_match_is_right(folder: Path) -> None:
    (folder / "crane.nddl").write_text(MODEL.replace("Go", "Lift"))
    (folder / "b.toml").write_text(MISSION.format(model="crane.nddl"))
    (folder / "planner.toml").write_text(solver())
    assert in_editor(folder, solver()) == in_editor(folder, solver(predicate="Lift")) == []
    assert [each.code.id for each in in_editor(folder, solver(predicate="Lft"))] == ["NDDL738"]


def test_a_solver_that_no_mission_names_is_judged_by_itself(folder: Path) -> None:
    (folder / "a.toml").write_text(MISSION.format(model="missing.nddl"))
    assert in_editor(folder, solver(predicate="Goo")) == []
    (folder / "a.toml").write_text("[mission]\nno toml")
    assert in_editor(folder, solver(predicate="Goo")) == []
    assert [each.code.id for each in in_editor(folder, solver().replace("ValEnum", "ValEnm"))] == ["NDDL755"]


def test_python_that_a_mission_names_is_not_run_for_its_solver(folder: Path) -> None:
    (folder / "mine.py").write_text(f"open({str(folder / 'mark')!r}, 'w').close()\n")
    named = MISSION.format(model="rover.nddl") + '[constraints]\nmodules = ["mine.py"]\n'
    (folder / "a.toml").write_text(named)
    assert in_editor(folder, solver(predicate="Goo")) == []
    assert not (folder / "mark").exists()


ORDERED = """\
[[manager]]
component = "{}"
default_priority = {}
[[manager]]
component = "{}"
default_priority = {}
[[manager]]
component = "{}"
default_priority = {}
"""
RESOURCES, TOKENS, CONDITIONS = "ResourceThreatManager", "ThreatManager", "OpenConditionManager"


@pytest.mark.parametrize(
    ("managers", "behind"),
    [
        ((RESOURCES, 0, TOKENS, 0, CONDITIONS, 0), "`ThreatManager` and `OpenConditionManager`"),
        ((TOKENS, 0, RESOURCES, 0, CONDITIONS, 0), "`OpenConditionManager`"),
        ((TOKENS, 0, CONDITIONS, 0, RESOURCES, 0), ""),
        ((RESOURCES, 5, TOKENS, 0, CONDITIONS, 0), ""),
        ((TOKENS, 5, CONDITIONS, 0, RESOURCES, 2), "`ThreatManager`"),
    ],
)
def test_resources_that_are_ordered_before_tokens_are_told(
    folder: Path, managers: tuple[str | int, ...], behind: str
) -> None:
    text = ORDERED.format(*managers)
    (folder / "planner.toml").write_text(text)
    assert in_editor(folder, text) == []  # its models have no resources
    power = "class Power extends Reusable { Power() { super(5.0, 0.0); } }\nPower power = new Power();\nclose();\n"
    (folder / "rover.nddl").write_text(MODEL.replace("close();\n", power))
    found = in_editor(folder, text)
    assert [each.code.id for each in found] == ["NDDL739"] * bool(behind)
    for each in found:
        assert each.help is not None and f"put it behind {behind};" in each.help
        assert each.span.text == f'component = "{RESOURCES}"'
