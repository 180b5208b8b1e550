"""A client that starts the real server as a process and speaks the protocol with it, byte by byte."""

import asyncio
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

from lsp.project import ServerSettings
from lsp.server import make_session
from lsp.session import Session
from lsp.transport import receive

TIMEOUT = 240  # seconds; only a server that never answers uses them up
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
        self._errors.extend(self.process.stderr)

    # ---- messages ----

    def send_raw(self, content: bytes) -> None:
        """Send bytes as they are."""
        self._input.write(content)
        self._input.flush()

    def send_bytes(self, content: bytes) -> None:
        """Send something with a header that is right."""
        self.send_raw(b"Content-Length: %d\r\n\r\n%b" % (len(content), content))

    def next_message(self, patience: float) -> Message | None:
        """The next message of any kind, waited for so many seconds; None where the server has ended."""
        return self._messages.get(timeout=patience)

    def errors(self) -> str:
        """What was written to standard error."""
        return b"".join(self._errors).decode(errors="replace")

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
            assert message is not None, self.errors()
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


class Wire:
    """An editor in the same process: messages go in and come out as they do over a stream, thousands in a second."""

    def __init__(self, session: Session | None = None) -> None:
        self.session = session or make_session(ServerSettings(), lambda *_: ())
        self.session.protocol.set_writer(self)
        self.said: list[Message] = []
        self._loop = asyncio.new_event_loop()

    def write(self, content: bytes) -> None:
        """Take what the server says."""
        self.said.append(json.loads(content.partition(b"\r\n\r\n")[2]))

    def close(self) -> None:
        """Nothing is left to do."""

    def end(self) -> None:
        """The editor is gone."""
        self._loop.close()

    def send(self, *bodies: bytes) -> list[Message]:
        """What the server says to messages that arrive at once."""

        async def arrive() -> None:
            for body in bodies:
                receive(self.session, body)
            for _ in range(6):
                await asyncio.sleep(0)

        self.said = []
        self._loop.run_until_complete(arrive())
        return self.said

    def tell(self, method: str, **params: Any) -> list[Message]:
        """Send one notification."""
        return self.send(json.dumps({"jsonrpc": "2.0", "method": method, "params": params}).encode())

    def rest(self) -> list[Message]:
        """What the server says while nothing is edited, until it has looked for all repairs."""

        async def publish() -> None:
            self.session.publish(self.session.documents.repair(), is_late=True)

        self.said = []
        self._loop.run_until_complete(publish())
        return self.said

    def ask(self, method: str, **params: Any) -> Message:
        """Send one request; its whole answer."""
        body = json.dumps({"jsonrpc": "2.0", "id": 1, "method": method, "params": params}).encode()
        (answer,) = [each for each in self.send(body) if each.get("id") == 1]
        return answer

    def start(self, **capabilities: Any) -> None:
        """Begin the session."""
        self.ask("initialize", processId=None, rootUri=None, capabilities=capabilities)
        self.tell("initialized")

    def open(self, uri: str, text: str, version: int = 1) -> Message:
        """Open a text; what is wrong with it."""
        item = {"uri": uri, "languageId": "nddl", "version": version, "text": text}
        return published(self.tell("textDocument/didOpen", textDocument=item), uri)

    def change(self, uri: str, version: int, *edits: Message) -> Message:
        """Edit a text; what is wrong with it."""
        document = {"uri": uri, "version": version}
        return published(self.tell("textDocument/didChange", textDocument=document, contentChanges=list(edits)), uri)


def published(said: list[Message], uri: str) -> Message:
    """What was published last about a file."""
    found: list[Message] = [
        each["params"]
        for each in said
        if each.get("method") == "textDocument/publishDiagnostics" and each["params"]["uri"] == uri
    ]
    return found[-1]


@pytest.fixture
def wire() -> Iterator[Wire]:
    """A session in this process, nothing said yet."""
    session = Wire()
    yield session
    session.end()


@pytest.fixture
def make_wire() -> Iterator[Callable[..., Wire]]:
    """Makes sessions in this process."""
    sessions: list[Wire] = []

    def make(session: Session | None = None) -> Wire:
        sessions.append(Wire(session))
        return sessions[-1]

    yield make
    for session in sessions:
        session.end()
