"""A batch of one random agent by one worker, by two, and killed and resumed: the reports have to be the same."""

import os
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

MISSIONS = 40
SECONDS = 300.0  # for one batch


def batch_faults(file: Path) -> list[str]:
    """What differs between the reports of batches that have to be the same."""
    wrong = []
    whole = report_of(begun(file, "whole", "--workers", "1"), file, "whole")
    two = report_of(begun(file, "two", "--workers", "2"), file, "two")
    if two != whole:
        wrong.append("two workers report another batch than one")
    killed = begun(file, "resumed", "--workers", "1")
    until = time.monotonic() + SECONDS
    while killed.poll() is None and stored(file.parent / "resumed.sqlite") == 0 and time.monotonic() < until:
        time.sleep(0.02)
    if killed.poll() is None:
        os.killpg(killed.pid, signal.SIGKILL)
    killed.communicate()
    if report_of(begun(file, "resumed", "--workers", "1"), file, "resumed") != whole:
        wrong.append("a batch that was killed and resumed reports another than an undisturbed one")
    return wrong


def begun(file: Path, name: str, *options: str) -> "subprocess.Popen[bytes]":
    """A batch in a process group of its own."""
    command = [sys.executable, "-m", "nddlc", "check", str(file), "--missions", str(MISSIONS), "--flights", "0"]
    command += ["--trust", "--store", f"{name}.sqlite", "--output", name, *options]
    return subprocess.Popen(
        command, cwd=file.parent, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True
    )


def report_of(batch: "subprocess.Popen[bytes]", file: Path, name: str) -> bytes:
    """The report in JSON of a batch that runs to its end."""
    _, said = batch.communicate(timeout=SECONDS)
    report = file.parent / name / "report.json"
    return report.read_bytes() if batch.returncode in (0, 1) and report.exists() else b"none: " + said[-400:]


def stored(store: Path) -> int:
    """How many missions a store has."""
    if not store.exists():
        return 0
    connection = sqlite3.connect(store)
    try:
        return int(connection.execute("SELECT COUNT(*) FROM missions").fetchone()[0])
    except sqlite3.OperationalError:
        return 0
    finally:
        connection.close()
