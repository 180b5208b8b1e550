"""Lock bytes of a file between processes: they are free again when their holder ends, however that comes about."""

import os
import sys
import zlib
from pathlib import Path

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl


class Locks:
    """Names that this process has for itself among all that look at the same file."""

    def __init__(self, path: Path) -> None:
        self._file = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)

    def take(self, name: str) -> bool:
        """Lock a name; false where another process has it."""
        os.lseek(self._file, zlib.crc32(name.encode()), os.SEEK_SET)
        try:
            if sys.platform == "win32":
                msvcrt.locking(self._file, msvcrt.LK_NBLCK, 1)
            else:
                fcntl.lockf(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, 0, os.SEEK_CUR)
        except OSError:
            return False
        return True

    def close(self) -> None:
        """Let others have all of them."""
        os.close(self._file)
