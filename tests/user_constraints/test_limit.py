"""A constraint that does not come back, or does what it must not, ends well: in time, and with its place."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from textwrap import indent

import pytest

from tests.user_constraints.own import HEAD

MODULE = """
import os, re, subprocess, threading, time, signal, sys

def deep(n):
    return deep(n + 1) + 1

class Bad(Constraint):
    name = "bad"
    signature = "x:number"
    meaning = "it is bad"

    def propagate(self, view):
{body}
        return True

CONSTRAINTS = [Bad()]
"""
FIRST = (HEAD + MODULE).partition("{body}")[0].count("\n") + 1  # the line that the body begins in
ROOT = Path(__file__).parents[2]
STOPPED = "`propagate` of the constraint `bad`, called at model.nddl:2, did not come back within 0.3 s and was stopped"
SWALLOWS = "signal.signal(signal.SIGALRM, signal.SIG_IGN)\nwhile True: pass"


def project(folder: Path, body: str, limit: str = "0.3") -> None:
    (folder / "own.py").write_text(HEAD + MODULE.format(body=indent(body, " " * 8)), encoding="utf-8")
    (folder / "nddlc.toml").write_text(f'[constraints]\nmodules = ["own.py"]\ntime_limit = {limit}\n', encoding="utf-8")
    (folder / "model.nddl").write_text("int x = [0 9];\nbad(x);\n", encoding="utf-8")


def nddlc(folder: Path, *words: str) -> "subprocess.CompletedProcess[str]":
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "nddlc.main", *words]
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False, timeout=60, input=""
    )


@pytest.mark.parametrize(
    "body",
    [
        "while True: pass",
        "time.sleep(1000)",
        "lock = threading.Lock()\nwith lock: lock.acquire()",
        "subprocess.run([sys.executable, '-c', 'import time; time.sleep(1000)'])",
        "re.match('(a+)+b', 'a' * 60)",
        "10 ** 10 ** 9",
    ],
)
@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs a signal that looks")
def test_a_call_that_does_not_come_back_is_stopped_where_it_is(body: str, tmp_path: Path) -> None:
    project(tmp_path, body)
    done = nddlc(tmp_path, "load", "model.nddl")
    line = FIRST + body.count("\n")
    expected = f"nddlc: own.py:{line}: {STOPPED}\n  help: `time_limit = 0.6` under [constraints] lets it run longer"
    assert done.stderr.startswith(expected)
    assert done.returncode == 2


def test_a_call_that_swallows_the_interruption_takes_the_process_with_it(tmp_path: Path) -> None:
    project(tmp_path, SWALLOWS)
    done = nddlc(tmp_path, "plan", "model.nddl")
    assert f"own.py:{FIRST + 1}: the constraint `bad`, called at model.nddl:2, did not come back" in done.stderr
    assert done.returncode == 2


def test_a_module_that_does_not_come_back_is_stopped(tmp_path: Path) -> None:
    project(tmp_path, "pass")
    with (tmp_path / "own.py").open("a", encoding="utf-8") as file:
        file.write("while True: pass\n")
    done = nddlc(tmp_path, "lint", "--trust", "model.nddl")
    assert "the module did not come back within 0.3 s and was stopped" in done.stderr
    assert done.returncode == 2


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("deep(0)", "own.py:6: `propagate` of the constraint `bad`, called at model.nddl:2, failed: RecursionError"),
        ("sys.exit(0)", f"own.py:{FIRST}: `propagate` of the constraint `bad`, called at model.nddl:2, failed: System"),
        ("raise BaseException('x')", "failed: BaseException: x"),
        (
            "raise KeyboardInterrupt",
            f"own.py:{FIRST}: `propagate` of the constraint `bad`, called at model.nddl:2, failed",
        ),
        ("os._exit(0)", "failed: RuntimeError: os._exit(0) is not for a constraint"),
        ("os.abort()", "failed: RuntimeError: os.abort() is not for a constraint"),
        ("return float('nan')", "failed: TypeError: it returned nan instead of True or False"),
        ("view.raise_to(0, float('nan'))", f"own.py:{FIRST}: `propagate` of the constraint `bad`"),
        ("self.n = getattr(self, 'n', 0) + 1\nview.raise_to(0, self.n % 7)", "it answers differently"),
        (
            "old = getattr(self, 'old', view)\nself.old = view\nold.lower(0)",
            "a view is of no use after `propagate` has",
        ),
        ("return None", f"own.py:{FIRST - 1}: `propagate` of the constraint `bad`"),
    ],
)
def test_what_fails_ends_the_command(body: str, said: str, tmp_path: Path) -> None:
    project(tmp_path, body, "5")
    done = nddlc(tmp_path, "load", "model.nddl")
    assert said in done.stderr
    assert "Traceback" not in done.stderr
    assert (done.returncode, done.stdout) == (2, "")


@pytest.mark.parametrize("command", ["load", "plan"])
def test_what_is_printed_does_not_disturb_what_programs_read(command: str, tmp_path: Path) -> None:
    project(tmp_path, "pass")
    quiet = nddlc(tmp_path, command, "--json", "model.nddl").stdout
    project(tmp_path, "for i in range(1000): print('so far', i)")
    loud = nddlc(tmp_path, command, "--json", "model.nddl")
    assert loud.stdout == quiet
    assert "so far 999" in loud.stderr


@pytest.mark.parametrize("command", ["load", "plan"])
def test_what_is_written_past_python_does_not_disturb_what_programs_read(command: str, tmp_path: Path) -> None:
    project(tmp_path, "pass")
    quiet = nddlc(tmp_path, command, "--json", "model.nddl").stdout
    project(tmp_path, "os.write(1, b'past'); subprocess.run(['echo', 'a child'])")
    loud = nddlc(tmp_path, command, "--json", "model.nddl")
    assert loud.stdout == quiet
    assert "past" in loud.stderr and "a child" in loud.stderr


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_copy_of_the_process_does_not_come_back(tmp_path: Path) -> None:
    project(tmp_path, "pass")
    alone = nddlc(tmp_path, "load", "model.nddl").stdout
    project(tmp_path, "child = os.fork()\nif child: os.waitpid(child, 0)", "20")
    done = nddlc(tmp_path, "load", "model.nddl")
    assert done.stdout == alone
    assert done.stderr.count("copied the process (`fork`), and the copy came back: it was ended") >= 1


@pytest.mark.skipif(os.name == "nt", reason="Ctrl-C is no signal there")
@pytest.mark.parametrize("body", ["while True: pass", "time.sleep(1000)"])
def test_an_interrupt_ends_a_call(body: str, tmp_path: Path) -> None:
    project(tmp_path, f"open('begun', 'w').close()\n{body}", "1000")
    command = [sys.executable, "-m", "nddlc.main", "load", "model.nddl"]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    with subprocess.Popen(command, cwd=tmp_path, env=environment, stderr=subprocess.PIPE, text=True) as process:
        while not (tmp_path / "begun").exists():
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, told = process.communicate(timeout=60)
    assert told.strip() == "nddlc: interrupted"
    assert process.returncode == 130


@pytest.mark.parametrize("limit", ['"5"', "0", "-1", "true"])
def test_the_limit_is_a_number_above_0(limit: str, tmp_path: Path) -> None:
    project(tmp_path, "pass", limit)
    done = nddlc(tmp_path, "load", "model.nddl")
    assert "`time_limit` must be a number of seconds above 0" in done.stderr
    assert done.returncode == 2
