"""A constraint that holds the interpreter or ends the process costs a command its end, never the user an answer."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.user_constraints.own import HEAD

pytestmark = [pytest.mark.once, pytest.mark.skipif(sys.platform != "linux", reason="black boxes are Linux only")]
ROOT = Path(__file__).parents[2]
OWN = """
import ctypes, os, posix, signal, sys

class Bad(Constraint):
    name = "bad"
    signature = "x:number"
    meaning = "it is bad"

    def propagate(self, view):
        BODY
        return True

CONSTRAINTS = [Bad()]
"""
FIRST = (HEAD + OWN).partition("def propagate")[0].count("\n") + 1
BODY = FIRST + 1
MODEL = """class Boat extends Timeline {
  predicate Sail { int n; bad(n); }
}
Boat boat = new Boat();
close();
"""
MISSION = """[mission]
name = "m"
final_tick = 20
tick = 1.0

[constraints]
modules = ["own.py"]
time_limit = 0.3

[[reactor]]
name = "captain"
model = "model.nddl"
latency = 1
lookahead = 20
internal = ["boat"]

[[goal]]
timeline = "boat"
predicate = "Sail"
start = [2, 5]
mandatory = true

[check]
missions = 2
"""
ENDS = {
    "sum(range(10**12))": (BODY, "did not come back within 0.3 s and was stopped"),
    "ctypes.string_at(0)": (BODY, "ended the process (signal SIGSEGV)"),
    "ctypes.CDLL(None).abort()": (BODY, "ended the process (signal SIGABRT)"),
    "os.kill(os.getpid(), signal.SIGKILL)": (FIRST, "ended the process (signal SIGKILL)"),
    "posix._exit(0)": (FIRST, "ended the process (exit code 0)"),
}


def project(folder: Path, body: str) -> None:
    (folder / "own.py").write_text(HEAD + OWN.replace("BODY", body), encoding="utf-8")
    (folder / "nddlc.toml").write_text('[constraints]\nmodules = ["own.py"]\ntime_limit = 0.3\n', encoding="utf-8")
    (folder / "model.nddl").write_text(MODEL, encoding="utf-8")
    (folder / "alone.nddl").write_text("int x = [0 9];\nbad(x);\n", encoding="utf-8")
    (folder / "mission.toml").write_text(MISSION, encoding="utf-8")


def nddlc(folder: Path, *words: str) -> "subprocess.CompletedProcess[str]":
    command = [sys.executable, "-m", "nddlc.main", *words]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False, timeout=120, input=""
    )


@pytest.mark.parametrize("body", ENDS)
def test_whatever_a_constraint_does_is_told_with_its_place(body: str, tmp_path: Path) -> None:
    project(tmp_path, body)
    line, said = ENDS[body]
    begun = time.monotonic()
    done = nddlc(tmp_path, "load", "alone.nddl")
    assert done.stderr.startswith(f"nddlc: own.py:{line}: the constraint `bad` {said}\n  help: ")
    assert (done.returncode, done.stdout) == (2, "")
    assert time.monotonic() - begun < 20.0


@pytest.mark.parametrize("body", ["sum(range(10**12))", "ctypes.string_at(0)"])
@pytest.mark.parametrize(
    "words",
    [
        ("plan", "alone.nddl"),
        ("run", "mission.toml"),
        ("check", "mission.toml", "--workers", "1"),
        ("mutate", "mission.toml", "--missions", "1"),
        ("certify", "mission.toml"),
        ("gold", "accept", "mission.toml"),
    ],
)
def test_every_command_survives(words: tuple[str, ...], body: str, tmp_path: Path) -> None:
    project(tmp_path, body)
    line, said = ENDS[body]
    done = nddlc(tmp_path, *words)
    assert f"own.py:{line}: the constraint `bad` {said}" in done.stdout + done.stderr
    assert "Traceback" not in done.stderr and "bug" not in done.stderr
    assert done.returncode == 2


@pytest.mark.parametrize("words", [("lint", "--trust", "alone.nddl"), ("check", "--trust", "alone.nddl")])
def test_a_module_that_holds_the_interpreter_is_stopped(words: tuple[str, ...], tmp_path: Path) -> None:
    project(tmp_path, "pass")
    with (tmp_path / "own.py").open("a", encoding="utf-8") as file:
        file.write("sum(range(10**12))\n")
    last = (tmp_path / "own.py").read_text(encoding="utf-8").count("\n")
    done = nddlc(tmp_path, *words)
    assert f"own.py:{last}: the module did not come back within 0.3 s and was stopped" in done.stderr
    assert done.returncode == 2
