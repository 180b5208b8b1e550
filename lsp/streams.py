"""The wire of the protocol: standard streams, TCP or a WebSocket of this machine; bodies of messages in, bytes out.

Nothing of the language is loaded here, so that an editor gets its first answer before that is.
"""

import gc
import logging
import re
import socket
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from io import FileIO, RawIOBase
from typing import BinaryIO, Protocol

from lsp.websocket import WebSocket

_logger = logging.getLogger(__name__)
_LONGEST = 256 * 1024 * 1024
_BLOCK = 1 << 16
_LENGTH_NAME = re.compile(rb"\s*content-length\s*:", re.IGNORECASE)
_LENGTH = re.compile(rb"content-length\s*:\s*(\d{1,15})\s*$", re.IGNORECASE)
_WEB = (b"HTTP/1.0", b"HTTP/1.1", b"HTTP/2.0")
_LOOPBACK = "127.0.0.1"


class Wire(Protocol):
    """An editor at the other end: the bodies of its messages, and where ours go, with headers before them or not."""

    has_headers: bool

    def messages(self) -> Iterator[bytes]: ...

    def write(self, content: bytes) -> None: ...

    def close(self) -> None: ...


class _Stream:
    """A pair of streams; whoever does not listen any more misses what is written."""

    has_headers = True

    def __init__(self, given: RawIOBase, told: BinaryIO) -> None:
        self._given = given
        self._told = told

    def messages(self) -> Iterator[bytes]:
        """The body of each message, to the end of the stream.

        Names of header fields are written in any case. A header without a length is passed over, up to the next one. A
        header is found again also behind the rest of a body whose length was wrong.
        """
        stream = _Reader(self._given)
        length: int | None = None
        while line := stream.readline(8192):
            if line.rstrip().endswith(_WEB):
                return  # a page in a browser, whoever wrote it
            if (header := _LENGTH.search(line)) is not None:
                length = int(header[1]) if int(header[1]) <= _LONGEST else None
            elif _LENGTH_NAME.match(line) is not None:
                length = None
            elif not line.strip() and length is not None:
                body = stream.read(length)
                if len(body) < length:
                    return
                yield body
                length = None

    def write(self, content: bytes) -> None:
        """Send at once."""
        try:
            self._told.write(content)
            self._told.flush()
        except (OSError, ValueError):
            _logger.debug("nobody listens")

    def close(self) -> None:
        """End the stream."""
        try:
            self._told.close()
        except OSError:
            _logger.debug("nobody listens")


class _Reader:
    """Lines and blocks of a stream that is not buffered: at the end of the process nobody waits for a lock on it."""

    def __init__(self, stream: RawIOBase) -> None:
        self._stream = stream
        self._left = b""

    def readline(self, limit: int) -> bytes:
        """The next line, or its first `limit` bytes; empty at the end."""
        while (end := self._left.find(b"\n") + 1) == 0 and len(self._left) < limit and self._fill():
            pass
        return self._take(min(end or len(self._left), limit))

    def read(self, count: int) -> bytes:
        """The next `count` bytes, fewer at the end."""
        if count > len(self._left):
            parts = [self._left]
            missing = count - len(self._left)
            while missing > 0 and (part := self._stream.read(max(missing, _BLOCK))):
                parts.append(part)
                missing -= len(part)
            self._left = b"".join(parts)
        return self._take(count)

    def _take(self, count: int) -> bytes:
        taken, self._left = self._left[:count], self._left[count:]
        return taken

    def _fill(self) -> bool:
        part = self._stream.read(_BLOCK)
        self._left += part or b""
        return bool(part)


class _Web:
    """A WebSocket after its handshake, in which each message is one of the protocol."""

    has_headers = False

    def __init__(self, socket_: WebSocket) -> None:
        self._socket = socket_
        self.write = socket_.write
        self.close = socket_.close

    def messages(self) -> Iterator[bytes]:
        """The messages, to the end of the connection."""
        while (body := self._socket.receive()) is not None:
            yield body


@contextmanager
def open_wire(port: int | None, *, is_web: bool, tell: Callable[[int], None]) -> Iterator[Wire | None]:
    """The wire to one editor: standard streams, or, with a port, who comes first there; None where nobody may speak.

    `tell` learns the port, a free one for 0.
    """
    if port is None:
        with FileIO(sys.stdin.fileno(), closefd=False) as given:
            yield _Stream(given, sys.stdout.buffer)
        return
    with _accepted(port, tell) as connection:
        if is_web:
            web = WebSocket(connection)
            yield _Web(web) if web.shake_hands() else None
        else:
            with connection.makefile("rb", buffering=0) as given, connection.makefile("wb") as told:
                yield _Stream(given, told)


def _accepted(port: int, tell: Callable[[int], None]) -> socket.socket:
    """The first connection to a port of this machine."""
    with socket.create_server((_LOOPBACK, port)) as server:
        tell(server.getsockname()[1])
        return server.accept()[0]


def calm_collector() -> None:
    """Look for garbage rarely: what an open model consists of lives long, and to look through it costs a keystroke."""
    gc.set_threshold(100_000, 10, 10)
