"""Limits of the tool itself, of decisions and of memory: what goes beyond them ends with a message."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

if sys.platform != "win32":
    import resource

_MEBIBYTE = 2**20
_USUAL = 4096  # where nobody can tell how much there is


class LimitError(RuntimeError):
    """A limit of the engine itself was reached: no verdict about the model."""

    advice = "a rule may ask for ever more tokens, see `nddlc lint`; a limit of your own is `max_depth` of the reactor"


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
