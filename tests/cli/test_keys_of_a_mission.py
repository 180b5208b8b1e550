"""One wrong key of a mission file is told once, whichever it is and whatever hangs on it."""

import json
import re
import shutil
from pathlib import Path

import pytest

from nddlc.main import run

ROOT = Path(__file__).parents[2] / "models"
PROJECTS = ("gps", "templates/deadline", "templates/lookout", "templates/noise")
Captured = pytest.CaptureFixture[str]
_KEY = re.compile(r"(\w\w+)( = .*)")
_DECIDING = ("code", "mode")  # without these other keys of the table are wrong too
_HEADER = re.compile(r"(\[+[\w.]+)(\w)(\]+)")


def slips(lines: list[str]) -> list[tuple[int, str]]:
    """Lines as they come out with two letters changed round, another word for the key, or a letter less in a header."""
    found = []
    text = "\n".join(lines)
    for number, line in enumerate(lines):
        if "[reactor.settings]" in lines[max(0, number - 2) : number]:
            continue  # these belong to the reactor
        if key := _KEY.fullmatch(line.split("  #")[0]):
            name, rest = key.groups()
            found.append((number, f"{name[:-2]}{name[-1]}{name[-2]}{rest}"))
            if name not in _DECIDING:
                found.append((number, f"frobnicate{rest}"))
        elif (header := _HEADER.fullmatch(line)) and f"[{line.strip('[]')}." not in text and "." not in line:
            found.append((number, header[1] + header[3]))
    return [each for each in found if each[1] != lines[each[0]]]


@pytest.mark.parametrize("project", PROJECTS)
def test_one_wrong_key_is_told_once(
    project: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    for path in (ROOT / project).glob("*.*"):
        shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    lines = (tmp_path / "mission.toml").read_text(encoding="utf-8").split("\n")
    wrong = slips(lines)
    assert len(wrong) > 30
    for number, line in wrong:
        text = "\n".join([*lines[:number], line, *lines[number + 1 :]])
        (tmp_path / "mission.toml").write_text(text, encoding="utf-8")
        run(["lint", "--format", "json", "mission.toml"])
        told = json.loads(capsys.readouterr().out)["diagnostics"]
        assert len(told) == 1 and told[0]["line"] in (number + 1, number), (line, told)


@pytest.mark.parametrize(
    ("header", "typed"),
    [
        ("[parameters.TRIM]", "[parameter.TRIM]"),
        ("[parameters.TRIM]", "[Parameters.TRIM]"),
        ("[parameters.TRIM]", '[parameter."TRIM"]'),
        ("[goal.parameters]", "[goal.parameter]"),
    ],
)
def test_a_misspelt_word_of_a_header_is_mended_alone(
    header: str, typed: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    shutil.copytree(ROOT / "templates" / "noise", tmp_path, dirs_exist_ok=True)
    path = tmp_path / "mission.toml"
    text = path.read_text(encoding="utf-8")
    assert header in text
    path.write_text(text.replace(header, typed, 1), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert run(["lint", "--fix", "mission.toml"]) == 0, capsys.readouterr().out
    mended = path.read_text(encoding="utf-8")
    assert mended == text or mended == text.replace(header, '[parameters."TRIM"]')
