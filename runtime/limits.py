"""Limits of the tool itself, of decisions and of memory: what goes beyond them ends with a message."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

if sys.platform != "win32":
    import resource

_MEBIBYTE = 2**20
_USUAL = 4096  # where nobody can tell how much there is


class LimitError(RuntimeError):
    """A limit of the engine itself was reached: no verdict about the model."""

    advice = "a rule may ask for ever more tokens, see `nddlc lint`; a limit of your own is `max_depth` of the reactor"


class OutOfTimeError(LimitError):
    """A mission has taken longer than it may, in the middle of a search of `planner` (None: of none)."""

    advice = "with `max_steps` a reactor flies on after so many decisions a tick; `time_limit` stands in `[check]`"

    def __init__(self, text: str, planner: object = None) -> None:
        super().__init__(text)
        self.planner = planner


class _TimeLimit:
    """How long the mission that is under way may take, by the clock of who says so; else without an end."""

    def __init__(self) -> None:
        self.seconds = self.end = float("inf")
        self.clock: Callable[[], float] = float  # it stands at 0

    def is_over(self) -> bool:
        """Whether it has taken longer."""
        return self.clock() > self.end

    def check(self, planner: object) -> None:
        """Raise OutOfTimeError where it has; `planner` (None: nobody) is in the middle of a search."""
        if self.is_over():
            raise OutOfTimeError(f"took longer than {self.seconds:g} s", planner)

    @contextmanager
    def lasting(self, seconds: float, clock: Callable[[], float] | None = None) -> Iterator[None]:
        """Let what is inside take so long, by `clock` (None: that of before)."""
        before = self.seconds, self.end, self.clock
        self.clock = clock or self.clock
        self.seconds, self.end = seconds, self.clock() + seconds
        try:
            yield
        finally:
            self.seconds, self.end, self.clock = before


TIME_LIMIT = _TimeLimit()


def half_of_the_machine() -> int:
    """Half of the memory there is, in MiB."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // _MEBIBYTE // 2
    except (AttributeError, ValueError, OSError):
        return _USUAL


@contextmanager
def bounded(mebibytes: int) -> Iterator[None]:
    """Let what is inside take so much memory beside what is taken already; more is a MemoryError in here."""
    if sys.platform == "win32":  # where there is no such limit
        yield
        return
    before = resource.getrlimit(resource.RLIMIT_AS)
    limit = _taken() + mebibytes * _MEBIBYTE
    known = [each for each in before if each != resource.RLIM_INFINITY]
    resource.setrlimit(resource.RLIMIT_AS, (min([limit, *known]), before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)


def _taken() -> int:
    """The address space that this process has now, which is what the limit counts."""
    try:
        return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return 1024 * _MEBIBYTE
