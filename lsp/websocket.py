"""WebSocket (RFC 6455), the server's half: a connection in; whole messages out, and back.

A web page may open a connection to this machine, whoever wrote it. So pages of other hosts are refused.
"""

import base64
import hashlib
import socket
import struct
import threading
from urllib.parse import urlsplit

_MAGIC = b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
_LONGEST_HEAD = 16 * 1024
_LONGEST = 256 * 1024 * 1024
_HERE = frozenset({"localhost", "127.0.0.1", "::1"})
_CONTINUED, _TEXT, _BINARY, _CLOSE, _PING, _PONG = 0, 1, 2, 8, 9, 10


class WebSocket:
    """A connection after its handshake."""

    def __init__(self, connection: socket.socket) -> None:
        self._connection = connection
        self._left = b""
        self._sending = threading.Lock()  # who reads answers pings, another thread writes messages

    def shake_hands(self) -> bool:
        """Answer the request that opens a WebSocket; False, after a refusal, where it is none or is not from here."""
        while b"\r\n\r\n" not in self._left:
            if len(self._left) > _LONGEST_HEAD or not self._fill():
                return False
        head, _, self._left = self._left.partition(b"\r\n\r\n")
        fields = {}
        for line in head.decode("latin-1").split("\r\n")[1:]:
            name, _, value = line.partition(":")
            fields[name.strip().lower()] = value.strip()
        key = fields.get("sec-websocket-key")
        if fields.get("upgrade", "").lower() != "websocket" or not key:
            self._connection.sendall(b"HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n")
            return False
        origin = fields.get("origin")
        if _host(f"//{fields.get('host', '')}") not in _HERE or (origin is not None and _host(origin) not in _HERE):
            self._connection.sendall(b"HTTP/1.1 403 Forbidden\r\nContent-Length: 0\r\n\r\n")
            return False
        accept = base64.b64encode(hashlib.sha1(key.encode() + _MAGIC, usedforsecurity=False).digest())
        self._connection.sendall(
            b"HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            b"Sec-WebSocket-Accept: " + accept + b"\r\n\r\n"
        )
        return True

    def receive(self) -> bytes | None:
        """The next message; None at the end."""
        parts: list[bytes] = []
        while (frame := self._frame()) is not None:
            is_last, kind, content = frame
            if kind == _CLOSE:
                self._send(_CLOSE, content[:2])
                return None
            if kind == _PING:
                self._send(_PONG, content)
            elif kind in (_CONTINUED, _TEXT, _BINARY):
                parts.append(content)
                if sum(map(len, parts)) > _LONGEST:
                    return None
                if is_last:
                    return b"".join(parts)
        return None

    def write(self, content: bytes) -> None:
        """Send one message."""
        self._send(_TEXT, content)

    def close(self) -> None:
        """Say goodbye."""
        self._send(_CLOSE, b"")

    def _send(self, kind: int, content: bytes) -> None:
        size = len(content)
        if size < 126:
            head = struct.pack("!BB", 0x80 | kind, size)
        elif size < 1 << 16:
            head = struct.pack("!BBH", 0x80 | kind, 126, size)
        else:
            head = struct.pack("!BBQ", 0x80 | kind, 127, size)
        with self._sending:
            self._connection.sendall(head + content)

    def _frame(self) -> tuple[bool, int, bytes] | None:
        """Whether a frame ends its message, its kind and its content; None at the end, or where it breaks the rules."""
        head = self._take(2)
        if head is None:
            return None
        size = head[1] & 0x7F
        if size > 125:
            more = self._take(2 if size == 126 else 8)
            if more is None:
                return None
            size = int.from_bytes(more, "big")
        is_masked = bool(head[1] & 0x80)
        mask = self._take(4) if is_masked else None
        if mask is None or size > _LONGEST:  # a client masks what it sends
            return None
        content = self._take(size)
        if content is None:
            return None
        repeated = (mask * (size // 4 + 1))[:size]
        plain = int.from_bytes(content, "big") ^ int.from_bytes(repeated, "big")
        return bool(head[0] & 0x80), head[0] & 0x0F, plain.to_bytes(size, "big")

    def _take(self, count: int) -> bytes | None:
        parts, missing = [self._left], count - len(self._left)
        while missing > 0:
            part = self._connection.recv(max(missing, 1 << 16))
            if not part:
                return None
            parts.append(part)
            missing -= len(part)
        whole = b"".join(parts)
        self._left = whole[count:]
        return whole[:count]

    def _fill(self) -> bool:
        part = self._connection.recv(4096)
        self._left += part
        return bool(part)


def _host(address: str) -> str | None:
    try:
        return urlsplit(address).hostname
    except ValueError:
        return None
