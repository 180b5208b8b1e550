"""Commands of nddlc carried out one by one, each in a process of its own: exit code, processor time and memory out."""

import json
import os
import select
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from nddlc.main import COMMANDS, main, named

ROOT = Path(__file__).parents[2]
PATIENCE = 60  # seconds, for what hangs
_BEGIN = "from tests.cli.measured import serve; serve()"


@dataclass(frozen=True)
class Measured:
    """How a command ended."""

    code: int
    seconds: float  # of the processor
    mebibytes: float
    text: str


class Commands:
    """A process that has everything loaded, and copies itself for each command."""

    def __init__(self) -> None:
        environment = os.environ | {"PYTHONPATH": str(ROOT)}
        self._process = subprocess.Popen(
            [sys.executable, "-c", _BEGIN], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment
        )

    def run(self, words: list[str], folder: Path) -> Measured:
        """Carry out one in a folder."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps([words, str(folder)]) + "\n")
        self._process.stdin.flush()
        code, seconds, mebibytes = json.loads(self._process.stdout.readline())
        text = (folder / "said.txt").read_text(encoding="utf-8", errors="replace")
        return Measured(code, seconds, mebibytes, text)

    def close(self) -> None:
        """No more will come."""
        self._process.communicate()


def serve() -> None:
    """Carry out what comes in over standard input."""
    for name in ("lint", "fmt", "load", "plan", "check", "run"):
        named(f"{COMMANDS[name][0]}:command")
    for line in sys.stdin:
        words, folder = json.loads(line)
        print(json.dumps(_measure(words, folder)), flush=True)


def _measure(words: list[str], folder: str) -> tuple[int, float, float]:
    process = os.fork()
    if process == 0:
        os.setsid()
        os.chdir(folder)
        said = os.open("said.txt", os.O_CREAT | os.O_TRUNC | os.O_WRONLY)
        nothing = os.open(os.devnull, os.O_RDONLY)
        for here, there in ((nothing, 0), (said, 1), (said, 2)):
            os.dup2(here, there)
        sys.argv = ["nddlc", *words]
        code = 3
        try:
            main()
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else 3
        finally:
            sys.stdout.flush()
            os._exit(code)
    watched = os.pidfd_open(process)
    if not select.select([watched], [], [], PATIENCE)[0]:
        os.killpg(process, signal.SIGKILL)
    os.close(watched)
    _, status, used = os.wait4(process, 0)
    taken = used.ru_maxrss / 1024
    return os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime, taken
