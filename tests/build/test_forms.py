"""Where the environment asks for the interpreted engine, no process of ours loads a binary."""

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from freshness import binary, engine_modules

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("nddl_lang", "compiler", "runtime", "checker", "lsp", "nddlc")
IMPORT_ALL = "import importlib, sys; [importlib.import_module(name) for name in sys.argv[1:]]"


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Copy the packages and their bytecode, with a binary beside each engine module that breaks whoever loads it."""
    root = tmp_path_factory.mktemp("tree")
    for folder in FOLDERS:
        shutil.copytree(ROOT / folder, root / folder, ignore=shutil.ignore_patterns("*.so"))
    for module in engine_modules(root):
        binary(root, module).write_bytes(b"no library at all")
    return root


def modules(root: Path) -> list[str]:
    """Name all modules of ours, in order."""
    files = sorted(path for folder in FOLDERS for path in (root / folder).rglob("*.py"))
    return [".".join(path.relative_to(root).with_suffix("").parts) for path in files if path.name != "__init__.py"]


def import_all(root: Path, first: str, others: Sequence[str], **variables: str) -> subprocess.CompletedProcess[str]:
    """Import modules in a fresh process, one before the others."""
    return subprocess.run(
        [sys.executable, "-c", IMPORT_ALL, first, *others],
        cwd=root,
        env={**os.environ, "PYTHONPATH": str(root), **variables},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize("first", ["nddlc.main", "checker.batch.worker", "runtime.build_form"])
def test_who_starts_a_process_decides_the_form_first(tree: Path, first: str) -> None:
    others = modules(tree) if first == "nddlc.main" else engine_modules(tree)
    done = import_all(tree, first, others, NDDLC_INTERPRETED="1")
    assert done.returncode == 0, done.stderr


def test_the_binaries_of_this_test_would_break_who_loads_them(tree: Path) -> None:
    done = import_all(tree, "nddlc.main", engine_modules(tree), NDDLC_INTERPRETED="0")
    assert "ImportError" in done.stderr
