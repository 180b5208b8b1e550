"""The whole way with the real agent: models/gps fails for its one fault, and does not once that is mended."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from nddlc.main import run

pytestmark = pytest.mark.slow

GPS = Path("models/gps").resolve()
MISSIONS = "20"  # mission 16 is the first to fail


@pytest.fixture
def workshop(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """An empty folder to work in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.once
def test_the_fault_is_found_and_explained(workshop: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check", str(GPS / "mission.toml"), "--missions", MISSIONS]) == 1
    text = capsys.readouterr().out
    assert re.search(r"navigator\.nddl:5\n +5 \| SURFACE_MAX = 64;", text)
    assert re.search(r"rules\.nddl:34 \(where it breaks\)\n +34 \| +duration <= SURFACE_MAX;", text)
    assert re.search(r"fails when GPS_HIT_RATE >=? 3\.8", text)
    assert "z3 confirms the conflict" in text
    assert run(["explain", "latest"]) == 0
    story = capsys.readouterr().out
    chain = [
        "sampledParameter(GPS_HIT_RATE)",
        "gpsHitRate * minHits",
        "gps = Active",
        "<== where it breaks",
        "gives up",
    ]
    places = [story.find(words) for words in chain]
    assert -1 not in places
    assert places == sorted(places)


def test_the_mended_model_holds(workshop: Path) -> None:
    assert run(["check", str(GPS / "mended.toml"), "--missions", MISSIONS]) == 0


@pytest.mark.once
def test_equal_runs_give_equal_bytes(workshop: Path) -> None:
    reports: dict[str, set[bytes]] = {"0": set(), "3": set()}
    # Uncompiled the flights for causes take long: they are compared compiled.
    for flights, workers, hash_seed, form in (
        ("3", "1", "0", "0"),
        ("3", "2", "1", "0"),
        ("0", "1", "0", "0"),
        ("0", "2", "2", "1"),
    ):
        output = f"report-{flights}-{workers}-{hash_seed}-{form}"
        command = [sys.executable, "-m", "nddlc.main", "check", str(GPS / "mission.toml"), "--no-store"]
        command += ["--missions", MISSIONS, "--flights", flights, "--workers", workers, "--output", output]
        environment = {**os.environ, "PYTHONHASHSEED": hash_seed, "NDDLC_INTERPRETED": form}
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 1, done.stderr
        reports[flights].add((workshop / output / "report.json").read_bytes())
    assert [len(each) for each in reports.values()] == [1, 1]
    assert all(json.loads(each)["counts"]["fail"] == 1 for (each,) in reports.values())
