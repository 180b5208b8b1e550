"""Traces and records that anything may have happened to are judged, or told to be none; they end nothing else."""

import json
import random
from pathlib import Path
from typing import Any

import pytest

from nddlc.main import run

pytestmark = pytest.mark.once

ROOT = Path(__file__).resolve().parents[3]
MISSION = str(ROOT / "models/gps/mission.toml")
UNTIL = 60
COUNT = 40
VALUES: tuple[Any, ...] = (
    None,
    True,
    -1,
    0,
    1.5,
    1e308,
    10**30,
    "",
    "é\0",
    "Gps.Active",
    [],
    {},
    [1, None],
    [[]],
    {"between": [3, 1]},
)


def damage(document: Any, rng: random.Random) -> Any:
    """Replace, take away or add a value at a random place of a document."""
    places: list[tuple[Any, Any]] = []
    node = document
    while isinstance(node, (dict, list)) and node and rng.random() < 0.85:
        key = rng.choice(list(node)) if isinstance(node, dict) else rng.randrange(len(node))
        places.append((node, key))
        node = node[key]
    if not places:
        return rng.choice(VALUES)
    holder, key = places[-1]
    match rng.choice(("replace", "replace", "remove", "add")):
        case "replace":
            holder[key] = rng.choice(VALUES)
        case "remove":
            del holder[key]
        case "add" if isinstance(holder, dict):
            holder["more"] = rng.choice(VALUES)
        case _:
            holder.insert(key, rng.choice(VALUES))
    return document


def scrawl(text: str, rng: random.Random) -> bytes:
    """Overwrite a few bytes."""
    data = bytearray(text.encode())
    for _ in range(rng.randint(1, 4)):
        data[rng.randrange(len(data))] = rng.randrange(256)
    return bytes(data)


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("flown") / "trace.jsonl"
    assert run(["run", MISSION, "--seed", "16", "--until", str(UNTIL), "--trace", str(path)]) in (0, 1)
    return path.read_text(encoding="utf-8")


def judged(path: Path, data: bytes, capsys: pytest.CaptureFixture[str], *command: str) -> int:
    path.write_bytes(data)
    code = run([*command, str(path)])
    told = capsys.readouterr()
    assert code in (0, 1, 2), told.err
    assert code != 2 or told.err
    return code


def test_damaged_traces(trace: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "trace.jsonl"
    codes = set()
    for seed in range(COUNT):
        rng = random.Random(seed)
        lines = trace.splitlines()
        for _ in range(rng.randint(1, 3)):
            number = rng.randrange(len(lines)) if rng.random() < 0.7 else 0
            lines[number] = json.dumps(damage(json.loads(lines[number]), rng))
        data = scrawl(trace, rng) if rng.random() < 0.15 else "\n".join(lines).encode()
        codes.add(judged(path, data, capsys, "validate"))
        judged(path, data, capsys, "validate", "--mission", MISSION)
        judged(path, data, capsys, "replay")
    assert len(codes) > 1


def test_damaged_records(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "record.json"
    assert run(["validate", MISSION, "--seed", "3", "--record", str(path)]) == 0
    whole = json.loads(path.read_text(encoding="utf-8"))
    for reactor in whole["reactors"]:
        del reactor["tokens"][4:]
    text = json.dumps(whole)
    for seed in range(COUNT):
        rng = random.Random(seed)
        data = scrawl(text, rng) if rng.random() < 0.15 else json.dumps(damage(json.loads(text), rng)).encode()
        judged(path, data, capsys, "validate", "--mission", MISSION)


def test_a_trace_without_a_timeline_is_judged(trace: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lines = [line for line in trace.splitlines() if json.loads(line).get("timeline") != "gps"]
    assert judged(tmp_path / "trace.jsonl", "\n".join(lines).encode(), capsys, "validate") in (0, 1)
