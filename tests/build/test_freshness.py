"""A binary counts as fresh only while all that it was made from stands there unchanged."""

import importlib.metadata
import json
import shutil
from pathlib import Path

import pytest

from freshness import (
    SHARED,
    SUFFIX,
    binary,
    binary_digest,
    compiled_modules,
    engine_modules,
    needed,
    orphaned_binaries,
    source_digests,
    stale_modules,
    stamp,
    unfit_binaries,
)

ROOT = Path(__file__).resolve().parents[2]
TRAIL, TOKENS, CLOCK = "runtime.constraints.relaxation.trail", "runtime.plan.tokens.tokens", "runtime.executive.clock"


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """Lay out an engine of three modules, two of which share a layout, as if it had just been built."""
    shutil.copytree(ROOT / "build_backend", tmp_path / "build_backend")
    texts = {
        "runtime/constraints/relaxation/trail.pxd": "cdef class Trail:\n    cdef long long top\n",
        "runtime/constraints/relaxation/trail.py": "class Trail: ...\n",
        "runtime/plan/tokens/tokens.pxd": "from runtime.constraints.relaxation.trail cimport Trail\n",
        "runtime/plan/tokens/tokens.py": "class Tokens: ...\n",
        "runtime/executive/clock.pxd": "cdef long long now\n",
        "runtime/executive/clock.py": "now = 0\n",
        "runtime/constraints/domains/tags.py": "INF = 1\n",
    }
    for name, text in texts.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    seem_built(tmp_path)
    return tmp_path


def seem_built(root: Path) -> None:
    for module in compiled_modules(root):
        binary(root, module).write_bytes(module.encode())
    record = {module: [digest, binary_digest(root, module)] for module, digest in source_digests(root).items()}
    stamp(root).parent.mkdir(exist_ok=True)
    stamp(root).write_text(json.dumps(record), encoding="ascii")


def append(path: Path, text: str = "# changed\n") -> None:
    path.write_text(path.read_text(encoding="utf-8") + text, encoding="utf-8")


def test_the_engine_is_what_has_a_layout(tree: Path) -> None:
    assert engine_modules(tree) == [TRAIL, CLOCK, TOKENS]


def test_nothing_is_stale_after_a_build(tree: Path) -> None:
    assert stale_modules(tree) == [] == unfit_binaries(tree)


def test_a_touched_source_is_not_stale(tree: Path) -> None:
    (tree / "runtime/constraints/relaxation/trail.py").touch()
    assert stale_modules(tree) == []


def test_a_changed_source_makes_its_own_binary_stale(tree: Path) -> None:
    append(tree / "runtime/constraints/relaxation/trail.py")
    assert stale_modules(tree) == [TRAIL]
    assert unfit_binaries(tree) == [binary(tree, TRAIL)]


def test_a_changed_layout_makes_those_stale_that_read_it(tree: Path) -> None:
    append(tree / "runtime/constraints/relaxation/trail.pxd")
    assert stale_modules(tree) == [TRAIL, TOKENS]


def test_a_module_that_is_not_compiled_makes_nothing_stale(tree: Path) -> None:
    append(tree / "runtime/constraints/domains/tags.py")
    assert stale_modules(tree) == []


def test_a_changed_recipe_makes_all_stale(tree: Path) -> None:
    append(tree / "build_backend/translate.py")
    assert sorted(stale_modules(tree)) == sorted([TRAIL, CLOCK, TOKENS, SHARED])


def test_another_cython_makes_all_stale(tree: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.metadata, "version", lambda _: "another")
    assert sorted(stale_modules(tree)) == sorted([TRAIL, CLOCK, TOKENS, SHARED])


def test_a_binary_from_elsewhere_is_stale(tree: Path) -> None:
    binary(tree, TOKENS).write_bytes(b"another")
    assert stale_modules(tree) == [TOKENS]


def test_a_missing_binary_is_to_be_built_but_does_no_harm(tree: Path) -> None:
    binary(tree, TOKENS).unlink()
    assert stale_modules(tree) == [TOKENS]
    assert unfit_binaries(tree) == []


@pytest.mark.parametrize("gone", [[".pxd"], [".pxd", ".py"]])
def test_a_binary_whose_source_is_gone_is_an_orphan(tree: Path, gone: list[str]) -> None:
    for suffix in gone:
        (tree / f"runtime/executive/clock{suffix}").unlink()
    assert orphaned_binaries(tree) == [tree / f"runtime/executive/clock{SUFFIX}"] == unfit_binaries(tree)


@pytest.mark.parametrize(
    "line",
    [
        "from runtime.constraints.relaxation.trail cimport Trail",
        "from runtime.constraints cimport trail",
        "from runtime.constraints cimport (\n    domains,\n    trail,\n)",
        "cimport runtime.constraints.relaxation.trail",
        "cimport runtime.constraints.relaxation.trail as t",
    ],
)
def test_every_form_of_cimport_is_seen(line: str) -> None:
    layouts = {"a.reader": f"cimport cython\n{line}\ncdef int x".encode(), TRAIL: b"", CLOCK: b"cdef int trail"}
    assert needed("a.reader", layouts) == ["a.reader", TRAIL]


def test_layouts_are_followed_through_layouts() -> None:
    layouts = {"a.c": b"from a.b cimport B", "a.b": b"from a.a cimport A", "a.a": b"from a.c cimport C"}
    assert needed("a.c", layouts) == ["a.a", "a.b", "a.c"]
