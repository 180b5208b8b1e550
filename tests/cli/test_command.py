"""The command line as its users meet it: words in, text and an exit code out."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from nddlc.main import COMMANDS, named, run

Captured = pytest.CaptureFixture[str]
ENVIRONMENT = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])}

LAMP = """class Lamp extends Timeline { predicate lit { int level = [1 3]; } }
Lamp lamp = new Lamp();
close();
int watts = 60;
watts <= 100;
goal(lamp.lit g);
g.start = 5;
"""
BROKEN = "int a = 1;\nLmap l;\nfoo(a);\n"


@pytest.fixture
def lamp(tmp_path: Path) -> str:
    path = tmp_path / "lamp.nddl"
    path.write_text(LAMP, encoding="utf-8")
    return str(path)


@pytest.fixture
def broken(tmp_path: Path) -> str:
    path = tmp_path / "broken.nddl"
    path.write_text(BROKEN, encoding="utf-8")
    return str(path)


def test_the_version_says_in_which_form_the_engine_runs(capsys: Captured) -> None:
    assert run(["--version"]) == 0
    shown = capsys.readouterr().out
    assert "engine compiled" in shown or "engine interpreted" in shown


def test_help_lists_every_command(capsys: Captured) -> None:
    assert run(["--help"]) == 0
    shown = capsys.readouterr().out
    assert all(name in shown for name in COMMANDS)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_exists_and_explains_itself(name: str, capsys: Captured) -> None:
    assert named(f"{COMMANDS[name][0]}:command").help
    assert run([name, "--help"]) == 0
    assert f"Usage: nddlc {name}" in capsys.readouterr().out


def test_load_shows_tokens_and_variables(lamp: str, capsys: Captured) -> None:
    assert run(["load", lamp]) == 0
    shown = capsys.readouterr().out
    assert "g      Lamp.lit   INACTIVE  {lamp} Lamp  5" in shown
    assert "watts     {60} int" in shown
    assert shown.endswith("consistent\n")


def test_load_prints_one_object_per_file(lamp: str, broken: str, capsys: Captured) -> None:
    assert run(["load", "--json", lamp, broken]) == 1
    fine, refused = (json.loads(line) for line in capsys.readouterr().out.splitlines())
    assert (fine["file"], fine["load"], fine["consistent"], fine["solve"]) == (lamp, "ok", True, None)
    assert fine["domains"]["g.level"] == "[1, 3] int"
    assert (refused["file"], refused["load"], refused["consistent"]) == (broken, "error", None)
    assert [(each["kind"], each["line"]) for each in refused["diagnostics"]] == [("name", 2), ("name", 3)]


def test_a_model_that_contradicts_itself_is_a_finding(tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "m.nddl"
    path.write_text("int a = 5;\nint b = 6;\neq(a, b);\n", encoding="utf-8")
    assert run(["load", str(path)]) == 1
    assert "inconsistent" in capsys.readouterr().out


def test_lint_is_silent_about_a_good_model(lamp: str, capsys: Captured) -> None:
    assert run(["lint", lamp]) == 0
    assert capsys.readouterr().out == "nothing wrong in 1 file\n"


def test_lint_shows_each_finding_with_its_text(broken: str, capsys: Captured) -> None:
    assert run(["lint", broken]) == 1
    shown = capsys.readouterr().out
    assert f"--> {broken}:2:1" in shown
    assert "^^^^" in shown
    assert shown.endswith("2 errors in 1 file\n")
    assert "\x1b" not in shown


def test_lint_speaks_json(broken: str, capsys: Captured) -> None:
    assert run(["lint", "--format", "json", broken]) == 1
    told = json.loads(capsys.readouterr().out)
    assert [each["line"] for each in told["diagnostics"]] == [2, 3]


def test_the_dialect_may_stand_before_the_command_or_after_it(tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "m.nddl"
    path.write_text("int a = 1 + 2;\n", encoding="utf-8")
    assert run(["lint", str(path)]) == 0
    assert run(["--dialect", "nddl3", "lint", str(path)]) == 1
    assert run(["lint", "--dialect", "nddl3", str(path)]) == 1
    assert run(["--dialect", "nddl3", "lint", "--dialect", "nddlc", str(path)]) == 0
    capsys.readouterr()


UNUSABLE = [
    (["lint", "no_such.nddl"], "no file `no_such.nddl`"),
    (["load", "."], "`.` is a directory"),
    (["run", ""], "an empty name names no file"),
    (["explain", ""], "`` names no run"),
    (["explain", "#"], "`#` names no run"),
    (["load", "--include", "nowhere", "x.nddl"], "no directory `nowhere`"),
    (["load"], "Missing argument 'FILE...'"),
    (["lint", "--fromat", "json", "x.nddl"], "--format"),
    (["lint", "--format", "yaml", "x.nddl"], "'yaml' is not one of"),
    (["lnit", "x.nddl"], "did you mean `lint`?"),
    (["--dialect", "europa", "lint"], "'europa' is not one of"),
]


@pytest.mark.parametrize(("words", "message"), UNUSABLE, ids=[" ".join(words) for words, _ in UNUSABLE])
def test_an_unusable_command_line_is_told_from_a_finding(words: list[str], message: str, capsys: Captured) -> None:
    assert run(words) == 2
    assert message in capsys.readouterr().err


def test_lint_looks_at_the_project_where_no_file_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    (tmp_path / "models" / "deep").mkdir(parents=True)
    (tmp_path / "models" / "broken.nddl").write_text(BROKEN, encoding="utf-8")
    monkeypatch.chdir(tmp_path / "models" / "deep")
    assert run(["lint"]) == 2
    assert "there is no model (.nddl) in `.`" in capsys.readouterr().err
    (tmp_path / "nddlc.toml").write_text("", encoding="utf-8")
    assert run(["lint"]) == 1
    assert "../../models/broken.nddl:2" in capsys.readouterr().out


def test_a_file_that_may_be_meant_is_named(lamp: str, capsys: Captured) -> None:
    assert run(["lint", lamp.removesuffix(".nddl")]) == 2
    assert f"there is `{lamp}`" in capsys.readouterr().err


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_an_unreadable_file_is_named(lamp: str, capsys: Captured) -> None:
    Path(lamp).chmod(0)
    assert run(["lint", lamp]) == 2
    assert "Permission denied" in capsys.readouterr().err


def test_nothing_to_do_shows_the_help(capsys: Captured) -> None:
    assert run([]) == 2
    assert "Commands:" in capsys.readouterr().err


def test_an_empty_model_loads(tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "empty.nddl"
    path.touch()
    assert run(["load", str(path)]) == 0
    assert capsys.readouterr().out == "consistent\n"


def test_bytes_that_are_no_text_are_reported_where_they_stand(tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "m.nddl"
    path.write_bytes(b"int a = 1;\n// caf\xe9\nint b = 2;\n")
    assert run(["lint", str(path)]) == 1
    assert f"--> {path}:2:7" in capsys.readouterr().out


def test_a_bug_is_admitted(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: Captured) -> None:
    monkeypatch.setitem(COMMANDS, "fail", ("tests.cli.failing", "Fail."))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert run(["fail"]) == 3
    told = capsys.readouterr().err
    assert "a bug in nddlc, not in your model: ZeroDivisionError: nobody foresaw this" in told
    (details,) = tmp_path.glob("nddlc-bug-*.txt")
    assert str(details) in told
    text = details.read_text(encoding="utf-8")
    assert text.startswith("command: nddlc fail\n")
    assert "Traceback" in text


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there is nothing to wait for")
def test_an_interrupted_command_says_so(tmp_path: Path) -> None:
    path = tmp_path / "pipe.nddl"
    os.mkfifo(path)
    command = [sys.executable, "-m", "nddlc.main", "lint", str(path)]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        writer = _writer(path)
        process.send_signal(signal.SIGINT)
        assert process.stderr is not None
        assert process.stderr.read().endswith("nddlc: interrupted\n")
        os.close(writer)
    assert process.returncode == 130


def _writer(path: Path) -> int:
    """The other end of a pipe, once somebody reads it."""
    while True:
        try:
            return os.open(path, os.O_WRONLY | os.O_NONBLOCK)
        except OSError:
            time.sleep(0.01)


def test_lint_imports_neither_engine_nor_solver_nor_report(lamp: str) -> None:
    script = "import sys; from nddlc.main import run; run(sys.argv[1:]); print(*sys.modules)"
    told = subprocess.run(
        [sys.executable, "-c", script, "lint", lamp], capture_output=True, text=True, check=True
    ).stdout.splitlines()
    roots = {".".join(name.split(".")[:2]) for name in told[-1].split()}
    assert not roots & {"lark", "rich", "numpy", "z3", "networkx", "pygls", "runtime.constraints", "runtime.plan"}
    assert not any(name.startswith(("checker", "compiler")) for name in roots)


def test_a_code_is_explained_by_examples(capsys: Captured) -> None:
    assert run(["rule", "nddl201"]) == 0
    shown = capsys.readouterr().out
    assert shown.startswith("NDDL201 (error): ")
    assert "Instead of" in shown


def test_all_codes_are_listed(capsys: Captured) -> None:
    assert run(["rule"]) == 0
    listed = [line.split()[0] for line in capsys.readouterr().out.splitlines()]
    assert listed == sorted(set(listed))
    assert {"NDDL110", "NDDL201", "NDDL651"} <= set(listed)


def test_an_unknown_code_is_refused(capsys: Captured) -> None:
    assert run(["rule", "NDDL999"]) == 2
    assert "there is no code `NDDL999`" in capsys.readouterr().err


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize("words", [["load"], ["plan"], ["lint"], ["plan", "--json"]])
def test_a_full_disk_is_no_bug_of_nddlc(words: list[str], unbuffered: str, lamp: str) -> None:
    command = [sys.executable, "-m", "nddlc.main", *words, lamp]
    environment = {**os.environ, "PYTHONUNBUFFERED": unbuffered}  # what is buffered is written once more at the end
    with Path("/dev/full").open("w", encoding="ascii") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False, env=environment)
    assert done.stderr == "nddlc: cannot write the output: No space left on device\n"
    assert done.returncode == 2


@pytest.mark.skipif(sys.platform == "win32", reason="needs a shell that closes streams")
@pytest.mark.parametrize("closed", [">&-", ">&- 2>&-", "<&-"])
def test_a_closed_stream_changes_no_verdict(closed: str, lamp: str) -> None:
    command = f"'{sys.executable}' -m nddlc.main plan '{lamp}' {closed}"
    assert subprocess.run(["sh", "-c", command], check=False).returncode == 0


@pytest.mark.skipif(sys.platform == "win32", reason="needs a shell that joins commands")
@pytest.mark.parametrize(("words", "code"), [("plan LAMP", 0), ("lint wrong.nddl", 1), ("rule --list", 0)])
@pytest.mark.parametrize("lost", ["", "2>&1"])
def test_a_reader_that_goes_away_changes_no_verdict(
    words: str, code: int, lost: str, lamp: str, tmp_path: Path
) -> None:
    (tmp_path / "wrong.nddl").write_text("int a = b;\n")
    told = f"'{sys.executable}' -m nddlc.main {words.replace('LAMP', lamp)} {lost}"
    command = f"cd '{tmp_path}'; ({told}; echo $? > code) | true"
    done = subprocess.run(["sh", "-c", command], check=False, capture_output=True, text=True)
    assert (tmp_path / "code").read_text() == f"{code}\n"
    assert done.stderr == ""


@pytest.mark.parametrize("command", ["load", "plan", "lint"])
def test_an_engine_that_is_not_compiled_says_so_once(
    command: str, lamp: str, capsys: Captured, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("runtime.build_form.uncompiled_notice", lambda: "the engine runs uncompiled")
    run([command, lamp])
    assert capsys.readouterr().err == ("" if command == "lint" else "nddlc: the engine runs uncompiled\n")


@pytest.mark.skipif(not Path("/dev/stdin").exists(), reason="needs a file that is standard input")
@pytest.mark.parametrize("command", ["lint", "load", "plan"])
def test_a_model_may_come_through_a_pipe(command: str) -> None:
    words = [sys.executable, "-m", "nddlc.main", command, "/dev/stdin"]
    done = subprocess.run(words, input=BROKEN, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "Lmap" in done.stdout


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="needs a device without an end")
def test_a_device_is_no_model(capsys: Captured) -> None:
    assert run(["lint", "/dev/zero"]) == 2
    assert "`/dev/zero` is a device" in capsys.readouterr().err


def test_a_file_that_nobody_can_have_written_is_not_read(tmp_path: Path, capsys: Captured) -> None:
    with (tmp_path / "huge.nddl").open("wb") as file:
        file.truncate(1 << 40)
    assert run(["load", str(tmp_path / "huge.nddl")]) == 2
    assert "is too large: 1048576 MiB, and 64 are read" in capsys.readouterr().err


def test_of_a_mistyped_file_the_one_that_was_meant_is_told(lamp: str, capsys: Captured) -> None:
    assert run(["plan", lamp.replace("lamp.nddl", "lmap.nddl")]) == 2
    assert f"did you mean `{lamp}`?" in capsys.readouterr().err
    assert run(["check", str(Path(lamp).parent)]) == 2
    (Path(lamp).parent / "sea.toml").write_text("", encoding="utf-8")
    capsys.readouterr()
    assert run(["check", str(Path(lamp).parent)]) == 2
    assert "sea.toml` is a mission" in capsys.readouterr().err


@pytest.mark.skipif(
    shutil.which("setpriv") is None or os.geteuid() != 0, reason="root reads all, and cannot be stopped"
)
@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["plan", "shut/lamp.nddl"], "cannot read `shut/lamp.nddl`: Permission denied"),
        (["lint", "shut"], "cannot use `shut`: Permission denied"),
        (["lint", "lamp.nddl"], "nddlc.toml`: Permission denied"),
        (["fmt", "bare/lamp.nddl"], "cannot write `bare/lamp.nddl`: Permission denied"),
    ],
)
def test_what_may_not_be_touched_is_no_bug(words: list[str], said: str, tmp_path: Path) -> None:
    for folder in ("shut", "bare", "."):
        (tmp_path / folder).mkdir(exist_ok=True)
        (tmp_path / folder / "lamp.nddl").write_text("int  a = 1 ;\n", encoding="utf-8")
    (tmp_path / "bare" / "nddlc.toml").touch()
    (tmp_path / "nddlc.toml").touch(mode=0)
    (tmp_path / "shut").chmod(0)
    (tmp_path / "bare").chmod(0o555)
    powers = "-dac_override,-dac_read_search"
    command = [
        "setpriv",
        f"--bounding-set={powers}",
        f"--inh-caps={powers}",
        sys.executable,
        "-m",
        "nddlc.main",
        *words,
    ]
    done = subprocess.run(command, cwd=tmp_path, env=ENVIRONMENT, capture_output=True, text=True, check=False)
    (tmp_path / "shut").chmod(0o700)
    assert said in done.stderr
    assert done.returncode == 2


def test_a_name_that_is_too_long_is_no_bug(capsys: Captured) -> None:
    assert run(["lint", "a" * 300 + ".nddl"]) == 2
    assert "File name too long" in capsys.readouterr().err


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with names")
def test_what_is_no_file_in_a_directory_is_left_out(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    os.mkfifo(tmp_path / "pipe.nddl")
    (tmp_path / "loop.nddl").symlink_to("loop.nddl")
    (tmp_path / "a.nddl").write_text("int a = 1;\nint b = c;\n", encoding="utf-8")
    assert run(["lint", str(tmp_path)]) == 1
    shown = capsys.readouterr()
    assert f"left out `{tmp_path / 'pipe.nddl'}`: it is a pipe, not a file" in shown.err
    assert "NDDL193" in shown.out and "NDDL201" in shown.out
