"""A constraint that only compares what constructors and goals give is a check, whatever its sign."""

import json
from pathlib import Path
from typing import Any

import pytest

from nddlc.main import run

MODEL = """#include "TREX.nddl"
enum Bank { WEST, EAST };
class Quay {
    Bank bank;
    Quay(Bank b) { bank = b; }
}
class Table extends AgentTimeline {
    predicate Free { }
    predicate Trip { Quay quay; Bank to; }
    Table(Mode m) { super(m, "Free"); }
}
Table::Trip {
    duration == 5;
    CHECK;
}
Quay westQuay = new Quay(WEST);
Quay eastQuay = new Quay(EAST);
Table table = new Table(Internal);
close();
"""
MISSION = """
[mission]
name = "ferry"
final_tick = 60
[[reactor]]
name = "plan"
model = "plan.nddl"
internal = ["table"]
latency = 1
lookahead = 40
[[goal]]
timeline = "table"
predicate = "Trip"
start = [5, 30]
mandatory = true
parameters = { quay = "westQuay", to = "EAST" }
"""


def _told(folder: Path, check: str, capsys: pytest.CaptureFixture[str]) -> Any:
    (folder / "plan.nddl").write_text(MODEL.replace("CHECK", check))
    (folder / "mission.toml").write_text(MISSION)
    assert run(["check", "mission.toml", "--missions", "1"]) == 1
    capsys.readouterr()
    assert run(["explain", "--format", "json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("check", ["quay.bank == to", "eq(quay.bank, to)"])
def test_its_sign_may_be_wrong(
    check: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)

    first = _told(tmp_path, check, capsys)["causes"]["ranked"][0]

    assert (first["line"], first["claim"]) == (14, "mends")
    assert first["change"]["new"] in ("!=", "neq")


def test_it_is_where_the_mission_breaks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    _told(tmp_path, "quay.bank == to", capsys)

    assert run(["explain"]) == 0

    assert "westQuay.bank == Table.Trip#1.to   <== where it breaks" in capsys.readouterr().out
