"""The wire of the protocol: bytes in, messages to the session; standard streams, TCP and WebSocket, on this machine.

A thread reads, so that what arrives while something is computed is known as soon as that is done.
"""

import asyncio
import json
import logging
import socket
import sys
import threading
from collections.abc import Callable
from io import FileIO, RawIOBase
from typing import BinaryIO, Protocol

from lsp.session import Session
from lsp.websocket import WebSocket

_logger = logging.getLogger(__name__)
_LONGEST = 256 * 1024 * 1024
_BLOCK = 1 << 16
_WEB = (b"HTTP/1.0", b"HTTP/1.1", b"HTTP/2.0")
_LOOPBACK = "127.0.0.1"


class _Writer:
    """Writes messages to a stream; whoever does not listen any more misses them."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream

    def write(self, content: bytes) -> None:
        """Send at once."""
        try:
            self._stream.write(content)
            self._stream.flush()
        except (OSError, ValueError):
            _logger.debug("nobody listens")

    def close(self) -> None:
        """End the stream."""
        try:
            self._stream.close()
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


def _read_messages(raw: RawIOBase, take: Callable[[bytes], None]) -> None:
    """Hand over the body of each message of a stream, to its end.

    Names of header fields are written in any case. A header without a length is passed over, up to the next one.
    """
    stream = _Reader(raw)
    length: int | None = None
    while line := stream.readline(8192):
        if line.rstrip().endswith(_WEB):
            return  # a page in a browser, whoever wrote it
        name, _, value = line.partition(b":")
        if name.strip().lower() == b"content-length":
            length = int(value) if value.strip().isdigit() and len(value) < 16 else None
        elif not line.strip() and length is not None:
            if length > _LONGEST:
                return
            body = stream.read(length)
            if len(body) < length:
                return
            take(body)
            length = None


class _Wire(Protocol):
    """What the server writes to."""

    def write(self, content: bytes) -> None: ...

    def close(self) -> None: ...


# Hands over messages until there are no more.
_Read = Callable[[Callable[[bytes], None]], None]


async def _pump(session: Session, read: _Read) -> None:
    loop = asyncio.get_running_loop()
    is_over = asyncio.Event()

    def take(body: bytes) -> None:
        loop.call_soon_threadsafe(receive, session, body)

    def read_all() -> None:
        try:
            read(take)
        except (OSError, ValueError):
            _logger.debug("the editor is gone")
        loop.call_soon_threadsafe(is_over.set)

    # A daemon: it may wait for a message while the process ends.
    threading.Thread(target=read_all, daemon=True).start()
    await is_over.wait()


def _speak(session: Session, read: _Read, writer: _Wire, *, has_headers: bool = True) -> None:
    """Speak until the editor leaves."""
    session.protocol.set_writer(writer, include_headers=has_headers)
    asyncio.run(_pump(session, read))


def receive(session: Session, body: bytes) -> None:
    """Look at one message."""
    try:
        session.protocol.handle_message(json.loads(body, object_hook=session.protocol.structure_message))
    except Exception as mistake:  # of whoever wrote the message
        session.report_server_error(mistake, None)


def serve_standard_streams(session: Session) -> None:
    """Speak over standard input and output."""
    with FileIO(sys.stdin.fileno(), closefd=False) as given:
        _speak(session, lambda take: _read_messages(given, take), _Writer(sys.stdout.buffer))


def serve_tcp(session: Session, port: int, tell: Callable[[int], None]) -> None:
    """Wait on this machine for one editor and speak with it; `tell` learns the port, a free one for 0."""
    with (
        _accepted(port, tell) as connection,
        connection.makefile("rb", buffering=0) as given,
        connection.makefile("wb") as told,
    ):
        _speak(session, lambda take: _read_messages(given, take), _Writer(told))


def serve_websocket(session: Session, port: int, tell: Callable[[int], None]) -> None:
    """The same over a WebSocket, in which each message is one of the protocol."""
    with _accepted(port, tell) as connection:
        web = WebSocket(connection)
        if not web.shake_hands():
            return

        def read(take: Callable[[bytes], None]) -> None:
            while (body := web.receive()) is not None:
                take(body)

        _speak(session, read, web, has_headers=False)


def _accepted(port: int, tell: Callable[[int], None]) -> socket.socket:
    """The first connection to a port of this machine."""
    with socket.create_server((_LOOPBACK, port)) as server:
        tell(server.getsockname()[1])
        return server.accept()[0]
