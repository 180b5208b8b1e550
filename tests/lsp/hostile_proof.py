"""Hostile messages to a server of its own process, which must answer each request once and live on little memory.

    python -m tests.lsp.hostile_proof [COUNT [FIRST]]    COUNT messages (100,000) from seed FIRST on (0)

Exits with 1 if a request stays without an answer or gets two, if the server ends, or if it keeps growing.
"""

import json
import queue
import random
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from statistics import median
from typing import Any

from tests.lsp.conftest import Client
from tests.lsp.hostile import MODEL, URI, URIS, Hostile, framed, message, written

_TURN = 40  # messages that are sent at once
_PATIENCE = 60  # seconds for an answer
_MOST = 90  # MB
_GROWTH = 1.1  # of the last quarter over the second one
_SHOWN = 20


class Attacked:
    """A server and how much it holds."""

    def __init__(self, folder: Path) -> None:
        self.client = Client(directory=folder)
        self.held: list[float] = []

    def turn(self, messages: list[Hostile], probe: str) -> list[str]:
        """Send messages and then a question that has an answer; what went wrong."""
        wanted = Counter(_key(name) for each in messages for name in each.asked)
        # A torn message may take the next one with it.
        probes = [f"{probe} {number}" for number in range(4 if messages[-1].is_torn else 1)]
        self.client.send_raw(b"".join(each.content for each in messages) + b"".join(map(_symbols, probes)))
        answers: Counter[str] = Counter()
        is_met = False
        while not is_met or wanted - answers:
            try:
                said = self.client.next_message(_PATIENCE)
            except queue.Empty:
                return [f"no answer to {each}" for each in ([] if is_met else [probe]) + sorted(wanted - answers)]
            if said is None:
                return ["the server ended: " + self.client.errors()[-2000:]]
            if "method" not in said:
                answers[_key(said["id"])] += 1
                is_met |= said["id"] == probes[-1]
        return [f"{answers[name]} answers to {name}" for name, count in wanted.items() if answers[name] != count]

    def forget(self) -> None:
        """Close whatever may have been opened, and open the model anew."""
        for uri in {*URIS}:
            self.client.notify("textDocument/didClose", textDocument={"uri": uri})
        item = {"uri": URI, "languageId": "nddl", "version": 1, "text": MODEL}
        self.client.notify("textDocument/didOpen", textDocument=item)

    def look(self) -> None:
        """Note what the server holds, without the small process that watches it."""
        watcher = self.client.process.pid
        server = Path(f"/proc/{watcher}/task/{watcher}/children").read_text(encoding="ascii").split()[0]
        self.held.append(_resident(int(server)))


def _resident(pid: int) -> float:
    """MB of a process that lie in memory."""
    lines = Path(f"/proc/{pid}/status").read_text(encoding="ascii").splitlines()
    return next(int(line.split()[1]) / 1024 for line in lines if line.startswith("VmRSS"))


def _key(name: Any) -> str:
    return json.dumps(name)


def _symbols(name: str) -> bytes:
    params = {"textDocument": {"uri": URI}}
    whole = {"jsonrpc": "2.0", "id": name, "method": "textDocument/documentSymbol", "params": params}
    return framed(written(whole))


def attack(count: int, first: int, folder: Path) -> list[str]:
    """One long session of so many messages; what went wrong."""
    attacked = Attacked(folder)
    attacked.client.start(folder=folder)
    attacked.forget()
    wrong: list[str] = []
    kinds: Counter[str] = Counter()
    begun = time.monotonic()
    number = 0
    while number < count and attacked.client.process.poll() is None:
        turn: list[Hostile] = []
        while len(turn) < _TURN and number < count and not (turn and turn[-1].is_torn):
            turn.append(message(random.Random(first + number), 1000 + number))
            number += 1
        kinds.update(each.kind for each in turn)
        found = [f"seed {first + number - len(turn)}: {each}" for each in attacked.turn(turn, f"probe {number}")]
        print("".join(f"  {each[:3000]}\n" for each in found[: max(0, _SHOWN - len(wrong))]), end="", flush=True)
        wrong += found
        if number % 400 < len(turn):
            attacked.forget()
        if number % 2000 < len(turn):
            attacked.look()
            print(f"  {number} sent, {attacked.held[-1]:.1f} MB", flush=True)
    spent = time.monotonic() - begun
    print(f"hostile messages: {number} of {len(kinds)} kinds sent, {len(wrong)} wrong, {spent:.0f} s", flush=True)
    wrong += _grown(attacked.held)
    if not wrong and attacked.client.leave() != 0:
        wrong.append("the session did not end well")
    attacked.client.kill()
    return wrong


def _grown(held: list[float]) -> list[str]:
    """Whether what the process holds is too much or grows."""
    if not held:
        return []
    quarter = max(1, len(held) // 4)
    early, late = median(held[quarter : 2 * quarter] or held), median(held[-quarter:])
    print(f"  memory: {held[0]:.1f} MB, then {early:.1f}, {late:.1f} at the end, {max(held):.1f} at most", flush=True)
    is_flat = late <= early * _GROWTH and max(held) <= _MOST
    return [] if is_flat else ["memory grows"]


def main() -> None:
    """Attack, and exit with 1 if anything went wrong."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    with tempfile.TemporaryDirectory() as folder:
        wrong = attack(count, first, Path(folder))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
