"""The batch seed is given or automatic, and a batch can be flown again from its report (trex 4 row 23)."""

import json
from pathlib import Path
from typing import Any

import pytest

from nddlc.main import run

GPS = str(Path(__file__).resolve().parents[2] / "models/gps/mission.toml")


def checked(folder: Path, seed: str) -> dict[str, Any]:
    options = ["--no-store", "--workers", "1", "--missions", "6", "--flights", "0", "--max-failure-rate", "1"]
    assert run(["check", GPS, "--seed", seed, "--output", str(folder), *options]) == 0
    found: dict[str, Any] = json.loads((folder / "report.json").read_text())
    return found


@pytest.mark.once
def test_an_automatic_seed_stands_in_the_report_and_gives_the_same_missions_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    first, second = checked(tmp_path / "a", "auto"), checked(tmp_path / "b", "auto")
    assert first["seed"] != second["seed"]
    assert f"seed {first['seed']}" in capsys.readouterr().out
    again = checked(tmp_path / "c", str(first["seed"]))
    assert again == first
    assert len({one["seed"] for one in first["missions"]}) == 6


@pytest.mark.parametrize("text", ["aut", "-1", "1.5", str(1 << 60), ""])
def test_what_is_no_seed_is_told(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check", GPS, "--seed", text, "--dry-run"]) == 2
    assert "nor `auto`" in capsys.readouterr().err
