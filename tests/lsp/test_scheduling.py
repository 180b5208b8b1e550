"""What is looked at when: the newest edit wins, what is taken back is not computed, nothing hostile ends the session.

A short form by default; `make editor-proof` (NDDLC_EDITOR=all) runs 100,000 edit scripts.
"""

import json
import os
import random
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.lsp.hostile import MODEL, URI

ROOT = Path(__file__).resolve().parents[2]
IS_ALL = os.environ.get("NDDLC_EDITOR") == "all"
SCRIPTS = 100_000 if IS_ALL else 150
FRAGMENTS = [*'{}();,.:=[]"\r\n🛰 é/*', "//", "class C ", "predicate p", "Gps::Busy", "int x", "new ", "this", "before "]


def body(method: str, number: Any = None, **params: Any) -> bytes:
    message = {"jsonrpc": "2.0", "method": method, "params": params}
    return json.dumps({**message, "id": number} if number is not None else message).encode()


def changed(version: int, text: str) -> bytes:
    document = {"uri": URI, "version": version}
    return body("textDocument/didChange", textDocument=document, contentChanges=[{"text": text}])


def test_of_several_edits_only_the_newest_text_is_analysed(wire: Any) -> None:
    wire.start()
    wire.open(URI, "int a;\n")
    said = wire.send(*(changed(version, f"int a = {'x' * version};\n") for version in range(2, 30)))
    (told,) = [each["params"] for each in said if each["method"] == "textDocument/publishDiagnostics"]
    assert told["version"] == 29
    assert "`" + "x" * 29 + "`" in told["diagnostics"][0]["message"]


def test_an_answer_knows_the_edits_before_it(wire: Any) -> None:
    wire.start()
    wire.open(URI, "int a;\n")
    position = {"line": 0, "character": 4}
    said = wire.send(
        changed(2, "int b;\n"), body("textDocument/hover", 5, textDocument={"uri": URI}, position=position)
    )
    (answer,) = [each for each in said if each.get("id") == 5]
    assert "int b" in answer["result"]["contents"]["value"]


def test_what_is_taken_back_before_its_turn_is_not_computed(wire: Any) -> None:
    wire.start()
    wire.open(URI, MODEL)
    document = {"uri": URI}
    said = wire.send(
        body("textDocument/semanticTokens/full", 7, textDocument=document),
        body("textDocument/documentSymbol", 8, textDocument=document),
        body("$/cancelRequest", id=7),
    )
    answers = {each["id"]: each for each in said if "id" in each}
    assert answers[7]["error"]["code"] == -32800
    assert answers[8]["result"]


def test_after_any_edits_the_session_knows_what_a_fresh_one_knows(make_wire: Any) -> None:
    dice = random.Random(20)
    wire = make_wire()
    wire.start()
    wire.open(URI, MODEL)
    text, version = MODEL, 1
    for number in range(SCRIPTS):
        if number % 25 == 0 or len(text) > 3000:
            text, version = MODEL, version + 1
            wire.change(URI, version, {"text": text})
        edits = []
        for _ in range(dice.randint(1, 4)):
            begin = dice.randint(0, len(text))
            end = min(len(text), begin + dice.choice((0, 0, 1, 3, 20)))
            new = "".join(dice.choice(FRAGMENTS) for _ in range(dice.randint(0, 3)))
            lines = wire.session.documents.find(URI).lines
            # Offsets inside of CR LF or of a letter of two units are moved to where an editor can be.
            begin, end = (lines.offset(lines.position(each)) for each in (begin, end))
            place = {"start": where(lines, begin), "end": where(lines, end)}
            edits.append({"range": place, "text": new})
            text = text[:begin] + new + text[end:]
            version += 1
            told = wire.change(URI, version, edits[-1])
            assert wire.session.documents.find(URI).lines.text == text
        if number % (1000 if IS_ALL else 10) == 0:
            fresh = make_wire()
            fresh.start()
            assert told["diagnostics"] == fresh.open(URI, text)["diagnostics"]
            tokens = [
                each.ask("textDocument/semanticTokens/full", textDocument={"uri": URI})["result"]["data"]
                for each in (wire, fresh)
            ]
            assert tokens[0] == tokens[1]


def where(lines: Any, offset: int) -> dict[str, int]:
    position = lines.position(offset)
    return {"line": position.line, "character": position.character}


@pytest.mark.parametrize("name", [b"content-length", b"CONTENT-LENGTH", b"Content-Type: x\r\ncontent-Length"])
def test_the_name_of_a_header_may_be_written_in_any_case(client: Any, name: bytes) -> None:
    content = body("initialize", 1, processId=None, rootUri=None, capabilities={})
    client.process.stdin.write(name + b": %d\r\n\r\n%b" % (len(content), content))
    client.process.stdin.flush()
    assert "capabilities" in client.wait(lambda message: message.get("id") == 1)["result"]


def test_a_header_without_a_length_does_not_lose_the_stream(client: Any) -> None:
    client.process.stdin.write(b"nonsense\r\n\r\nContent-Length: -4\r\n\r\n\r\nContent-Length: 1e9\r\n\r\n")
    client.start()
    assert client.open(URI, "int a;")["diagnostics"] == []
    assert client.leave() == 0


def test_an_editor_may_come_over_a_port_of_this_machine() -> None:
    process = subprocess.Popen(
        [sys.executable, "-m", "nddlc.main", "lsp", "--port", "0"], stdout=subprocess.PIPE, cwd=ROOT
    )
    assert process.stdout is not None
    try:
        port = int(process.stdout.readline().split()[-1])
        with socket.create_connection(("127.0.0.1", port), 30) as connection:
            content = body("initialize", 1, processId=None, rootUri=None, capabilities={})
            connection.sendall(b"Content-Length: %d\r\n\r\n%b" % (len(content), content))
            assert connection.recv(20).startswith(b"Content-Length")
            content = body("exit")
            connection.sendall(b"Content-Length: %d\r\n\r\n%b" % (len(content), content))
        assert process.wait(60) == 1
    finally:
        process.kill()
        process.wait()
        process.stdout.close()


def request(origin: str, host: str = "localhost") -> bytes:
    return (
        f"GET / HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        f"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n{origin}\r\n"
    ).encode()


def masked(content: bytes, kind: int = 1, *, is_last: bool = True) -> bytes:
    head = bytes([0x80 * is_last | kind]) + (
        bytes([0x80 | len(content)]) if len(content) < 126 else b"\xfe" + len(content).to_bytes(2, "big")
    )
    mask = b"\x01\x02\x03\x04"
    return head + mask + bytes(each ^ mask[at % 4] for at, each in enumerate(content))


@pytest.fixture
def web() -> Iterator[tuple[subprocess.Popen[bytes], socket.socket]]:
    """A server that waits for a WebSocket, and a connection to it, nothing said yet."""
    command = [sys.executable, "-m", "nddlc.main", "lsp", "--port", "0", "--websocket"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, cwd=ROOT) as process:
        assert process.stdout is not None
        port = int(process.stdout.readline().split()[-1])
        with socket.create_connection(("127.0.0.1", port), 60) as connection:
            yield process, connection
        process.kill()


def test_a_page_of_this_machine_may_come_over_a_websocket(web: tuple[subprocess.Popen[bytes], socket.socket]) -> None:
    process, connection = web
    connection.sendall(request("Origin: http://localhost:3000\r\n"))
    with connection.makefile("rb") as stream:
        head = b"".join(iter(stream.readline, b"\r\n"))
        assert b"101" in head
        assert b"s3pPLMBiTxaQ9kYGzzhZRbK+xOo=" in head  # of RFC 6455, 1.3
        connection.sendall(masked(b"hello", 9))
        assert stream.read(7) == b"\x8a\x05hello"
        content = body("initialize", 1, processId=None, rootUri=None, capabilities={})
        connection.sendall(masked(content[:40], is_last=False) + masked(content[40:], 0))
        kind, size = stream.read(2)
        assert (kind, size) == (0x81, 126)
        answer = json.loads(stream.read(int.from_bytes(stream.read(2), "big")))
        assert answer["id"] == 1
        connection.sendall(masked(b"\x03\xe8", 8))
        assert process.wait(60) == 1


@pytest.mark.parametrize(
    ("origin", "host"),
    [("Origin: https://example.org\r\n", "localhost"), ("", "example.org"), ("Origin: null\r\n", "localhost")],
)
def test_a_page_of_elsewhere_is_refused(
    web: tuple[subprocess.Popen[bytes], socket.socket], origin: str, host: str
) -> None:
    process, connection = web
    connection.sendall(request(origin, host))
    assert connection.recv(100).startswith(b"HTTP/1.1 403")
    assert process.wait(60) == 1


def test_a_page_cannot_speak_to_the_plain_port(client: Any) -> None:
    content = body("initialize", 1, processId=None, rootUri=None, capabilities={})
    client.process.stdin.write(b"POST / HTTP/1.1\r\nContent-Length: %d\r\n\r\n%b" % (len(content), content))
    client.process.stdin.flush()
    assert client.process.wait(60) == 1
