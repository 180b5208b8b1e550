"""Includes bring the text of other files, once each, to where they stand."""

from pathlib import Path

import pytest

from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import LIBRARY, LoadedModules, load_module_graph
from nddl_lang.syntax.parser import parse
from nddl_lang.text.diagnostic import Severity
from nddl_lang.text.source import Source
from tests.syntax.outline import outline


def write(folder: Path, **texts: str) -> Path:
    """Write `name.nddl` for each of `texts`; returns the path of the first."""
    folder.mkdir(exist_ok=True)
    for name, text in texts.items():
        (folder / f"{name}.nddl").write_text(text, encoding="utf-8")
    return folder / f"{next(iter(texts))}.nddl"


def names(loaded: LoadedModules) -> list[str]:
    return [Path(source.name).stem for source in loaded.sources]


def complaints(loaded: LoadedModules) -> list[tuple[str, str, int, list[str]]]:
    """Code, file, line and the lines of the notes of each complaint."""
    return [
        (
            one.code.id,
            Path(one.span.source.name).stem,
            one.span.line,
            [f"{Path(note.span.source.name).stem}:{note.span.line}" for note in one.notes if note.span is not None],
        )
        for one in loaded.diagnostics
    ]


def test_an_include_stands_for_the_text_of_its_file(tmp_path: Path) -> None:
    root = write(tmp_path, main='int a;\n#include "b.nddl"\nint c;', b="int b;\n")
    loaded = load_module_graph(root)
    assert outline(loaded.module).count("VariableDecl") == 3
    assert [statement.span.source.name for statement in loaded.module.statements] == [
        str(root),
        str(tmp_path / "b.nddl"),
        str(root),
    ]
    assert loaded.diagnostics == ()


def test_an_include_in_a_class_brings_members(tmp_path: Path) -> None:
    root = write(tmp_path, main='class A {\n#include "b.nddl"\nint c;\n}', b="int b;\npredicate p { }\n")
    loaded = load_module_graph(root)
    assert outline(loaded.module) == (
        "(ClassDecl A [(VariableDecl int [(Declarator b)]) (PredicateDecl p []) (VariableDecl int [(Declarator c)])])"
    )


def test_what_is_no_member_is_refused_in_a_file_included_in_a_class(tmp_path: Path) -> None:
    root = write(tmp_path, main='class A {\n#include "b.nddl"\n}', b="int b;\ngoal(t.p g);\nint c = 3;\n")
    assert complaints(load_module_graph(root)) == [("NDDL117", "b", 2, ["main:2"])]
    assert complaints(load_module_graph(root, dialect=Dialect.NDDL3)) == [
        ("NDDL117", "b", 2, ["main:2"]),
        ("NDDL155", "b", 3, ["main:2"]),
    ]


def test_a_file_is_read_once_whatever_its_path_looks_like(tmp_path: Path) -> None:
    (tmp_path / "link.nddl").symlink_to(tmp_path / "b.nddl")
    text = '#include "b.nddl"\n#include "./b.nddl"\n#include "link.nddl"\n#include "b.nddl"\n'
    loaded = load_module_graph(write(tmp_path, main=text, b="int b;\n"))
    assert names(loaded) == ["main", "b"]
    assert len(loaded.module.statements) == 1
    assert len(loaded.included) == 4


def test_a_file_is_named_by_the_path_that_a_repository_has_of_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A mark in a pull request at `rules/../shared/a.nddl` is placed nowhere."""
    write(tmp_path / "rules", root='#include "../shared/a.nddl"\n')
    write(tmp_path / "shared", a='#include "../rules/b.nddl"\n')
    write(tmp_path / "rules", b="int b;\n")
    monkeypatch.chdir(tmp_path)
    loaded = load_module_graph(Path("rules/root.nddl"))
    assert [Path(source.name).as_posix() for source in loaded.sources] == [
        "rules/root.nddl", "shared/a.nddl", "rules/b.nddl",
    ]  # fmt: skip


def test_behind_a_link_to_a_folder_its_parent_is_that_of_the_target(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path / "other", a="int right;\n")
    (tmp_path / "other" / "rules").mkdir()
    write(tmp_path / "other" / "rules", root='#include "../a.nddl"\n')
    write(tmp_path / "here", a="int wrong;\n")
    (tmp_path / "here" / "rules").symlink_to(tmp_path / "other" / "rules")
    monkeypatch.chdir(tmp_path)
    loaded = load_module_graph(Path("here/rules/root.nddl"))
    assert [source.text for source in loaded.sources if source.name.endswith("a.nddl")] == ["int right;\n"]


def test_the_nearest_file_wins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root = write(tmp_path / "model", main='#include "b.nddl"\n')
    first = write(tmp_path / "first", b="int first;\n").parent
    second = write(tmp_path / "second", b="int second;\n").parent
    here = write(tmp_path / "here", b="int here;\n").parent
    monkeypatch.chdir(here)
    assert "here" in outline(load_module_graph(root).module)
    assert "second" in outline(load_module_graph(root, [second, first]).module)
    write(tmp_path / "model", b="int beside;\n")
    assert "beside" in outline(load_module_graph(root, [second, first]).module)


def test_the_library_comes_last(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    root = write(tmp_path, main='#include "TREX.nddl"\n')
    assert names(load_module_graph(root)) == ["main", "TREX", "Plasma", "StringData"]
    write(tmp_path, TREX="int mine;\n")
    assert names(load_module_graph(root)) == ["main", "TREX"]


def test_a_missing_file_is_an_error_at_the_include(tmp_path: Path) -> None:
    root = write(tmp_path, main='int a;\n  #include "b.nddl"\nint c;')
    loaded = load_module_graph(root, [tmp_path])
    (complaint,) = loaded.diagnostics
    assert (complaint.code.id, complaint.code.kind, complaint.span.text) == ("NDDL190", "include", '#include "b.nddl"')
    assert complaint.message == "no file `b.nddl`"
    assert complaint.notes[0].message == (
        f"looked beside this file, in {tmp_path}, in the current directory and in the library"
    )
    assert len(loaded.module.statements) == 2


def test_a_folder_and_a_name_that_no_file_has_are_told_from_a_missing_file(tmp_path: Path) -> None:
    root = write(tmp_path, main='#include ""\n#include "a\0b"\n')
    assert [one[0] for one in complaints(load_module_graph(root))] == ["NDDL193", "NDDL193"]


def test_a_cycle_is_an_error_and_in_nddl3_a_warning(tmp_path: Path) -> None:
    root = write(tmp_path, main='#include "b.nddl"\nint a;\n', b='#include "main.nddl"\nint b;\n')
    loaded = load_module_graph(root)
    assert complaints(loaded) == [("NDDL191", "b", 1, ["main:1"])]
    assert len(loaded.module.statements) == 2
    (complaint,) = load_module_graph(root, dialect=Dialect.NDDL3).diagnostics
    assert (complaint.code.id, complaint.severity) == ("NDDL192", Severity.WARNING)


def test_an_error_in_an_included_file_shows_the_way_there(tmp_path: Path) -> None:
    root = write(tmp_path, main='int a;\n#include "b.nddl"\n', b='\n\n#include "c.nddl"\n', c="int = 3;\n")
    assert complaints(load_module_graph(root)) == [("NDDL110", "c", 1, ["b:3", "main:2"])]


def test_complaints_stand_in_the_order_of_execution(tmp_path: Path) -> None:
    root = write(tmp_path, main='int = 1;\n#include "b.nddl"\nint = 2;\n#include "c.nddl"\n', b="int = 3;\n")
    assert [one[:3] for one in complaints(load_module_graph(root))] == [
        ("NDDL110", "main", 1),
        ("NDDL110", "b", 1),
        ("NDDL110", "main", 3),
        ("NDDL190", "main", 4),
    ]


def test_a_chain_of_includes_has_an_end(tmp_path: Path) -> None:
    texts = {f"f{number}": f'#include "f{number + 1}.nddl"\n' for number in range(150)}
    loaded = load_module_graph(write(tmp_path, **texts))
    assert [one[0] for one in complaints(loaded)] == ["NDDL116"]


def test_the_first_line_chooses_the_dialect_of_all(tmp_path: Path) -> None:
    root = write(tmp_path, main='// nddlc: dialect=nddl3\n#include "b.nddl"\n', b="int b = 1 + 1;\n")
    assert [one[0] for one in complaints(load_module_graph(root))] == ["NDDL150"]
    assert complaints(load_module_graph(root, dialect=Dialect.NDDLC)) == []


def test_an_editor_shows_its_own_texts(tmp_path: Path) -> None:
    root = write(tmp_path, main='#include "b.nddl"\n', b="int saved;\n")
    texts = {root: root.read_text(), tmp_path / "b.nddl": "int unsaved;\n"}
    assert "unsaved" in outline(load_module_graph(root, open_text=texts.get).module)


def test_a_text_without_a_file_may_include(tmp_path: Path) -> None:
    write(tmp_path, b="int b;\n")
    loaded = load_module_graph(Source(str(tmp_path / "untitled.nddl"), '#include "b.nddl"\n'))
    assert (names(loaded), loaded.diagnostics) == (["untitled", "b"], ())


def test_a_root_that_is_missing_is_no_complaint(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        load_module_graph(tmp_path / "none.nddl")


@pytest.mark.parametrize("path", sorted(LIBRARY.glob("*.nddl")), ids=lambda path: path.stem)
def test_the_library_is_portable(path: Path) -> None:
    assert parse(Source(path.name, path.read_text(encoding="utf-8")), Dialect.NDDL3).diagnostics == ()
