"""`--watch`: a command is carried out again when a file changes that it may read, and Ctrl-C ends it in good order."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from nddlc.main import run
from nddlc.watch import stamps

ROOT = Path(__file__).parents[2]
COMMAND = [sys.executable, "-P", "-m", "nddlc.main"]


def test_lint_runs_again_after_a_change_and_ends_cleanly(tmp_path: Path) -> None:
    (tmp_path / "part.nddl").write_text("int SPEED = 2;\n")
    (tmp_path / "a.nddl").write_text('#include "part.nddl"\nint x = SPEED;\n')
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "NO_COLOR": "1"}
    with subprocess.Popen(
        [*COMMAND, "lint", "--watch", "a.nddl"], cwd=tmp_path, env=environment, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    ) as process:  # fmt: skip
        assert process.stdout is not None
        seen = []

        def read_to(end: str) -> None:
            for line in process.stdout or ():
                seen.append(line)
                if end in line:
                    return

        read_to("watching 2 files")
        (tmp_path / "part.nddl").write_text("int SPEED2 = 2;\n")
        read_to("watching 2 files")
        process.send_signal(signal.SIGINT)
        read_to("no longer watching")
        assert process.wait(20) == 0
    text = "".join(seen)
    assert "nothing wrong in 1 file\n" in text.partition("changed: part.nddl")[0]
    assert "error[NDDL201]: nothing named `SPEED`" in text.partition("changed: part.nddl")[2]
    assert text.endswith("\nnddlc: no longer watching\n") and "Traceback" not in text


@pytest.mark.skipif(os.name == "nt", reason="signals are another matter there")
def test_a_watch_in_the_background_of_a_script_ends_by_sigterm_with_what_it_runs(tmp_path: Path) -> None:
    """There Ctrl-C is ignored; the run under way stayed behind, with nobody who would end it."""
    (tmp_path / "a.nddl").write_text("int x = 1;\n")
    script = f"{sys.executable} -P -m nddlc.main lint --watch a.nddl & echo $!; wait $!; echo ended with $?"
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "NO_COLOR": "1"}
    with subprocess.Popen(
        ["sh", "-c", script], cwd=tmp_path, env=environment, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    ) as process:  # fmt: skip
        assert process.stdout is not None
        number = int(process.stdout.readline())
        for line in process.stdout:
            if "watching" in line:
                assert f"`kill {number}` ends it" in line
                break
        os.kill(number, signal.SIGINT)
        os.kill(number, signal.SIGTERM)
        told = process.stdout.read()
    assert "no longer watching (SIGTERM)" in told and told.endswith(f"ended with {128 + signal.SIGTERM}\n")


@pytest.mark.skipif(os.name == "nt", reason="signals are another matter there")
def test_what_a_watch_runs_ends_with_it(tmp_path: Path) -> None:
    run_once = "import sys, time; print('begun', flush=True); time.sleep(60)"
    watching = (
        "import sys, pathlib, nddlc.watch as watch\n"
        "popen = watch.subprocess.Popen\n"
        f"watch.subprocess.Popen = lambda _: popen([sys.executable, '-c', {run_once!r}])\n"
        "sys.exit(watch._watch([], [pathlib.Path()], None))\n"
    )
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(
        [sys.executable, "-P", "-c", watching], cwd=tmp_path, env=environment, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    ) as process:  # fmt: skip
        assert process.stdout is not None and process.stdout.readline() == "begun\n"
        process.send_signal(signal.SIGTERM)
        # The pipe is closed once what was run is gone too.
        assert "no longer watching (SIGTERM)" in process.communicate(timeout=30)[0]
        assert process.returncode == 128 + signal.SIGTERM


def test_a_check_without_a_path_watches_the_model_and_not_its_reports(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where there was a report already, its folder was all that was watched, and each report was a change."""
    (tmp_path / "a.nddl").write_text("int x = 1;\n")
    (tmp_path / "mission.toml").write_text('[mission]\nname = "a"\n')
    (tmp_path / "nddlc-report").mkdir()
    (tmp_path / "nddlc-report" / "report.json").write_text("{}")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "report.json").write_text("{}")
    monkeypatch.chdir(tmp_path)
    watched: list[tuple[list[str], set[str]]] = []

    def watch(arguments: list[str], named: list[Path], output: Path | None) -> int:
        watched.append((arguments, {path.name for path in stamps(named, output)}))
        return 0

    monkeypatch.setattr("nddlc.watch._watch", watch)
    assert run(["check", "--watch"]) == 0
    assert run(["check", "--watch", "--output", "out", "mission.toml"]) == 0
    assert run(["check", "--watch", "--output", "out"]) == 0
    assert [given for given, _ in watched] == [
        ["check"],
        ["check", "--output", "out", "mission.toml"],
        ["check", "--output", "out"],
    ]
    assert watched[0][1] == {"a.nddl", "mission.toml", "report.json"}  # that of `out`, which is nobody's
    assert watched[1][1] == watched[2][1] == {"a.nddl", "mission.toml"}


def test_what_is_watched_is_what_may_be_read(tmp_path: Path) -> None:
    def write(name: str, text: str = "") -> Path:
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    mission = write(
        "m/mission.toml", '[[reactor]]\nmodel = "a.nddl"\nsolver = "sub/s.xml"\ncode = "far/x.py:Lookout"\n'
    )
    model = write("m/a.nddl", '#include "../common/b.nddl"\n')
    common = write("common/b.nddl", '#include "c.nddl"\n#include "gone.nddl"\n')
    part, solver, code = write("common/c.nddl"), write("m/sub/s.xml"), write("m/far/x.py")
    write("m/nddlc-report/report.json")
    write("m/.nddlc/x.toml")
    write("common/unread.nddl")
    write("m/sub/unread.toml")
    assert set(stamps([mission])) == {mission, model, common.resolve(), part.resolve(), solver, code}
    assert set(stamps([tmp_path / "m"])) == {*stamps([mission]), tmp_path / "m/sub/unread.toml"}


def test_a_file_that_comes_and_one_that_goes_are_changes(tmp_path: Path) -> None:
    (tmp_path / "a.nddl").write_text('#include "b.nddl"\n')
    before = stamps([tmp_path])
    (tmp_path / "b.nddl").write_text("")
    between = stamps([tmp_path])
    (tmp_path / "a.nddl").unlink()
    assert len({len(before), len(between)}) == 2 and stamps([tmp_path]) not in (before, between)


def test_the_other_commands_do_not_take_it() -> None:
    assert run(["fmt", "--watch", "x.nddl"]) == 2
