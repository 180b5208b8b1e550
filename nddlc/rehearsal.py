"""Rehearsal: the project's Python is loaded by a process of its own before a server loads it; files in, mistake out.

A module that holds the interpreter, crashes or ends the process costs that process only. The same texts are tried once.
"""

import json
import subprocess
import sys
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path

import runtime.build_form
from nddlc.supervision import supervise
from runtime.user.black_box import HERE
from runtime.user.fault import UserCodeError
from runtime.user.library import load_library, seen_from_here
from runtime.user.limit import USUAL
from runtime.user.output import keep_output_apart

_LOADED, _REFUSED, _DIED = 0, 2, 3
_START = 60.0  # seconds beside the modules' own, for a process to start and to be given up
_KEPT = 64  # sets of modules


def rehearse(files: Sequence[Path], seconds: float | None) -> tuple[int, UserCodeError] | None:
    """Which of these modules is the first that cannot be loaded after those before it, and why.

    `seconds` is what each may take; None for the usual limit.
    """
    limit = USUAL if seconds is None else seconds
    modules = tuple((seen_from_here(file).as_posix(), _text(file)) for file in files)
    if _rehearse(modules, limit) is None:
        return None
    tried = ((at, _rehearse(modules[: at + 1], limit)) for at in range(len(modules)))
    return next(((at, mistake) for at, mistake in tried if mistake is not None), None)


def _text(file: Path) -> bytes:
    try:
        return file.read_bytes() if file.is_file() else b""
    except OSError:
        return b""


@lru_cache(_KEPT)
def _rehearse(modules: tuple[tuple[str, bytes], ...], seconds: float) -> UserCodeError | None:
    files = [name for name, _ in modules]
    try:
        ended = subprocess.run(
            [sys.executable, "-P", "-m", "nddlc.rehearsal", str(seconds), *files],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            timeout=_START + 2 * seconds * len(files),
            check=False,
        )
    except subprocess.TimeoutExpired:
        return UserCodeError(f"{files[-1]}: the modules did not come back, and were stopped")
    if ended.returncode == _LOADED:
        return None
    try:
        message, detail, advice = json.loads(ended.stdout)
    except ValueError:
        return UserCodeError(f"{files[-1]}: the modules ended the process (exit code {ended.returncode})")
    return UserCodeError(message, detail, advice)


def _tell(mistake: UserCodeError) -> None:
    print(json.dumps([str(mistake), mistake.detail, mistake.advice]), flush=True)


def _tell_death(death: Exception) -> int:
    _tell(UserCodeError(str(death).partition("\n")[0]))
    return _DIED


def _main() -> None:
    """Load what the command line names, and tell what goes wrong as JSON."""
    keep_output_apart()
    supervise(_tell, _tell_death)
    seconds, *files = sys.argv[1:]
    code = _LOADED
    try:
        load_library(Path(), files, seconds=float(seconds))
    except UserCodeError as mistake:
        _tell(mistake)
        code = _REFUSED
    HERE.leave()
    sys.exit(code)


if __name__ == "__main__":
    _main()
