"""Black box: what a process notes of the modeler's call under way, for another process that sees it hang or die.

It lies in memory that both share. A call costs a few stores there; Python's `faulthandler` adds where the process was,
also where it never looks up again, as in `sum(range(10**12))`, or dies of a signal. Other systems have none.
"""

import faulthandler
import mmap
import os
import re
import signal
import sys
from contextlib import suppress
from pathlib import Path
from typing import Protocol

from runtime.user.fault import UserCodeError, ended, place_in, stopped

_PAGE = 4096
# Words of the page: how often a call began or ended, times 256, and how many are under way; the milliseconds that one
# may take; the first word at which somebody steps through the code; whether the process ends by its own will; the
# length of the text behind them. What `faulthandler` writes comes after the page.
_STATE, _LIMIT, _EXCUSED, _LEAVING, _LENGTH, _TEXT = range(6)
_BEGUN, _ENDED = 256 + 1, 256 - 1
_WORD = 8
_PATIENCE, _STILL = 500, 20  # looks, a hundredth of a second apart, for an answer, and of those at one that is whole
_SLACK = 3.5  # seconds beyond the limit: those who look inside the process come first
_FRAME = re.compile(r'^  File "(.*)", line (\d+) in ', re.MULTILINE)
_ASK = getattr(signal, "SIGUSR2", None)


class UserCode(Protocol):
    """A modeler's code, as far as the box names it."""

    @property
    def title(self) -> str:
        """What it is, in words."""

    @property
    def files(self) -> tuple[str, ...]:
        """Where it is written."""

    @property
    def line(self) -> int:
        """Where it begins in the first of them."""


class CallRecorder:
    """The box from within the process whose calls are noted."""

    def __init__(self, file: int) -> None:
        self._words = memoryview(mmap.mmap(file, _PAGE)).cast("q")
        self._code: UserCode | None = None
        self._state = 0
        if sys.version_info >= (3, 14):
            faulthandler.enable(file, all_threads=False, c_stack=False)
        else:
            faulthandler.enable(file, all_threads=False)
        if _ASK is not None:
            faulthandler.register(_ASK, file, all_threads=False)

    def limit(self, seconds: float) -> None:
        """Note how long one call may take."""
        self._words[_LIMIT] = min(int(seconds * 1000), 2**62)

    def begin(self, code: UserCode) -> None:
        """A call begins."""
        if code is not self._code:
            self._introduce(code)
        self._state += _BEGUN
        self._words[_STATE] = self._state

    def _introduce(self, code: UserCode) -> None:
        self._code = code
        text = "\0".join((code.title, str(code.line), *code.files)).encode("utf-8", "surrogateescape")
        text = text[: _PAGE - _TEXT * _WORD]
        self._words.cast("B")[_TEXT * _WORD : _TEXT * _WORD + len(text)] = text
        self._words[_LENGTH] = len(text)

    def end(self) -> None:
        """The call that began last ends."""
        self._state += _ENDED
        self._words[_STATE] = self._state

    def excuse(self) -> None:
        """Somebody steps through the call that is under way."""
        self._words[_EXCUSED] = self._state

    def leave(self) -> None:
        """The process ends by its own will, and says itself what there is to say."""
        self._words[_LEAVING] = 1


class _Here:
    """The box that this process writes to."""

    def __init__(self) -> None:
        self.recorder: CallRecorder | None = None

    def open(self, path: str) -> None:
        """Write to the box at `path`, if it can be had."""
        with suppress(OSError):
            self.recorder = CallRecorder(os.open(path, os.O_RDWR | os.O_APPEND | os.O_CLOEXEC))

    def leave(self) -> None:
        """The process ends by its own will."""
        if self.recorder is not None:
            self.recorder.leave()


HERE = _Here()


class BlackBox:
    """The box from outside."""

    def __init__(self) -> None:
        self._file = os.memfd_create("nddlc", os.MFD_CLOEXEC)
        os.truncate(self._file, _PAGE)
        self._words = memoryview(mmap.mmap(self._file, _PAGE)).cast("q")
        self._seen = 0
        self._away = 0.0

    @property
    def path(self) -> str:
        """Where a process of the same user opens it."""
        return f"/proc/{os.getpid()}/fd/{self._file}"

    def close(self) -> None:
        """Throw it away."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1

    @property
    def is_leaving(self) -> bool:
        """Whether the process ended, or ends, by its own will."""
        return self._words[_LEAVING] != 0

    def is_stuck(self, step: float) -> bool:
        """Look another time, `step` seconds after the last one: whether one call is there for longer than it may be."""
        words = self._words
        state = words[_STATE]
        if state != self._seen or not state % 256 or state == words[_EXCUSED]:
            self._seen = state
            self._away = 0.0
            return False
        self._away += step
        return self._away >= words[_LIMIT] / 1000 + _SLACK

    def hung(self, process: int) -> UserCodeError:
        """What to say of a process that is stuck and will be ended: it is asked where it is."""
        before = os.fstat(self._file).st_size
        if _ASK is not None:
            os.kill(process, _ASK)
            size, still = before, 0
            for _ in range(_PATIENCE):  # the answer comes in pieces, on a busy machine late
                signal.sigtimedwait((), 0.01)
                known, size = size, os.fstat(self._file).st_size
                still = still + 1 if before < size == known and self._frames() else 0
                if still == _STILL:
                    break
        title, line, files = self._code()
        return stopped(place_in(self._frames(), files, line), title, self._words[_LIMIT] / 1000)

    def died(self, how: str) -> UserCodeError | None:
        """What to say of a process that died in a modeler's call; None if none was under way."""
        if not self._words[_STATE] % 256 or self.is_leaving:
            return None
        title, line, files = self._code()
        return ended(place_in(self._frames(), files, line), title, how)

    def last_words(self) -> str:
        """What `faulthandler` wrote."""
        size = os.fstat(self._file).st_size
        return os.pread(self._file, max(size - _PAGE, 0), _PAGE).decode("ascii", "replace")

    def _code(self) -> tuple[str, int, tuple[str, ...]]:
        start = _TEXT * _WORD
        text = bytes(self._words.cast("B")[start : start + self._words[_LENGTH]])
        title, line, *files = text.decode("utf-8", "surrogateescape").split("\0")
        return title, int(line), tuple(files)

    def _frames(self) -> list[tuple[str, int]]:
        """File and line of each call in the last dump, the outermost first."""
        dump = self.last_words().rpartition("most recent call first")[2]
        # The names are ASCII there, with escapes.
        own = {file.encode("ascii", "backslashreplace").decode(): file for file in self._code()[2]}
        return [(own.get(file, file), int(line)) for file, line in reversed(_FRAME.findall(dump))]


def new_box() -> BlackBox | None:
    """A box; None where there is none."""
    return BlackBox() if hasattr(os, "memfd_create") and Path("/proc/self/fd").is_dir() else None


def signal_name(number: int) -> str:
    """The name of a signal, or its number."""
    try:
        return signal.Signals(number).name
    except ValueError:  # real-time signals but the first and the last have no names
        return str(number)
