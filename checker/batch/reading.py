"""A store that may not be written in, a place where SQLite can read it out: it writes beside what it reads.

Readers of a write-ahead log make a file of shared memory beside it, so a store on a disk that is mounted to be read, in
an archive or in another user's folder, is copied, together with its log.
"""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

_PARTS = ("", "-wal")
_MOST_TRIES = 3


@contextmanager
def readable_place(path: Path) -> Iterator[Path]:
    """The store itself where it and its folder may be written, else a copy; raises OSError where that fails."""
    if not path.is_file() or (os.access(path, os.W_OK) and os.access(path.parent, os.W_OK)):
        yield path
        return
    with TemporaryDirectory(prefix="nddlc-") as folder:
        place = Path(folder) / "store.sqlite"
        _copy(path, place)
        yield place


def _copy(path: Path, place: Path) -> None:
    """Copy a store with its log, and again where somebody has written to it meanwhile."""
    for _ in range(_MOST_TRIES):
        before = _state(path)
        for part in _PARTS:
            source, target = Path(f"{path}{part}"), Path(f"{place}{part}")
            target.unlink(missing_ok=True)
            if source.exists():
                shutil.copyfile(source, target)
        if _state(path) == before:
            return
    raise OSError(0, "somebody writes to it all the time")


def _state(path: Path) -> list[tuple[int, int] | None]:
    """Size and time of change of a store's files."""
    files = [Path(f"{path}{part}") for part in _PARTS]
    found = [one.stat() if one.exists() else None for one in files]
    return [None if one is None else (one.st_size, one.st_mtime_ns) for one in found]
