"""What `nddlc.toml` says of how models are read holds in every command, as it does in `nddlc lint`."""

from pathlib import Path

import pytest

from nddlc.main import run

MODEL = '#include "TREX.nddl"\n#include "base.nddl"\nLamp lamp = new Lamp(Internal);\nclose();\n'
BASE = """\
class Lamp extends AgentTimeline {
  predicate Off { }
  Lamp(Mode m) { super(m, "Off"); }
}
"""
MISSION = """\
[mission]
name = "a"
final_tick = 3
[[reactor]]
name = "a"
model = "models/a.nddl"
latency = 0
lookahead = 1
internal = ["lamp"]
"""


COMMANDS = [
    ["lint", "models/a.nddl"],
    ["load", "models/a.nddl"],
    ["plan", "models/a.nddl"],
    ["compile", "models/a.nddl"],
    ["check", "models/a.nddl"],
    ["check", "--dry-run", "mission.toml"],
    ["lint", "mission.toml"],
    ["run", "mission.toml"],
]


def project(folder: Path, settings: str, more: str = "") -> None:
    """Write a model whose include stands in a folder of its own."""
    for name, text in (
        ("nddlc.toml", settings),
        ("lib/base.nddl", BASE),
        ("models/a.nddl", MODEL + more),
        ("mission.toml", MISSION),
    ):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_folders_of_includes_count(
    command: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    project(tmp_path, 'include = ["lib"]\n')
    monkeypatch.chdir(tmp_path)
    assert run(command) == 0, capsys.readouterr()


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_the_dialect_counts(
    command: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    project(tmp_path, 'include = ["lib"]\ndialect = "nddl3"\n', "float x = 1 / 2;\n")
    monkeypatch.chdir(tmp_path)
    assert run(command) in (1, 2)
    told = capsys.readouterr()
    assert "nddl3" in told.out + told.err
