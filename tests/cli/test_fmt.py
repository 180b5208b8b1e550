"""`nddlc fmt` as its users meet it: files and directories in, texts in the one style and an exit code out."""

import subprocess
import sys
from pathlib import Path

import pytest

from nddlc.main import run

Captured = pytest.CaptureFixture[str]
UNTIDY = "int   a=1 ;\nint b = 2;   // two\n"
TIDY = "int a = 1;\nint b = 2;  // two\n"


def test_fmt_puts_a_file_into_the_style(tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "m.nddl"
    path.write_text(UNTIDY, encoding="utf-8")
    path.chmod(0o640)
    assert run(["fmt", str(path)]) == 0
    assert capsys.readouterr().out == f"formatted {path}\n"
    assert path.read_text(encoding="utf-8") == TIDY
    assert path.stat().st_mode & 0o777 == 0o640
    assert list(tmp_path.iterdir()) == [path]
    assert run(["fmt", str(path)]) == 0
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("option", ["--check", "--diff"])
def test_fmt_can_tell_without_writing(option: str, tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "m.nddl"
    path.write_text(UNTIDY, encoding="utf-8")
    assert run(["fmt", option, str(path)]) == 1
    assert str(path) in capsys.readouterr().out
    assert path.read_text(encoding="utf-8") == UNTIDY


def test_fmt_reads_standard_input() -> None:
    told = subprocess.run(
        [sys.executable, "-m", "nddlc.main", "fmt", "-"], input=UNTIDY, capture_output=True, text=True, check=True
    )
    assert told.stdout == TIDY


def test_fmt_leaves_mistakes_as_they_are(tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "m.nddl"
    path.write_text("int   a  = = 1;\nint   b=2;\n", encoding="utf-8")
    assert run(["fmt", str(path)]) == 1
    assert path.read_text(encoding="utf-8") == "int   a  = = 1;\nint b = 2;\n"
    capsys.readouterr()


def test_fmt_takes_all_models_below_a_directory(tmp_path: Path, capsys: Captured) -> None:
    (tmp_path / "deep" / ".hidden").mkdir(parents=True)
    parts = [tmp_path / "a.nddl", tmp_path / "deep" / "b.nddl"]
    left = [tmp_path / "deep" / ".hidden" / "c.nddl", tmp_path / "notes.txt"]
    for path in (*parts, *left):
        path.write_text(f'#include "b.nddl"\n{UNTIDY}', encoding="utf-8")
    assert run(["fmt", "--check", str(tmp_path)]) == 1
    assert run(["fmt", str(tmp_path), str(parts[0])]) == 0
    assert capsys.readouterr().out == "".join(
        f"{done} {path}\n" for done in ("would format", "formatted") for path in parts
    )
    assert all(TIDY in path.read_text(encoding="utf-8") for path in parts)
    assert all(UNTIDY in path.read_text(encoding="utf-8") for path in left)


def test_fmt_says_where_there_is_nothing_to_format(tmp_path: Path, capsys: Captured) -> None:
    assert run(["fmt", str(tmp_path)]) == 2
    assert f"there is no model (.nddl) in `{tmp_path}`" in capsys.readouterr().err


def test_fmt_does_not_touch_what_is_no_text(tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "m.nddl"
    path.write_bytes(b"int a = 1;\n// caf\xe9\n")
    assert run(["fmt", str(path)]) == 2
    assert "is not UTF-8 text (line 2)" in capsys.readouterr().err
