"""What `nddlc plan --json` prints is judged by `nddlc validate`: right plans hold, altered ones do not."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from nddlc.main import run

ROOT = Path(__file__).resolve().parents[3]
Captured = pytest.CaptureFixture[str]


def printed(model: str, folder: Path, capsys: Captured, *options: str) -> Any:
    assert run(["plan", str(folder / model), "--json", *options]) == 0
    return json.loads(capsys.readouterr().out)


def judged(data: Any, folder: Path) -> int:
    (folder / "plan.json").write_text(json.dumps(data), encoding="utf-8")
    return run(["validate", str(folder / "plan.json")])


def classic(name: str, folder: Path) -> Path:
    shutil.copy(ROOT / "models" / "classic" / name, folder)
    return folder


@pytest.mark.parametrize("model", ["jobshop.nddl", "lamp.nddl", "rover.nddl", "shopping.nddl"])
def test_a_plan_that_was_found_holds(model: str, tmp_path: Path, capsys: Captured) -> None:
    data = printed(model, classic(model, tmp_path), capsys)
    assert judged(data, tmp_path) == 0
    assert "0 disagreements" in capsys.readouterr().out


def test_the_plan_of_a_mission_holds(tmp_path: Path, capsys: Captured) -> None:
    shutil.copytree(ROOT / "tests" / "checker" / "unseen" / "crane", tmp_path, dirs_exist_ok=True)
    assert judged(printed("mission.toml", tmp_path, capsys), tmp_path) == 0


def test_the_plan_of_a_planner_that_was_named_holds(tmp_path: Path, capsys: Captured) -> None:
    shutil.copytree(ROOT / "tests" / "checker" / "unseen" / "crane", tmp_path, dirs_exist_ok=True)
    data = printed("mission.toml", tmp_path, capsys, "--reactor", "foreman")
    assert data["reactor"] == "foreman"
    assert judged(data, tmp_path) == 0


def _token(data: Any, name: str) -> Any:
    return next(each for each in data["tokens"] if each["id"] == name)


def _later(data: Any) -> None:
    _token(data, "Rover.Going#2").update(start=[100, 100], end=[106, 106])


def _elsewhere(data: Any) -> None:
    _token(data, "Rover.At#1")["params"]["place"] = "{crater} Place"


def _without_a_child(data: Any) -> None:
    data["tokens"] = [each for each in data["tokens"] if each["id"] not in ("Battery.consume#1", "Battery.consume#2")]


def _too_long(data: Any) -> None:
    _token(data, "first").update(duration=[4, 4])


@pytest.mark.parametrize("alter", [_later, _elsewhere, _without_a_child, _too_long])
def test_an_altered_plan_breaks_its_model(alter: Callable[[Any], None], tmp_path: Path, capsys: Captured) -> None:
    data = printed("rover.nddl", classic("rover.nddl", tmp_path), capsys)
    alter(data)
    assert judged(data, tmp_path) == 1


def test_where_no_plan_was_found_that_is_said(tmp_path: Path, capsys: Captured) -> None:
    (tmp_path / "m.nddl").write_text(
        "class T extends Timeline { predicate P { } }\nT t = new T();\nclose();\n"
        "goal(T.P a); goal(T.P b); a.start == 0; b.start == 1; a.end == 5; b.end == 6;\n",
        encoding="utf-8",
    )
    assert run(["plan", str(tmp_path / "m.nddl"), "--json"]) == 1
    data = json.loads(capsys.readouterr().out)
    assert judged(data, tmp_path) == 2
    assert "there is no plan in it" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("tokens", 3, "`tokens` is no list"),
        ("domains", [], "`domains` is no object"),
        ("solve", None, "there is no plan"),
        ("file", "other.nddl", "there is no model"),
    ],
)
def test_what_is_not_of_the_form_is_said(name: str, value: Any, said: str, tmp_path: Path, capsys: Captured) -> None:
    data = printed("lamp.nddl", classic("lamp.nddl", tmp_path), capsys)
    data[name] = value
    assert judged(data, tmp_path) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize("text", ["lamp", "{} Lamp", "[1] int", "[a, b] int", "{x} int", 7])
def test_a_domain_that_is_none_is_said(text: Any, tmp_path: Path, capsys: Captured) -> None:
    data = printed("lamp.nddl", classic("lamp.nddl", tmp_path), capsys)
    data["tokens"][0]["object"] = text
    assert judged(data, tmp_path) == 2
    assert "domain" in capsys.readouterr().err or "empty" in capsys.readouterr().err or text == "{} Lamp"
