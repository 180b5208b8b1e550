"""Read a file into a source, whatever bytes it holds."""

from pathlib import Path

from nddl_lang.text.source import Source


def decode(content: bytes) -> str:
    """`content` as text; bytes that are not UTF-8 become U+FFFD, which the parser reports.

    A byte order mark stays, so that offsets agree with the file.
    """
    return content.decode("utf-8", errors="replace")


def read_text(path: Path) -> str | None:
    """The text of the file at `path`; None if there is no such file. Raises OSError if it cannot be read."""
    try:
        return decode(path.read_bytes())
    except (FileNotFoundError, NotADirectoryError):
        return None


def read_source(path: Path | str) -> Source:
    """The file at `path` as a source of that name; raises OSError if it cannot be read."""
    return Source(str(path), decode(Path(path).read_bytes()))
