"""What ends a batch before its time: Ctrl-C, SIGTERM, kill -9, a full disk, a second nddlc on the same store."""

import json
import os
import random
import resource
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from checker.batch.pool import Batch, fly_all
from checker.batch.worker import Task
from checker.mission import read_mission
from checker.oracle import Verdict
from checker.report.document import json_report
from checker.schemas import schema
from nddlc.main import run
from tests.checker.fake_agent import load_signalled, load_split
from tests.checker.test_batch import Taker
from tests.checker.test_commands import plug

ROOT = Path(__file__).resolve().parents[2]
GPS = str(ROOT / "models/gps/mission.toml")
pytestmark = [pytest.mark.once, pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")]
PIPE = subprocess.PIPE
KILLS = int(os.environ.get("NDDLC_KILLS", "2"))  # of each kind; `make kills` has more
PROGRESS = (*(f"{done} of 20 missions" for done in range(21)), "seeking causes")  # where 4 s pass meanwhile
LAG = 1.5  # seconds that a machine with much else to do may add


def begin(folder: Path, load: str, *arguments: str) -> "subprocess.Popen[str]":
    """Start a batch in its own process group."""
    command = [sys.executable, "-m", "tests.checker.fake_batch", load, GPS, "--flights", "0", *arguments]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.Popen(
        command, cwd=folder, text=True, start_new_session=True, stdout=PIPE, stderr=PIPE, env=environment
    )


def finished(folder: Path) -> int:
    """How many missions are on disk."""
    store = folder / ".nddlc" / "runs.sqlite"
    if not store.exists():
        return 0
    connection = sqlite3.connect(store)
    try:
        return int(connection.execute("SELECT COUNT(*) FROM missions").fetchone()[0])
    except sqlite3.OperationalError:
        return 0
    finally:
        connection.close()


def wait_for(folder: Path, batch: "subprocess.Popen[str]", missions: int = 1) -> None:
    while finished(folder) < missions:
        assert batch.poll() is None, batch.communicate()
        time.sleep(0.05)


@pytest.mark.parametrize(
    ("number", "is_group"), [(signal.SIGINT, True), (signal.SIGTERM, False), (signal.SIGTERM, True)]
)
def test_a_signal_ends_a_batch_at_once_and_keeps_what_is_finished(
    tmp_path: Path, number: signal.Signals, is_group: bool
) -> None:
    batch = begin(tmp_path, "load_slow", "--missions", "5000")
    wait_for(tmp_path, batch, 5)
    (os.killpg if is_group else os.kill)(batch.pid, number)
    pressed = time.monotonic()
    out, err = batch.communicate(timeout=30)
    took = time.monotonic() - pressed
    assert batch.returncode == 128 + number
    assert "Traceback" not in err
    kept = finished(tmp_path)
    assert f"gps: {kept} missions of 5000 (interrupted)" in out
    assert took < 5.0  # one second on a machine with nothing else to do
    assert (tmp_path / ".nddlc" / ".gitignore").read_text() == "*\n"
    report = json.loads((tmp_path / "nddlc-report/report.json").read_text(encoding="utf-8"))
    assert (report["verdict"], report["ending"], len(report["missions"])) == ("interrupted", "signal", kept)
    assert list(Draft202012Validator(schema("report")).iter_errors(report)) == []


def test_slow_missions_are_on_disk_within_a_second(tmp_path: Path) -> None:
    batch = begin(tmp_path, "load_very_slow", "--missions", "5000", "--workers", "1")
    wait_for(tmp_path, batch)
    seen = time.monotonic()
    wait_for(tmp_path, batch, 4)  # three more of 0.4 s each
    took = time.monotonic() - seen
    os.killpg(batch.pid, signal.SIGKILL)
    batch.communicate(timeout=30)
    assert took < 3 * 0.4 + 1.0 + LAG


def stored_seeds(folder: Path) -> set[int]:
    connection = sqlite3.connect(folder / ".nddlc" / "runs.sqlite")
    try:
        return {json.loads(row[0])["seed"] for row in connection.execute("SELECT result FROM missions")}
    finally:
        connection.close()


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_a_batch_killed_at_random_moments_and_resumed_is_as_if_undisturbed(
    tmp_path: Path, number: signal.Signals, monkeypatch: pytest.MonkeyPatch
) -> None:
    """NDDLC_KILLS times, each at another moment; what was flown more than a second before is never lost."""
    log = tmp_path / "flown.txt"
    monkeypatch.setenv("FLOWN", str(log))
    chance = random.Random(20)
    missions = str(24 * KILLS)
    done, worst = 0, 0.0
    for _ in range(KILLS):
        batch = begin(tmp_path, "load_slow", "--missions", missions)
        if done == 0:
            wait_for(tmp_path, batch)
        time.sleep(chance.uniform(0.3, 1.5))
        killed = time.time()
        os.kill(batch.pid, number)
        batch.communicate(timeout=30)
        assert finished(tmp_path) >= done
        done = finished(tmp_path)
        flown = {int(seed): float(at) for seed, at in (line.split() for line in log.read_text().splitlines())}
        lost = [at for seed, at in flown.items() if seed not in stored_seeds(tmp_path)]
        worst = max([worst, *(killed - at for at in lost)])
        log.write_text("")
    print(f"{KILLS} x {number.name}: at most {worst:.2f} s lost")
    assert worst < 1.0 + LAG
    flown_to_the_end = ("load_slow", "--missions", missions, "--flights", "2" if number == signal.SIGTERM else "0")
    ended = begin(tmp_path, *flown_to_the_end, "--output", "resumed")
    ended.communicate(timeout=120)
    undisturbed = begin(tmp_path, *flown_to_the_end, "--output", "whole", "--store", "whole.sqlite")
    undisturbed.communicate(timeout=120)
    assert (ended.returncode, undisturbed.returncode) == (1, 1)
    for name in ("report.json", "report.html", "report.sarif", "junit.xml"):
        assert (tmp_path / "resumed" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()


def test_a_second_nddlc_on_the_same_run_is_refused(tmp_path: Path) -> None:
    first = begin(tmp_path, "load_slow", "--missions", "5000")
    wait_for(tmp_path, first)
    second = begin(tmp_path, "load_slow", "--missions", "5000", "--fresh")
    _, err = second.communicate(timeout=120)
    assert second.returncode == 2
    assert "another nddlc flies run" in err
    other = begin(tmp_path, "load_slow", "--missions", "6")
    other.communicate(timeout=120)
    assert other.returncode in (0, 1)
    os.kill(first.pid, signal.SIGTERM)
    out, _ = first.communicate(timeout=120)
    assert first.returncode == 143
    third = begin(tmp_path, "load_slow", "--missions", "5000", "--seconds", "0.2")
    out, _ = third.communicate(timeout=120)
    assert "(time was over)" in out


def test_a_full_disk_is_told_and_leaves_the_store_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = begin(tmp_path, "load_split", "--missions", "20", "--output", "whole")
    whole.communicate(timeout=60)
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (150_000, before[1]))
    try:
        full = begin(tmp_path, "load_split", "--missions", "2000")
        _, err = full.communicate(timeout=60)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert full.returncode == 2, err
    assert "no space is left" in err
    assert "Traceback" not in err
    monkeypatch.chdir(tmp_path)
    assert run(["store", "check"]) == 0
    kept = finished(tmp_path)
    again = begin(tmp_path, "load_split", "--missions", "2000")
    again.communicate(timeout=120)
    assert again.returncode == 1
    assert finished(tmp_path) == 2020 > kept


def test_a_real_time_signal_costs_one_mission() -> None:
    mission, _ = read_mission(Path(GPS))
    assert mission is not None
    taker = Taker()
    tasks = [Task(n, n) for n in range(1, 7)]
    assert fly_all(Batch(load_signalled, mission.agent, tasks, 1, 30.0), taker) is None
    lost = {one.number: one.judgement.message for one in taker.results if one.verdict is Verdict.ERROR}
    assert lost == {3: "the process died (signal 40)"}
    assert len(taker.results) == 6


def test_a_signal_while_reports_are_written_leaves_none_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def pressed(*arguments: Any) -> str:
        signal.raise_signal(signal.SIGINT)
        return json_report(*arguments)

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("nddlc.check.json_report", pressed)
    plug(monkeypatch, load_split)
    assert run(["check", GPS, "--missions", "8", "--workers", "1", "--flights", "0"]) == 128 + signal.SIGINT
    told = capsys.readouterr()
    assert "gps: 8 missions" in told.out and "interrupted" not in told.err
    assert {one.name for one in Path("nddlc-report").iterdir()} == {
        *("report.json", "report.html", "report.md", "report.sarif", "junit.xml"),
    }


@pytest.mark.parametrize(("number", "is_group"), [(signal.SIGINT, True), (signal.SIGTERM, False)])
def test_a_signal_while_causes_are_sought_leaves_what_was_found(
    tmp_path: Path, number: signal.Signals, is_group: bool
) -> None:
    command = [sys.executable, "-m", "nddlc.main", "check", GPS, "--missions", "20", "--workers", "1"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    check = subprocess.Popen(
        command, cwd=tmp_path, text=True, start_new_session=True, stdout=PIPE, stderr=PIPE, env=environment
    )
    wait_for(tmp_path, check, 20)
    time.sleep(0.5)
    (os.killpg if is_group else os.kill)(check.pid, number)
    pressed = time.monotonic()
    out, err = check.communicate(timeout=30)
    took = time.monotonic() - pressed
    assert check.returncode == 128 + number
    assert all(line.startswith(PROGRESS) for line in err.splitlines()), err
    assert "gps: 20 missions, 1 failed" in out
    assert "interrupted after all missions; left out: causes of fault 1 (in part), the condition of fault 1" in out
    assert "nddlc explain" in out
    assert took < 2.0 + LAG
    report = json.loads((tmp_path / "nddlc-report/report.json").read_text(encoding="utf-8"))
    assert (report["verdict"], report["ending"], report["counts"]["fail"]) == ("fails", "complete", 1)
    assert list(Draft202012Validator(schema("report")).iter_errors(report)) == []
