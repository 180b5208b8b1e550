"""Read a file into a source, whatever bytes it holds."""

import os
import re
import stat
from collections.abc import Callable, Mapping
from pathlib import Path

from nddl_lang.text.source import Source

LARGEST = 64 * 2**20  # bytes of a file
_LOOKED_AT = 4096
_ODD = re.compile(r"[\x00-\x08\x0e-\x1a\x1c-\x1f]")
_MOST_ODD = 0.02  # of the characters of a text may be control characters
_MOST_UNREADABLE = 0.6  # and bytes that are not UTF-8: comments in another encoding may be long


def decode(content: bytes) -> str:
    """`content` as text; bytes that are not UTF-8 become U+FFFD, which the parser reports.

    A byte order mark stays, so that offsets agree with the file.
    """
    return content.decode("utf-8", errors="replace")


def is_text(text: str) -> bool:
    """Whether what was decoded is a text at all, with odd characters at most: looked at are the first ones."""
    head = text[:_LOOKED_AT]
    return len(_ODD.findall(head)) <= _MOST_ODD * len(head) + 1 and head.count("\ufffd") <= _MOST_UNREADABLE * len(head)


class NotAFileError(OSError):
    """What stands under a name cannot be read as a file; `strerror` says what it is."""


def read_text(path: Path) -> str | None:
    """The text of the file at `path`; None if there is no such file.

    Raises OSError if it cannot be read, is no regular file, or is larger than `LARGEST`: nothing that a model names is
    waited for or read without end.
    """
    try:
        file = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    except (FileNotFoundError, NotADirectoryError):
        return None
    with os.fdopen(file, "rb", buffering=0) as opened:
        kind = os.fstat(file)
        if not stat.S_ISREG(kind.st_mode):
            raise NotAFileError(0, f"it is {kind_of(kind.st_mode)}, not a file", str(path))
        return decode(_bounded(opened.read(LARGEST + 1) or b"", path))


def read_over(texts: Mapping[Path, str]) -> Callable[[Path], str | None]:
    """Reads files as `texts` have them, by their real paths, and others as they are."""
    return lambda path: texts[real] if (real := real_path(path)) in texts else read_text(path)


def read_source(path: Path | str) -> Source:
    """What the user named, a file or a pipe, as a source of that name; raises OSError if it cannot be read."""
    return Source(str(path), decode(read_named(Path(path))))


def read_named(path: Path) -> bytes:
    """The bytes of what the user named, a file or a pipe, up to `LARGEST` of them; raises OSError."""
    with path.open("rb") as opened:
        return _bounded(opened.read(LARGEST + 1), path)


def real_path(path: Path) -> Path:
    """The one name of a file, however it was reached; never raises, of links in a cycle it is one of them."""
    return Path(os.path.realpath(path))


def kind_of(mode: int) -> str:
    """What a mode of the file system stands for, with its article."""
    if stat.S_ISFIFO(mode):
        return "a pipe"
    if stat.S_ISSOCK(mode):
        return "a socket"
    return "a directory" if stat.S_ISDIR(mode) else "a device"


def _bounded(content: bytes, path: Path) -> bytes:
    if len(content) > LARGEST:
        raise NotAFileError(0, f"it is larger than {LARGEST // 2**20} MiB", str(path))
    return content
