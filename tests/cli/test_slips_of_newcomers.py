"""Each slip in a newcomer's model is told once beside what the model has anyhow, in its line, with what helps."""

import json
import shutil
from functools import cache
from pathlib import Path

import pytest

from nddlc.main import run
from tests.cli.habits import Mistake
from tests.cli.slips_of_newcomers import SLIPS_OF_NEWCOMERS

MODELS = Path(__file__).parents[1] / "checker" / "unseen"
Captured = pytest.CaptureFixture[str]
_TOLD_ANYHOW: dict[str, frozenset[tuple[str, str, str]]] = {}


@cache
def _files(model: str) -> tuple[Path, ...]:
    return tuple(path for path in (MODELS / model).iterdir() if path.suffix in (".nddl", ".py", ".toml"))


def _told(capsys: Captured) -> list[dict[str, str]]:
    run(["lint", "--format", "json", "mission.toml", "."])
    found: list[dict[str, str]] = json.loads(capsys.readouterr().out)["diagnostics"]
    return found


def _key(one: dict[str, str]) -> tuple[str, str, str]:
    return Path(one["file"]).name, one["code"], one["message"]


@pytest.mark.parametrize("slip", SLIPS_OF_NEWCOMERS, ids=lambda each: f"{each.file}: {each.wrong[:40]}")
def test_a_slip_is_told_once_in_its_line_with_help(
    slip: Mistake, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    model, _, file = slip.file.partition("/")
    for path in _files(model):
        if path.name not in ("faults.toml", "hand.toml"):
            shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    if model not in _TOLD_ANYHOW:
        _TOLD_ANYHOW[model] = frozenset(map(_key, _told(capsys)))
    text = (tmp_path / file).read_text(encoding="utf-8")
    assert slip.right in text
    text = text.replace(slip.right, slip.wrong, 1)
    (tmp_path / file).write_text(text, encoding="utf-8")
    (one,) = [each for each in _told(capsys) if _key(each) not in _TOLD_ANYHOW[model]]
    assert Path(one["file"]).name == file
    assert (slip.told or slip.wrong.split("\n")[0]) in text.split("\n")[int(one["line"]) - 1]
    assert slip.help in json.dumps(one, ensure_ascii=False).replace('\\"', '"')
