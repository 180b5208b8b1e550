"""A project with constraints of its own, as a user of the command line meets it."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from checker.batch import engine
from checker.batch.engine import engine_digest
from checker.batch.identity import model_digest
from checker.campaign import Campaign
from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import pinned
from nddlc.main import run
from tests.user_constraints.own import TWICE, written

pytestmark = pytest.mark.once

Captured = pytest.CaptureFixture[str]
BATHYMETRY = Path(__file__).parents[2] / "models" / "bathymetry"
BOOM = TWICE.replace("        return (\n", "        assert view.upper(1) < 10, 'too much'\n        return (\n")


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    written(tmp_path, TWICE)
    (tmp_path / "nddlc.toml").write_text('[constraints]\nmodules = ["own.py"]\n', encoding="utf-8")
    (tmp_path / "model.nddl").write_text("int x = [1 10];\nint y = [0 13];\ntwice(y, x);\n", encoding="utf-8")
    return tmp_path


@pytest.fixture
def mission(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    shutil.copytree(BATHYMETRY, tmp_path / "sea")
    return tmp_path / "sea" / "mission.toml"


def check(path: Path, *options: str) -> int:
    return run(["check", str(path), "--no-store", "--missions", "12", *options])


def test_load_lint_and_plan_know_it(project: Path, capsys: Captured) -> None:
    assert run(["load", "--json", "model.nddl"]) == 0
    assert json.loads(capsys.readouterr().out)["domains"] == {"x": "[1, 6] int", "y": "[2, 12] int"}
    assert run(["lint", "model.nddl"]) == 0
    capsys.readouterr()
    (project / "model.nddl").write_text("int x = [1 10];\ntwice(7, x);\n", encoding="utf-8")
    assert run(["plan", "--explain", "model.nddl"]) == 1
    assert "model.nddl:2: `twice(7, x);`: twice(7, x)" in capsys.readouterr().out


def test_pyproject_serves_as_well(project: Path) -> None:
    (project / "nddlc.toml").rename(project / "pyproject.toml")
    text = '[tool.nddlc.constraints]\nmodules = ["own.py"]\n'
    (project / "pyproject.toml").write_text(text, encoding="utf-8")
    sub = project / "below"
    sub.mkdir()
    shutil.move(project / "model.nddl", sub / "model.nddl")
    assert run(["load", "below/model.nddl"]) == 0


def test_a_module_that_is_not_there_is_a_mistake_of_the_configuration(project: Path, capsys: Captured) -> None:
    sub = project / "sub"
    sub.mkdir()
    (sub / "nddlc.toml").write_text('[constraints]\nmodules = ["owm.py"]\n', encoding="utf-8")
    shutil.move(project / "model.nddl", sub / "model.nddl")
    assert run(["load", "sub/model.nddl"]) == 2
    assert "`owm.py` must be a Python file, seen from this file" in capsys.readouterr().err


@pytest.mark.parametrize("form", ["0", "1"])
def test_an_exception_is_told_with_its_line_in_both_forms(form: str, project: Path) -> None:
    written(project, BOOM)
    words = [sys.executable, "-m", "nddlc.main", "load", "model.nddl"]
    paths = {"PYTHONPATH": str(Path(__file__).parents[2])}
    environment = os.environ | paths | ({"NDDLC_INTERPRETED": "1"} if form == "1" else {})
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert (
        "own.py:10: `propagate` of the constraint `twice`, called at model.nddl:3, failed: AssertionError: too much"
        in done.stderr
    )
    assert "bug" not in done.stderr


def test_the_example_flies_alike_with_any_number_of_workers(mission: Path, capsys: Captured) -> None:
    assert check(mission, "--workers", "1", "--format", "json") == 0
    alone = capsys.readouterr().out
    assert check(mission, "--workers", "2", "--format", "json") == 0
    assert capsys.readouterr().out == alone


def test_a_failure_is_explained_through_the_constraint(mission: Path, capsys: Captured) -> None:
    planner = mission.with_name("planner.nddl")
    planner.write_text(
        planner.read_text(encoding="utf-8").replace("CLEARANCE = 8.0", "CLEARANCE = 2.0"), encoding="utf-8"
    )
    assert run(["check", str(mission), "--missions", "12", "--workers", "1"]) == 1
    assert "fails when DRIFT <= -5.6" in capsys.readouterr().out
    assert run(["explain"]) == 0
    assert "water == chart_depth(place, y);" in capsys.readouterr().out


def test_code_that_fails_in_flight_makes_errors_not_failures(mission: Path, capsys: Captured) -> None:
    chart = mission.with_name("chart.py")
    text = chart.read_text(encoding="utf-8")
    line = "            return view.fix(0,"
    chart.write_text(text.replace(line, f"            raise RuntimeError('no ink')\n{line}"), encoding="utf-8")
    assert check(mission, "--workers", "1", "--missions", "2") == 2
    told = capsys.readouterr().out
    assert "chart.py" in told and "planner.nddl:18, failed: RuntimeError: no ink" in told
    assert "2 not flown to the end because of an error in a constraint of the project" in told


def test_a_module_that_cannot_be_loaded_ends_the_check(mission: Path, capsys: Captured) -> None:
    mission.with_name("chart.py").write_text("raise ValueError('torn')\n", encoding="utf-8")
    assert check(mission) == 2
    assert "chart.py:1: the module cannot be loaded: ValueError: torn" in capsys.readouterr().err


def test_the_identity_of_a_run_depends_on_module_and_data(mission: Path) -> None:
    def named() -> str:
        read, _ = read_mission(mission)
        assert read is not None
        models = load_models(read)
        return Campaign(read, models, pinned(models)).run.id

    first = named()
    assert named() == first
    chart = mission.with_name("chart.csv")
    chart.write_text(chart.read_text(encoding="utf-8").replace("62", "63"), encoding="utf-8")
    second = named()
    module = mission.with_name("chart.py")
    module.write_text(module.read_text(encoding="utf-8") + "# more\n", encoding="utf-8")
    assert len({first, second, named()}) == 3
    assert model_digest({}) != model_digest({"chart.py": ""})


def test_the_identity_of_a_run_depends_on_the_engine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = engine_digest()
    for folder in engine.ENGINE:
        shutil.copytree(engine.ROOT / folder, tmp_path / folder, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    monkeypatch.setattr(engine, "ROOT", tmp_path)
    engine_digest.cache_clear()
    assert engine_digest() == before
    with (tmp_path / "runtime" / "solver" / "search.py").open("a", encoding="utf-8") as file:
        file.write("# another\n")
    engine_digest.cache_clear()
    assert engine_digest() != before
    engine_digest.cache_clear()


def test_a_mission_names_a_missing_module_with_its_place(mission: Path, capsys: Captured) -> None:
    mission.write_text(mission.read_text(encoding="utf-8").replace('"chart.py"', '"chrat.py"'), encoding="utf-8")
    assert check(mission) == 2
    told = capsys.readouterr().out
    assert "there is no file `chrat.py`" in told
    assert "chart.py" in told


@pytest.mark.parametrize("swallows", [False, True])
def test_code_that_does_not_come_back_in_flight_makes_errors(swallows: bool, mission: Path, capsys: Captured) -> None:
    chart = mission.with_name("chart.py")
    text = chart.read_text(encoding="utf-8")
    line = "            return view.fix(0,"
    deaf = "            __import__('signal').signal(14, lambda *_: None)\n" if swallows else ""
    chart.write_text(text.replace(line, f"{deaf}            while True: pass\n{line}"), encoding="utf-8")
    toml = mission.read_text(encoding="utf-8")
    mission.write_text(toml.replace("modules =", "time_limit = 0.5\nmodules ="), encoding="utf-8")
    assert check(mission, "--workers", "1", "--missions", "2") == 2
    told = capsys.readouterr().out
    assert told.count("did not come back within 0.5 s and was stopped; `time_limit = 1` under [constraints]") == 2
    assert "2 not flown to the end because of an error in a constraint of the project" in told


def test_a_mission_that_ended_in_an_error_is_flown_again(mission: Path, capsys: Captured) -> None:
    chart = mission.with_name("chart.py")
    text = chart.read_text(encoding="utf-8")
    line = "            return view.fix(0,"
    fragile = f"            if not Path('mended').exists(): raise RuntimeError\n{line}"
    chart.write_text(text.replace(line, fragile), encoding="utf-8")
    assert run(["check", str(mission), "--missions", "3", "--workers", "1"]) == 2
    Path("mended").touch()
    assert run(["check", str(mission), "--missions", "3", "--workers", "1", "--resume"]) == 0
    assert "3 missions, 0 failed (run " in capsys.readouterr().out
