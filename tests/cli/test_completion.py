"""`nddlc --install-completion`: the shell's script is written, its start file reads it, once."""

import shutil
import subprocess
from pathlib import Path

import pytest

from nddlc.main import run

Captured = pytest.CaptureFixture[str]


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_it_is_installed_once(shell: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("SHELL", f"/bin/{shell}")
    start = tmp_path / f".{shell}rc"
    start.write_text("alias l=ls")  # without an end of line
    for _ in range(2):
        assert run(["--install-completion"]) == 0
    wrote = [Path(line.removeprefix("wrote ")) for line in capsys.readouterr().out.splitlines() if "wrote" in line]
    assert "_NDDLC_COMPLETE" in wrote[0].read_text()
    if shell != "fish":
        assert start.read_text().startswith("alias l=ls\n")
        assert start.read_text().count(str(wrote[0])) == 2  # in one line


def test_an_unknown_shell_is_told(monkeypatch: pytest.MonkeyPatch, capsys: Captured) -> None:
    monkeypatch.setenv("SHELL", "/bin/csh")
    assert run(["--install-completion"]) == 2
    assert "`csh` is not known here" in capsys.readouterr().err


@pytest.mark.skipif(shutil.which("bash") is None, reason="no bash here")
def test_bash_reads_what_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("SHELL", "/bin/bash")
    assert run(["--install-completion"]) == 0
    said = subprocess.run(
        ["bash", "--rcfile", str(tmp_path / ".bashrc"), "-i", "-c", "complete -p nddlc"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert "nddlc" in said.stdout
