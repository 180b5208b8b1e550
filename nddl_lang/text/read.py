"""Read a file into a source, whatever bytes it holds."""

from pathlib import Path

from nddl_lang.text.source import Source

_LOOKED_AT = 4096
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
    odd = sum(sign < " " and sign not in "\t\n\v\f\r\x1b" for sign in head)
    return odd <= _MOST_ODD * len(head) + 1 and head.count("\ufffd") <= _MOST_UNREADABLE * len(head)


def read_text(path: Path) -> str | None:
    """The text of the file at `path`; None if there is no such file. Raises OSError if it cannot be read."""
    try:
        return decode(path.read_bytes())
    except (FileNotFoundError, NotADirectoryError):
        return None


def read_source(path: Path | str) -> Source:
    """The file at `path` as a source of that name; raises OSError if it cannot be read."""
    return Source(str(path), decode(Path(path).read_bytes()))
