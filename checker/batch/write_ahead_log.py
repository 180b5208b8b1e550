"""The write-ahead log beside a store in, why SQLite would drop it without a word out.

What was written last may be in the log alone. SQLite takes one whose header it cannot read for an empty one, and writes
over it (https://www.sqlite.org/fileformat2.html#walformat).
"""

import struct
from pathlib import Path

_HEADER = 32
_MAGIC = 0x377F0682  # the last bit says in which order of bytes checksums are reckoned
_VERSION = 3007000


def log_damage(place: Path, store: Path) -> str:
    """What is wrong with the log of a store at `place`; empty where there is none, or nothing is wrong with its header.

    The log is called as that of `store`.
    """
    try:
        with Path(f"{place}-wal").open("rb") as log:
            header = log.read(_HEADER)
    except OSError:
        return ""
    if len(header) < _HEADER:
        return ""  # nothing was ever written to it
    magic, version = struct.unpack(">II", header[:8])
    if magic & ~1 != _MAGIC:
        return f"`{store}-wal`, which has what was written last, is no log of SQLite"
    order = ">" if magic & 1 else "<"
    words = struct.unpack(f"{order}6I", header[:24])
    first = second = 0
    for even, odd in zip(words[::2], words[1::2], strict=True):
        first = (first + even + second) & 0xFFFFFFFF
        second = (second + odd + first) & 0xFFFFFFFF
    if struct.unpack(">II", header[24:]) != (first, second):
        return f"`{store}-wal`, which has what was written last, is damaged"
    return "" if version == _VERSION else f"`{store}-wal` is of another version of SQLite ({version})"
