"""What each question of an editor costs: processor time of the server at p95, on 1000 lines, beside the goals.

Messages go in as text and come out as text: reading, analysis, answer and writing are counted.
`python bench/editor.py [ROUNDS]`; ends with 1 where a goal is missed.
"""

import asyncio
import itertools
import json
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from keystroke import UNIT  # type: ignore[import-not-found]  # beside this file

from lsp.project import ServerSettings
from lsp.server import make_session
from lsp.streams import calm_collector
from lsp.transport import receive

LINES = 1000
FILES = 20
ROUNDS = 200
URI = "untitled:model"
WHOLE = {"start": {"line": 0, "character": 0}, "end": {"line": 10_000_000, "character": 0}}

# Method, the goal in milliseconds at p95.
GOALS = {
    "hover": 10,
    "definition": 10,
    "references": 10,
    "documentHighlight": 10,
    "implementation": 10,
    "completion": 30,
    "signatureHelp": 10,
    "semanticTokens/full": 20,
    "semanticTokens/full/delta": 5,
    "semanticTokens/range": 20,
    "documentSymbol": 20,
    "foldingRange": 20,
    "inlayHint": 20,
    "codeLens": 20,
    "codeAction": 20,
    "prepareRename": 10,
    "rename": 50,
}


class Wire:
    """An editor in the same process: what the server writes is kept, and when the answer came."""

    def __init__(self) -> None:
        self.session = make_session(ServerSettings(), lambda *_: ())
        self.session.protocol.set_writer(self)
        self._numbers = itertools.count(1)
        self._told: list[Any] = []

    def write(self, content: bytes) -> None:
        """Take what the server says."""
        self._told.append(json.loads(content.partition(b"\r\n\r\n")[2]))

    def close(self) -> None:
        """Nothing is left to do."""

    def tell(self, method: str, **params: Any) -> None:
        """Send what is not answered."""
        receive(self.session, json.dumps({"jsonrpc": "2.0", "method": method, "params": params}).encode())

    async def ask(self, method: str, **params: Any) -> Any:
        """Send a request and wait for its answer."""
        number = next(self._numbers)
        body = {"jsonrpc": "2.0", "id": number, "method": method, "params": params}
        receive(self.session, json.dumps(body).encode())
        return (await self.told(lambda each: each.get("id") == number)).get("result")

    def heard(self) -> list[Any]:
        """What was said since somebody asked last."""
        heard, self._told = self._told, []
        return heard

    async def told(self, is_wanted: Callable[[Any], bool]) -> Any:
        """The first message of that kind; others are dropped."""
        while True:
            for message in self.heard():
                if is_wanted(message):
                    return message
            await asyncio.sleep(0)


def model(lines: int) -> str:
    """A model of so many lines."""
    return "".join(UNIT.format(number) for number in range(lines // UNIT.count("\n")))


def p95(times: list[float]) -> float:
    """The time that 95 of 100 stay below, in milliseconds."""
    return sorted(times)[max(0, -(-len(times) * 95 // 100) - 1)] * 1000


async def edits(wire: Wire, text: str, rounds: int, uri: str = URI) -> list[float]:
    """Type into rules, declarations and comments all over the text."""
    marks = [found for mark in ("duration >= 3", "float share", "Timeline ") for found in places(text, mark)]
    step = max(1, len(marks) * 2 // rounds)
    times = []
    version = 2
    for line, column in itertools.islice(itertools.cycle(marks[::step]), rounds // 2):
        for letters, end in (("x", column), ("", column + 1)):
            place = {"start": {"line": line, "character": column}, "end": {"line": line, "character": end}}
            begun = time.process_time()
            document = {"uri": uri, "version": version}
            wire.tell(
                "textDocument/didChange", textDocument=document, contentChanges=[{"range": place, "text": letters}]
            )
            await wire.told(lambda each: each.get("method") == "textDocument/publishDiagnostics")
            times.append(time.process_time() - begun)
            version += 1
    return times


def places(text: str, mark: str) -> list[tuple[int, int]]:
    """Line and column of each `mark`, one character into it."""
    return [(number, line.index(mark) + 1) for number, line in enumerate(text.split("\n")) if mark in line]


async def opened(lines: int) -> tuple[Wire, str, float]:
    """A session with a model of so many lines open, and what opening cost."""
    wire = Wire()
    await wire.ask("initialize", processId=None, rootUri=None, capabilities={})
    text = model(lines)
    begun = time.process_time()
    item = {"uri": URI, "languageId": "nddl", "version": 1, "text": text}
    wire.tell("textDocument/didOpen", textDocument=item)
    await wire.told(lambda each: each.get("method") == "textDocument/publishDiagnostics")
    return wire, text, time.process_time() - begun


async def workspace(folder: Path) -> tuple[Wire, dict[str, str]]:
    """A session with a model of many files open, and the texts of its first and last file by their URIs."""
    texts = [UNIT.format(f"{file}_{{0}}") for file in range(FILES)]
    parts = {}
    for number, unit in enumerate(texts):
        path = folder / f"part{number}.nddl"
        path.write_text("".join(unit.replace("{0}", str(each)) for each in range(LINES // unit.count("\n"))))
        if number in (0, FILES - 1):
            parts[path.as_uri()] = path.read_text()
    whole = "".join(f'#include "part{number}.nddl"\n' for number in range(FILES))
    (folder / "model.nddl").write_text(whole)
    wire = Wire()
    await wire.ask("initialize", processId=None, rootUri=folder.as_uri(), capabilities={})
    for uri, content in {(folder / "model.nddl").as_uri(): whole, **parts}.items():
        item = {"uri": uri, "languageId": "nddl", "version": 1, "text": content}
        wire.tell("textDocument/didOpen", textDocument=item)
        await wire.told(lambda message: message.get("method") == "textDocument/publishDiagnostics")
    return wire, parts


async def cancelled(wire: Wire, rounds: int) -> list[float]:
    """Ask for the outline many times at once, and take all back; until each is answered that it was taken back.

    They stand behind an edit that is not analysed yet.
    """
    numbers = itertools.count(1_000_000)
    times = []
    for version in range(rounds):
        edit = {"range": {"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 0}}, "text": " "}
        versioned = {"uri": URI, "version": 200_000 + version}
        wire.tell("textDocument/didChange", textDocument=versioned, contentChanges=[edit])
        asked = set(itertools.islice(numbers, 20))
        for number in asked:
            params = {"textDocument": {"uri": URI}}
            body = {"jsonrpc": "2.0", "id": number, "method": "textDocument/documentSymbol", "params": params}
            receive(wire.session, json.dumps(body).encode())
        begun = time.process_time()
        for number in asked:
            wire.tell("$/cancelRequest", id=number)
        while asked:
            await asyncio.sleep(0)
            asked.difference_update(each["id"] for each in wire.heard() if each.get("error", {}).get("code") == -32800)
        times.append(time.process_time() - begun)
    return times


async def question(wire: Wire, method: str, text: str, rounds: int) -> list[float]:
    """Ask one thing all over the text."""
    found = places(text, "load > 3") + places(text, "meets(Idle") + places(text, "class Unit")
    document = {"uri": URI}
    times = []
    result = None
    for number in range(rounds):
        line, column = found[number * 7 % len(found)]
        params: dict[str, Any] = {"textDocument": document, "position": {"line": line, "character": column + 7}}
        match method:
            case "references":
                params["context"] = {"includeDeclaration": True}
            case "rename":
                params["newName"] = f"fresh{number}"
            case "semanticTokens/range" | "inlayHint":
                start, end = {"line": line, "character": 0}, {"line": line + 60, "character": 0}
                params["range"] = {"start": start, "end": end}
            case "codeAction":
                params |= {"range": WHOLE, "context": {"diagnostics": []}}
            case "semanticTokens/full/delta":
                edit = {
                    "range": {"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 0}},
                    "text": "\n",
                }
                versioned = {"uri": URI, "version": 100_000 + number}
                wire.tell("textDocument/didChange", textDocument=versioned, contentChanges=[edit])
                await wire.told(lambda each: each.get("method") == "textDocument/publishDiagnostics")
                params["previousResultId"] = result["resultId"] if result else "0"
            case _:
                pass
        begun = time.process_time()
        result = await wire.ask(f"textDocument/{method}", **params)
        times.append(time.process_time() - begun)
    return times[1:]


def show(what: str, found: float, goal: float, unit: str = "ms") -> bool:
    """Print a figure beside its goal; whether it is reached."""
    print(f"{what:34} {found:8.2f} {unit}   goal {goal:6.0f}{'' if found <= goal else '   MISSED'}")
    return found <= goal


async def main(rounds: int) -> int:
    """Measure everything."""
    calm_collector()
    wire, text, spent = await opened(LINES)
    print(f"{text.count(chr(10))} lines, opened in {spent * 1000:.0f} ms; p95 of {rounds}")
    held = [show("edit to all diagnostics", p95(await edits(wire, text, rounds)), 10)]
    for method, goal in GOALS.items():
        held.append(show(method, p95(await question(wire, method, text, rounds)), goal))
    held.append(show("20 questions taken back", p95(await cancelled(wire, rounds)), 20))
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    held.append(show("memory", memory, 100, "MB"))
    answered, told = starting()
    held.append(show("start to initialized", answered * 1000, 400))
    held.append(show("start to the first diagnostics", told * 1000, 1000))
    with tempfile.TemporaryDirectory() as folder:
        wire, parts = await workspace(Path(folder))
        for where, (uri, text) in zip(("first", "last"), parts.items(), strict=True):
            times = await edits(wire, text, max(8, rounds // 4), uri)
            held.append(show(f"edit in {FILES * LINES} lines, {where} file", p95(times), 100))
    return int(not all(held))


def starting() -> tuple[float, float]:
    """Processor seconds of a server from its start to its answer to `initialize`, and to the first diagnostics.

    Each the least of three; seconds of the clock where the system does not tell what a process has used.
    """
    times = []
    for _ in range(3):
        begun = time.perf_counter()
        with subprocess.Popen(
            [sys.executable, "-m", "nddlc.main", "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        ) as process:
            assert process.stdin is not None and process.stdout is not None
            begin = {"id": 1, "method": "initialize", "params": {"processId": None, "capabilities": {}}}
            item = {"uri": URI, "languageId": "nddl", "version": 1, "text": "int x = y;"}
            spent = []
            for message in begin, {"method": "textDocument/didOpen", "params": {"textDocument": item}}:
                body = json.dumps({"jsonrpc": "2.0", **message}).encode()
                process.stdin.write(b"Content-Length: %d\r\n\r\n%b" % (len(body), body))
                process.stdin.flush()
                length = [int(line.split()[1]) for line in iter(process.stdout.readline, b"\r\n") if b"Length" in line]
                process.stdout.read(length[0])
                spent.append(used(process.pid) or time.perf_counter() - begun)
            times.append(spent)
            process.stdin.close()
    first, second = zip(*times, strict=True)
    return min(first), min(second)


def used(process: int) -> float:
    """Processor seconds of all threads of a process and of those that it started; 0 where the system does not tell.

    The server runs beside a process that watches it.
    """
    threads = [*Path(f"/proc/{process}/task").glob("*")]
    started = [int(each) for thread in threads for each in (thread / "children").read_text().split()]
    own = sum(int((thread / "schedstat").read_text().split()[0]) for thread in threads) / 1e9
    return own + sum(map(used, started))


if __name__ == "__main__":
    sys.exit(asyncio.run(main(int(sys.argv[1]) if len(sys.argv) > 1 else ROUNDS)))
