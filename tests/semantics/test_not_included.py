"""A missing include is one message that names the file, not one for each name that is declared there."""

import os
from pathlib import Path

import pytest

from nddl_lang.analysis import analyse_file

TYPES = "enum Colour { red, green }\nclass Helm extends Timeline { predicate Run { } }\nfloat SPEED = 3.0;\n"
USES = """\
class Nav extends Timeline { predicate Go { float d; } }
Nav::Go { contains(Helm.Run r); d <= SPEED; }
Colour c = red;
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "types.nddl").write_text(TYPES)
    (tmp_path / "main.nddl").write_text(USES)
    return tmp_path


def test_one_message_names_the_file(folder: Path) -> None:
    (only,) = analyse_file(folder / "main.nddl").diagnostics
    assert only.help is not None and "`types.nddl`, which is not included, declares" in only.help
    assert only.span.line == 2
    (edit,) = only.fixes[0].edits
    assert (edit.span.begin, edit.text) == (0, '#include "types.nddl"\n')
    assert not only.fixes[0].safe
    (folder / "main.nddl").write_text(edit.text + USES)
    assert not analyse_file(folder / "main.nddl").diagnostics


def test_the_include_goes_below_the_others_and_below_a_first_comment(folder: Path) -> None:
    head = '// nddl3\n#include "TREX.nddl"\n\n'
    (folder / "main.nddl").write_text(head + USES.replace("Colour c = red;\n", ""))
    (only,) = analyse_file(folder / "main.nddl").diagnostics
    assert only.fixes[0].edits[0].span.begin == len(head) - 1
    (folder / "main.nddl").write_text("// what it is\n" + USES)
    (only,) = analyse_file(folder / "main.nddl").diagnostics
    assert only.fixes[0].edits[0].span.begin == len("// what it is\n")


def test_a_file_must_declare_them_all(folder: Path) -> None:
    (folder / "types.nddl").write_text(TYPES.replace("SPEED", "PACE"))
    assert len(analyse_file(folder / "main.nddl").diagnostics) > 1


def test_a_change_of_the_file_is_seen(folder: Path) -> None:
    assert len(analyse_file(folder / "main.nddl").diagnostics) == 1
    (folder / "types.nddl").write_text("int other = 1;\n")
    assert len(analyse_file(folder / "main.nddl").diagnostics) > 1


def test_one_name_is_rather_misspelt(folder: Path) -> None:
    (folder / "main.nddl").write_text("float f = SPEED;\n")
    (only,) = analyse_file(folder / "main.nddl").diagnostics
    assert only.help is None


def test_what_cannot_be_read_is_passed_over(folder: Path) -> None:
    (folder / "a.nddl").mkdir()
    (folder / "b.nddl").symlink_to("/dev/zero")
    (folder / "c.nddl").symlink_to("c.nddl")
    (folder / "d.nddl").write_bytes(b"\xff\x00" * 100)
    assert len(analyse_file(folder / "main.nddl").diagnostics) == 1


def test_the_file_system_is_asked_for_links_once_for_all_files_beside(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[object] = []
    follow = os.path.realpath

    def counted(path: Path) -> str:
        asked.append(path)
        return follow(path)

    monkeypatch.setattr(os.path, "realpath", counted)
    counts = []
    for number in range(40):
        (folder / f"other{number}.nddl").write_text("int OTHER = 3;\n")
        if number in (0, 39):
            asked.clear()
            (only,) = analyse_file(folder / "main.nddl").diagnostics
            assert only.help is not None and "`types.nddl`" in only.help
            counts.append(len(asked))
    assert counts[0] == counts[1]


def test_a_link_to_an_included_file_is_that_file(folder: Path) -> None:
    (folder / "elsewhere").mkdir()
    (folder / "types.nddl").rename(folder / "elsewhere" / "types.nddl")
    (folder / "other.nddl").symlink_to(folder / "elsewhere" / "types.nddl")
    (folder / "main.nddl").write_text('#include "elsewhere/types.nddl"\nint A = SPEEDY + SPEEDIER;\n')
    assert all("not included" not in (each.help or "") for each in analyse_file(folder / "main.nddl").diagnostics)
