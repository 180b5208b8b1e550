"""`make check` ends as `nddlc check` does, and an environment that came from elsewhere is not used."""

import os
import shutil
import subprocess
import threading
from pathlib import Path

import pytest

import ticking

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """Lay out a checkout that is set up, but whose commands only say how they were called."""
    for name in ("Makefile", "pyproject.toml", "setup.py", "build_backend/nddlc_build.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    (tmp_path / "build").mkdir()
    (tmp_path / ".venv" / "bin").mkdir(parents=True)
    for name in ("python", "nddlc"):
        command = tmp_path / ".venv" / "bin" / name
        command.write_text(f'#!/bin/sh\necho {name} "$@"\n[ {name} = python ] || exit $ENDS_WITH\n', encoding="ascii")
        command.chmod(0o755)
    for name in ("compiler", "ready"):
        (tmp_path / ".venv" / name).write_text(f"{tmp_path}\n", encoding="utf-8")
    return tmp_path


def make(tree: Path, *arguments: str, ends_with: int = 0) -> subprocess.CompletedProcess[str]:
    """Run make in `tree` as if nobody had called it from make already."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS"))}
    return subprocess.run(
        ["make", *arguments],
        cwd=tree,
        env={**kept, "ENDS_WITH": str(ends_with)},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize(("ends_with", "code"), [(0, 0), (1, 1), (2, 2), (3, 2)])
def test_make_check_tells_findings_from_failures(tree: Path, ends_with: int, code: int) -> None:
    done = make(tree, "check", ends_with=ends_with)
    assert done.returncode == code, done.stderr
    build, _, check = done.stdout.splitlines()
    assert (build, check) == ("python build_backend/build_in_place.py", "nddlc check models/auv/inl/mission.toml")


def test_findings_are_forgotten_by_the_next_check(tree: Path) -> None:
    assert make(tree, "check", ends_with=1).returncode == 1
    assert make(tree, "check", "MISSION=models/gps/mission.toml").returncode == 0


def test_an_environment_that_came_with_a_copy_is_removed(tree: Path) -> None:
    (tree / ".venv" / "ready").write_text("/somewhere/else\n", encoding="ascii")
    assert make(tree, "setup", "PYTHON=true").returncode != 0  # this Python cannot make another
    assert not (tree / ".venv").exists()


def test_making_an_environment_says_that_it_goes_on(tree: Path) -> None:
    """On a busy machine it was silent for a minute."""
    python = tree / "fake"
    python.write_text(f'#!/bin/sh\necho "$@" >> {tree}/calls\n', encoding="ascii")
    python.chmod(0o755)
    (tree / ".venv" / "ready").write_text("/somewhere/else\n", encoding="ascii")
    make(tree, "setup", f"PYTHON={python}")
    last = (tree / "calls").read_text().splitlines()[-1]
    assert last == f"build_backend/ticking.py making .venv {python} -m venv --clear .venv"


def test_make_alone_says_what_it_can_do(tree: Path) -> None:
    assert make(tree).stdout.startswith("make check ")


def test_what_takes_long_says_so(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(ticking, "EVERY", 0.01)
    told = threading.Event()

    def progress() -> str:
        told.set()
        return "1 of 2 modules, "

    with ticking.ticking("building", progress):
        assert told.wait(10.0)
    assert capsys.readouterr().err.startswith("  building: 1 of 2 modules, 0 s\n")
