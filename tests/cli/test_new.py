"""`nddlc new`: what it writes lints clean, is in the one style, flies, and is found by commands without a path."""

from pathlib import Path

import pytest

from nddlc.main import run
from nddlc.new import TEMPLATES

pytestmark = pytest.mark.once

Captured = pytest.CaptureFixture[str]


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("template", TEMPLATES)
def test_a_new_project_is_in_order(template: str, monkeypatch: pytest.MonkeyPatch, capsys: Captured) -> None:
    assert run(["new", "mine", "--template", template]) == 0
    monkeypatch.chdir("mine")
    models = [str(path) for path in sorted(Path().glob("*.nddl"))]
    assert run(["lint", "mission.toml", "."]) == 0
    assert run(["fmt", "--check", *models]) == 0
    assert 'name = "mine"' in Path("mission.toml").read_text()
    assert Path("README.md").read_text().startswith("# mine\n")
    capsys.readouterr()
    code = run(["check", "--missions", "40", "--workers", "1"])
    said = capsys.readouterr().out
    assert "mine: 40 missions" in said
    assert code == (1 if template == "survey" else 0), said


def test_check_finds_the_only_mission_below(capsys: Captured) -> None:
    assert run(["new", "survey"]) == 0
    assert run(["check", "--missions", "20", "--workers", "1"]) == 1
    assert "LEG_MAX = 300;" in capsys.readouterr().out
    assert run(["new", "rover"]) == 0
    capsys.readouterr()
    assert run(["check"]) == 2
    assert "name one: `rover/mission.toml`, `survey/mission.toml`" in capsys.readouterr().err


def test_without_a_mission_there_is_advice(capsys: Captured) -> None:
    assert run(["check"]) == 2
    assert "nddlc new NAME" in capsys.readouterr().err


def test_nothing_is_written_over(capsys: Captured) -> None:
    Path("survey").mkdir()
    Path("survey/README.md").write_text("mine")
    assert run(["new", "survey"]) == 2
    assert "`survey/README.md` exists already" in capsys.readouterr().err
    assert [path.name for path in Path("survey").iterdir()] == ["README.md"]


@pytest.mark.parametrize("name", ["", "9x", "a b", "-", ".."])
def test_a_name_must_be_one(name: str, capsys: Captured) -> None:
    assert run(["new", "--", name]) == 2
    assert "is no name for a project" in capsys.readouterr().err


def test_a_folder_that_cannot_be_made_is_told(capsys: Captured) -> None:
    Path("file").write_text("")
    assert run(["new", "file/mine"]) == 2
    assert "cannot make" in capsys.readouterr().err


def test_a_template_in_front_of_the_name_is_told_how_it_is_asked_for(capsys: Captured) -> None:
    assert run(["new", "survey", "boat"]) == 2
    assert "nddlc new boat --template survey" in capsys.readouterr().err
    assert not Path("survey").exists()
