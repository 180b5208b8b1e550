"""A client that starts the real server as a process and speaks the protocol with it, byte by byte."""

import itertools
import json
import queue
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

TIMEOUT = 60  # seconds; only a server that never answers uses them up
Message = dict[str, Any]


class Client:
    """One editor session; `wait` looks at messages in the order in which they come."""

    def __init__(self, *options: str, directory: Path | None = None) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "nddlc.main", "lsp", *options],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            cwd=directory or Path(__file__).resolve().parents[2],
        )
        assert self.process.stdin is not None
        self._input = self.process.stdin
        self._messages: queue.Queue[Message | None] = queue.Queue()
        self._numbers = itertools.count(1)
        self.versions: dict[str, int] = {}
        threading.Thread(target=self._read, daemon=True).start()
        self._errors: list[bytes] = []
        threading.Thread(target=self._drain, daemon=True).start()

    def _read(self) -> None:
        output = self.process.stdout
        assert output is not None
        while header := output.readline():
            length = 0
            while header.strip():
                name, _, value = header.partition(b":")
                if name.lower() == b"content-length":
                    length = int(value)
                header = output.readline()
            self._messages.put(json.loads(output.read(length)))
        self._messages.put(None)

    def _drain(self) -> None:
        assert self.process.stderr is not None
        self._errors += self.process.stderr

    # ---- messages ----

    def send_bytes(self, content: bytes) -> None:
        """Send something with a header that is right."""
        self._input.write(b"Content-Length: %d\r\n\r\n%b" % (len(content), content))
        self._input.flush()

    def send(self, **message: Any) -> None:
        """Send one message."""
        self.send_bytes(json.dumps({"jsonrpc": "2.0", **message}).encode())

    def notify(self, method: str, **params: Any) -> None:
        """Send what is not answered."""
        self.send(method=method, params=params)

    def ask(self, method: str, **params: Any) -> Any:
        """Send a request and wait for its answer; the whole answer where it is an error."""
        number = next(self._numbers)
        self.send(id=number, method=method, params=params)
        answer = self.wait(lambda message: message.get("id") == number)
        return answer if "error" in answer else answer["result"]

    def wait(self, is_wanted: Callable[[Message], bool]) -> Message:
        """The next message of that kind; others that come before it are passed over."""
        while True:
            message = self._messages.get(timeout=TIMEOUT)
            assert message is not None, b"".join(self._errors).decode()
            if is_wanted(message):
                return message

    def complaints(self, uri: str) -> Message:
        """What is published next about a file."""

        def is_about(message: Message) -> bool:
            return message.get("method") == "textDocument/publishDiagnostics" and message["params"]["uri"] == uri

        params: Message = self.wait(is_about)["params"]
        return params

    # ---- what editors do ----

    def start(
        self,
        options: Message | None = None,
        encodings: list[str] | None = None,
        folder: Path | None = None,
        capabilities: Message | None = None,
    ) -> Message:
        """Begin the session; what the server says it can do."""
        able = {**(capabilities or {}), **({"general": {"positionEncodings": encodings}} if encodings else {})}
        uri = folder.as_uri() if folder is not None else None
        folders = [{"uri": uri, "name": "folder"}] if folder is not None else None
        answer: Message = self.ask(
            "initialize",
            processId=None,
            rootUri=uri,
            workspaceFolders=folders,
            capabilities=able,
            initializationOptions=options,
        )
        self.notify("initialized")
        offered: Message = answer["capabilities"]
        return offered

    def ask_at(self, method: str, uri: str, line: int, character: int, **params: Any) -> Any:
        """Ask about a place."""
        position = {"line": line, "character": character}
        return self.ask(f"textDocument/{method}", textDocument={"uri": uri}, position=position, **params)

    def open(self, uri: str, text: str) -> Message:
        """Open a text; what is wrong with it."""
        self.versions[uri] = 1
        item = {"uri": uri, "languageId": "nddl", "version": 1, "text": text}
        self.notify("textDocument/didOpen", textDocument=item)
        return self.complaints(uri)

    def change(self, uri: str, *edits: Message) -> Message:
        """Edit a text; what is wrong with it."""
        self.versions[uri] += 1
        document = {"uri": uri, "version": self.versions[uri]}
        self.notify("textDocument/didChange", textDocument=document, contentChanges=list(edits))
        return self.complaints(uri)

    def hover(self, uri: str, line: int, character: int) -> str | None:
        """What is shown at a place."""
        position = {"line": line, "character": character}
        answer = self.ask("textDocument/hover", textDocument={"uri": uri}, position=position)
        return None if answer is None else str(answer["contents"]["value"])

    def leave(self) -> int:
        """Say goodbye; the exit code."""
        self.ask("shutdown")
        self.send(method="exit")
        return self.process.wait(TIMEOUT)

    def kill(self) -> None:
        """End the process if it still runs."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()


@pytest.fixture
def client() -> Iterator[Client]:
    """A server that has just been started, nothing said yet."""
    session = Client()
    yield session
    session.kill()


@pytest.fixture
def start_client() -> Iterator[Callable[..., Client]]:
    """Starts servers with options of their own."""
    sessions: list[Client] = []

    def start(*options: str, directory: Path | None = None) -> Client:
        sessions.append(Client(*options, directory=directory))
        return sessions[-1]

    yield start
    for session in sessions:
        session.kill()
