"""Standard streams: what programs read is apart from what a modeler's code writes, and a reader may go away.

Where the reader of a pipe is gone (`nddlc check | head`), the rest vanishes: reports and exit codes are as ever.
"""

import io
import os
import stat
import sys
from contextlib import suppress
from typing import Any, TextIO

_STDOUT, _STDERR = 1, 2


class _Pipe(io.FileIO):
    """A pipe that takes what nobody reads."""

    def write(self, data: Any) -> int:
        """Write, or drop what nobody reads."""
        try:
            return super().write(data)
        except BrokenPipeError:
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self.fileno())
            os.close(nowhere)
            return memoryview(data).nbytes


def let_readers_go() -> None:
    """Have what is written to standard streams vanish once their readers are gone."""
    for name in ("stdout", "stderr"):
        old = getattr(sys, name)
        with suppress(AttributeError, OSError, ValueError):  # a stream that is closed, or has no descriptor
            raw = getattr(old.buffer, "raw", old.buffer)  # there is no buffer where Python was asked for none
            if old.fileno() in (_STDOUT, _STDERR) and not isinstance(raw, _Pipe):
                old.flush()
                setattr(sys, name, _opened(old.fileno(), old, is_own=False))


def _opened(descriptor: int, old: TextIO, *, is_own: bool) -> TextIO:
    """A stream like an old one."""
    mode = os.fstat(descriptor).st_mode
    if not stat.S_ISFIFO(mode) and not stat.S_ISSOCK(mode):
        lines = 1 if os.isatty(descriptor) else -1
        return os.fdopen(descriptor, "w", lines, old.encoding, old.errors) if is_own else old
    pipe = io.BufferedWriter(_Pipe(descriptor, "w", closefd=is_own))
    return io.TextIOWrapper(pipe, encoding=old.encoding, errors=old.errors, line_buffering=bool(old.line_buffering))


def keep_output_apart() -> None:
    """Give standard output a descriptor of its own; what writes to descriptor 1 from now on reaches standard error.

    Nothing happens where standard output is something else already, as under a test runner or in the language server.
    """
    try:
        if sys.stdout.fileno() != _STDOUT:
            return
        sys.stdout.flush()
        own = os.dup(_STDOUT)
        os.dup2(_STDERR, _STDOUT)
    except (AttributeError, OSError, ValueError):  # a stream that is closed, or has no descriptor
        return
    sys.stdout = _opened(own, sys.stdout, is_own=True)
