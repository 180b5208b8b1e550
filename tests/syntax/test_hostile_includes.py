"""What an include names may be anything: nothing is waited for, read without end, or lets the tool fall over."""

import os
from pathlib import Path

import pytest

from nddl_lang.lint.check import Checker
from nddl_lang.lint.settings import Settings
from nddl_lang.syntax.includes import load_module_graph
from nddl_lang.syntax.roots import parts_of, roots_among
from nddl_lang.text import read
from nddl_lang.text.read import real_path

DEVICES = [os.devnull, *(each for each in ("/dev/zero", "/dev/urandom") if Path(each).exists())]  # every system has one


def complaints(path: Path, included: Path | str) -> list[tuple[str, int, str]]:
    """What is complained of in a model that includes something, and in which line."""
    path.write_text(f'int a;\n#include "{included}"\nint b;\n', encoding="utf-8")
    loaded = load_module_graph(path)
    assert [statement.span.text for statement in loaded.module.statements] == ["int a;", "int b;"]
    return [(each.code.id, each.span.line, each.message) for each in loaded.diagnostics]


@pytest.mark.parametrize("device", DEVICES)
def test_a_device_is_not_read(tmp_path: Path, device: str) -> None:
    expected = f"`{device}` cannot be read: it is a device, not a file"
    assert complaints(tmp_path / "m.nddl", device) == [("NDDL193", 2, expected)]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with names")
def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    expected = "`pipe` cannot be read: it is a pipe, not a file"
    assert complaints(tmp_path / "m.nddl", "pipe") == [("NDDL193", 2, expected)]


def test_links_in_a_cycle_are_a_complaint_where_they_are_included(tmp_path: Path) -> None:
    (tmp_path / "loop.nddl").symlink_to("loop.nddl")
    (found,) = complaints(tmp_path / "m.nddl", "loop.nddl")
    assert found[:2] == ("NDDL193", 2)
    assert real_path(tmp_path / "loop.nddl").name == "loop.nddl"


def test_a_file_too_large_is_not_taken_in(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(read, "LARGEST", 2**20)
    with (tmp_path / "large").open("wb") as file:
        file.truncate(2**20 + 1)
    expected = "`large` cannot be read: it is larger than 1 MiB"
    assert complaints(tmp_path / "m.nddl", "large") == [("NDDL193", 2, expected)]


def test_a_directory_is_not_read(tmp_path: Path) -> None:
    (found,) = complaints(tmp_path / "m.nddl", tmp_path)
    assert found[:2] == ("NDDL193", 2)


def test_one_file_that_cannot_be_read_leaves_the_others_to_be_checked(tmp_path: Path) -> None:
    (tmp_path / "loop.nddl").symlink_to("loop.nddl")
    (tmp_path / "a.nddl").write_text("int a = b;\n", encoding="utf-8")
    checker = Checker()
    found = [each.code.id for name in ("loop.nddl", "a.nddl") for each in checker.check(tmp_path / name, Settings())]
    assert found[0] == "NDDL193"
    assert "NDDL201" in found


def test_a_name_that_no_file_can_have_does_not_hide_the_other_models(tmp_path: Path) -> None:
    texts = {"long": f'#include "{"x" * 5000}"\n', "whole": '#include "part.nddl"\n', "part": "int a;\n"}
    long, whole, part = (tmp_path / f"{name}.nddl" for name in texts)
    for name, text in texts.items():
        (tmp_path / f"{name}.nddl").write_text(text, encoding="utf-8")
    assert roots_among([long, part, whole]) == [long, whole]
    assert parts_of([whole]) == {real_path(part)}
