"""Single mistakes in a solver's configuration, a batch file and a command line: each is told once, with help."""

import shutil
from pathlib import Path

import pytest

from nddlc.main import run

ROOT = Path(__file__).parents[2] / "models"
FILTERS = """
[[manager.filter]]
variable = "start"
[[manager.filter]]
variable = "duration"
"""
UNBOUND = 'component = "UnboundVariableManager"\n'
SOLVER = (ROOT / "templates" / "battery" / "planner.toml").read_text().replace(UNBOUND, UNBOUND + FILTERS)
BATCH = """<Batch>
  <SampledParameter name="CURRENT" component="UniformRandom">
    <BatchSampler component="UniformRandDouble">
      <Seed>5</Seed>
      <Min>-0.3</Min>
      <Max>0.3</Max>
    </BatchSampler>
  </SampledParameter>
</Batch>
"""
Captured = pytest.CaptureFixture[str]


@pytest.mark.parametrize(
    ("right", "wrong", "told"),
    [
        ('"ResourceThreatManager"', '"ResourceManager"', "did you mean `ResourceThreatManager`?"),
        ('"UnboundVariableManager"', "UnboundVariableManager", "a text stands in quotes"),
        ('component = "ThreatManager"', 'componant = "ThreatManager"', "did you mean `component`?"),
        ('"ThreatManager"', '"ThreatManager"\npriority = 1', "did you mean `default_priority`?"),
        ('"ThreatManager"', '"ThreatManager"\ndefault_priority = "high"', "a whole number"),
        ('[[manager.filter]]\nvariable = "start"', '[manager.filter]\nvariable = "start"', "[[manager.filter]]"),
        ('variable = "duration"', 'variables = "duration"', "did you mean `variable`?"),
        (
            '"OpenConditionManager"',
            '"OpenConditionManager"\n[[manager.handler]]\ncomponent = "Min"',
            "`StandardOpenConditionHandler`",
        ),
    ],
)
def test_a_mistake_in_the_configuration_of_a_solver_is_told_once(
    right: str, wrong: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    for path in (ROOT / "templates" / "battery").iterdir():
        shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    changed = SOLVER.replace(right, wrong, 1)
    assert changed != SOLVER
    (tmp_path / "planner.toml").write_text(changed)
    for asked in ("mission.toml", "planner.toml"):  # the mission that names it, and itself
        assert run(["lint", asked]) == 1
        said = capsys.readouterr().out
        assert said.count("[NDDL") == 1 and told in said and "planner.toml:" in said


def test_no_mission_is_flown_with_a_solver_that_was_not_understood(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    for path in (ROOT / "templates" / "battery").iterdir():
        shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "planner.toml").write_text(SOLVER.replace('"ResourceThreatManager"', '"ResourceManager"', 1))
    for line in (["check", "--dry-run"], ["run"], ["check", "--missions", "1", "--no-store"]):
        assert run([*line, "mission.toml"]) == 2
        assert "no flaw manager is called `ResourceManager`" in "".join(capsys.readouterr())


@pytest.mark.parametrize(
    ("right", "wrong", "line", "told"),
    [
        ("<Min>-0.3</Min>", "<Min>minus 0.3</Min>", 5, "a number, such as 0.5"),
        ("<Min>-0.3</Min>", "<Min>-1e30</Min>", 5, "below 2^51 in size"),
        ("<Min>-0.3</Min>\n      <Max>0.3", "<Min>0.3</Min>\n      <Max>-0.3", 5, "exchange them"),
        ("<Max>0.3</Max>", "<Max>0.3<Max>", 6, "it ends with `</Max>`"),
        ("<Max>0.3</Max>", "", 3, "`Max` is missing"),
        ("<Seed>5</Seed>", "<Sead>5</Sead>", 4, "did you mean `Seed`?"),
        ("<SampledParameter name", "<SampleParameter name", 2, "`<SampledParameter>`"),
        ("<Seed>5</Seed>", "<Seed>5.5</Seed>", 4, "a whole number"),
    ],
)
def test_a_mistake_in_a_batch_file_is_told_once(
    right: str, wrong: str, line: int, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "b.xml").write_text(BATCH.replace(right, wrong, 1))
    assert run(["convert", "b.xml"]) == 2
    said = "".join(capsys.readouterr())
    assert said.count("error[") == 1 and f"b.xml:{line}:" in said and told in said


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("fmt mission.toml", "models end in .nddl"),
        ("load mission.toml", "models end in .nddl"),
        ("validate mission.tml", "did you mean `mission.toml`?"),
        ("rule 201", "did you mean `NDDL201`?"),
        ("plan --horizon 0 mission.toml", "it takes two, LO and HI"),
    ],
)
def test_a_mistake_in_a_command_line_is_told_with_help(
    line: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    for path in (ROOT / "gps").iterdir():
        shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    assert run(line.split()) == 2
    assert told in capsys.readouterr().err
