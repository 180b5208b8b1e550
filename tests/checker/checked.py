"""A small mission as text, checked as a user would; out come the faults of its report."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from nddlc.main import run


def faults_of(folder: Path, capsys: pytest.CaptureFixture[str], files: Mapping[str, str]) -> list[dict[str, Any]]:
    """Write `files` into `folder`, check its `mission.toml` on one worker, and read what failed."""
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    report = folder / "report"
    run(["check", str(folder / "mission.toml"), "--no-store", "--workers", "1", "--output", str(report)])
    capsys.readouterr()
    found: list[dict[str, Any]] = json.loads((report / "report.json").read_text(encoding="utf-8"))["faults"]
    return found
