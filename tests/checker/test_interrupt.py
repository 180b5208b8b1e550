"""Ctrl-C during a batch, as a user presses it: to the whole group of processes."""

import os
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = f"""
import sys
sys.path.insert(0, {str(ROOT)!r})
import nddlc.check
from nddlc.main import run
from tests.checker.fake_agent import load_slow

if __name__ == "__main__":
    nddlc.check.load = load_slow
    sys.exit(run(["check", {str(ROOT / "models/gps/mission.toml")!r}, "--missions", "5000", *sys.argv[1:]]))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_ctrl_c_ends_a_batch_at_once_and_keeps_what_is_finished(tmp_path: Path) -> None:
    (tmp_path / "flies.py").write_text(SCRIPT, encoding="utf-8")
    command = [sys.executable, "flies.py"]
    pipe = subprocess.PIPE
    batch = subprocess.Popen(command, cwd=tmp_path, text=True, start_new_session=True, stdout=pipe, stderr=pipe)
    store = tmp_path / ".nddlc" / "runs.sqlite"
    while not finished(store):
        assert batch.poll() is None, batch.communicate()
        time.sleep(0.05)
    os.killpg(batch.pid, signal.SIGINT)
    pressed = time.monotonic()
    out, err = batch.communicate(timeout=30)
    took = time.monotonic() - pressed
    assert batch.returncode == 130
    assert "Traceback" not in err
    kept = finished(store)
    assert f"gps: {kept} missions of 5000 (interrupted)" in out
    assert took < 3.0  # one second on a machine with nothing else to do
    assert (tmp_path / ".nddlc" / ".gitignore").read_text() == "*\n"


def finished(store: Path) -> int:
    """How many missions are on disk."""
    if not store.exists():
        return 0
    connection = sqlite3.connect(store)
    try:
        return int(connection.execute("SELECT COUNT(*) FROM missions").fetchone()[0])
    except sqlite3.OperationalError:
        return 0
    finally:
        connection.close()
