"""The package is built with the machine's compiler, with zig's, or uncompiled, and a rebuild follows every edit."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

import pytest

from freshness import SUFFIX

pytestmark = pytest.mark.builds

ROOT = Path(__file__).resolve().parents[2]
WARNING = "warning: the engine of nddlc is not compiled"
# Two modules, one of which reads the other's layout: enough engine to be built in seconds.
TINY_ENGINE = {
    "__init__.py": '"""A tiny engine."""\n',
    "cells.py": "class Cell:\n    def __init__(self) -> None:\n        self.content = 40\n",
    "cells.pxd": "cdef class Cell:\n    cdef public long long content\n",
    "sums.py": "from runtime.tiny.cells import Cell\n\n\ndef total(cell: Cell) -> int:\n    return cell.content + 2\n",
    "sums.pxd": "from runtime.tiny.cells cimport Cell\n\ncpdef long long total(Cell cell)\n",
}
ASK = """
from runtime.build_form import build_form, uncompiled_notice
from runtime.tiny.cells import Cell
from runtime.tiny.sums import total
print(total(Cell()), build_form(), uncompiled_notice() is not None)
"""


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """Copy what is packaged, with the tiny engine in place of the real one."""
    root = tmp_path / "tree"
    for folder in ("nddl_lang", "compiler", "runtime", "checker", "lsp", "nddlc", "models", "build_backend"):
        shutil.copytree(ROOT / folder, root / folder, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    for path in ROOT.iterdir():
        if path.is_file():
            shutil.copy(path, root)
    for layout in (root / "runtime").rglob("*.pxd"):
        layout.unlink()
    (root / "runtime" / "tiny").mkdir()
    for name, text in TINY_ENGINE.items():
        (root / "runtime" / "tiny" / name).write_text(text, encoding="ascii")
    return root


def run(*arguments: str | Path, root: Path, **variables: str) -> str:
    """Run this Python in `root` with no more environment than that; answer with all that it printed."""
    kept = {name: os.environ[name] for name in os.environ if name.startswith(("PIP_", "SSL_")) or name == "HOME"}
    kept |= {name: value for name, value in os.environ.items() if name.lower().endswith("_proxy")}
    done = subprocess.run(
        [sys.executable, *map(str, arguments)],
        cwd=root,
        env={"PATH": os.environ["PATH"], **kept, **variables},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout
    return done.stdout


def build_wheel(tree: Path, *options: str, **variables: str) -> tuple[Path, str]:
    """Build a wheel of `tree`; answer with it and with what was printed."""
    output = run("-m", "pip", "wheel", "-v", "--no-deps", "-w", "out", *options, ".", root=tree, **variables)
    (wheel,) = (tree / "out").glob("*.whl")
    return wheel, output


def contents(wheel: Path) -> set[str]:
    with ZipFile(wheel) as archive:
        return set(archive.namelist())


def answer_of(wheel: Path, folder: Path, **variables: str) -> str:
    """Unpack the wheel elsewhere and ask it in which form it runs."""
    with ZipFile(wheel) as archive:
        archive.extractall(folder / "installed")
    return run("-c", ASK, root=folder, PYTHONPATH=str(folder / "installed"), **variables).strip()


def test_a_wheel_carries_binaries_grammar_models_and_types(tree: Path, tmp_path: Path) -> None:
    wheel, output = build_wheel(tree, "--no-build-isolation", NDDLC_REQUIRE_COMPILED="1")
    names = contents(wheel)
    expected = {
        f"runtime/tiny/cells{SUFFIX}",
        f"runtime/tiny/sums{SUFFIX}",
        "runtime/tiny/sums.py",
        "runtime/tiny/sums.pxd",
        "nddl_lang/syntax/grammar.lark",
        "nddlc-0.1.0.dist-info/entry_points.txt",
        "nddlc-0.1.0.dist-info/licenses/LICENSE",
        *(f"{folder}/py.typed" for folder in ("nddl_lang", "compiler", "runtime", "checker", "lsp", "nddlc")),
    }
    data = {path.relative_to(tree).as_posix() for path in (tree / "models").rglob("*") if path.is_file()}
    assert expected <= names
    assert data <= names
    assert not [name for name in names if name.startswith(("tests", "bench", "build")) or "__pycache__" in name]
    assert WARNING not in output
    assert answer_of(wheel, tmp_path) == "42 compiled False"
    assert answer_of(wheel, tmp_path, NDDLC_INTERPRETED="1") == "42 interpreted False"


def test_without_a_compiler_on_the_path_zig_compiles(tree: Path, tmp_path: Path) -> None:
    wheel, output = build_wheel(tree, PATH="", NDDLC_REQUIRE_COMPILED="1")
    assert f"runtime/tiny/sums{SUFFIX}" in contents(wheel)
    assert "ziglang" in output
    assert answer_of(wheel, tmp_path) == "42 compiled False"


def test_with_a_compiler_at_hand_zig_is_not_asked_for(tree: Path) -> None:
    assert "ziglang" in run("build_backend/nddlc_build.py", root=tree, PATH="")
    assert "ziglang" in run("build_backend/nddlc_build.py", root=tree, CC="no-such-compiler")
    assert run("build_backend/nddlc_build.py", root=tree, NDDLC_NO_COMPILE="1") == "\n"


def test_compiling_can_be_refused(tree: Path, tmp_path: Path) -> None:
    wheel, output = build_wheel(tree, "--no-build-isolation", NDDLC_NO_COMPILE="1")
    assert wheel.name.endswith("-py3-none-any.whl")
    assert output.count(WARNING) == 1
    assert answer_of(wheel, tmp_path) == "42 interpreted True"


def test_where_both_compilers_fail_the_package_installs_uncompiled(tree: Path, tmp_path: Path) -> None:
    broken = tmp_path / "broken" / "ziglang"
    broken.mkdir(parents=True)
    (broken / "__init__.py").write_text("", encoding="ascii")
    (broken / "__main__.py").write_text("raise SystemExit('no target')\n", encoding="ascii")
    wheel, output = build_wheel(tree, "--no-build-isolation", CC="false", PYTHONPATH=str(broken.parent))
    assert not [name for name in contents(wheel) if name.endswith(SUFFIX)]
    assert output.count(WARNING) == 1
    assert answer_of(wheel, tmp_path) == "42 interpreted True"


def test_an_edit_is_rebuilt_with_all_that_depends_on_it_and_nothing_else(tree: Path) -> None:
    def build() -> list[str]:
        told = run("build_backend/build_in_place.py", root=tree, NDDLC_REQUIRE_COMPILED="1").splitlines()
        return [line for line in told if not line.startswith("  compiling the engine: ")]  # progress, every few seconds

    def ask() -> str:
        return run("-c", ASK, root=tree, PYTHONPATH=str(tree)).strip()

    both = ["compiled runtime.tiny.cells", "compiled runtime.tiny.sums"]
    assert build() == ["compiled runtime.shared_views", *both]
    assert build() == []
    assert ask() == "42 compiled False"

    sums = tree / "runtime/tiny/sums.py"
    clock = sums.stat().st_mtime
    sums.write_text(TINY_ENGINE["sums.py"].replace("+ 2", "+ 3"), encoding="ascii")
    os.utime(sums, (clock - 1e6, clock - 1e6))  # an older file from another branch is an edit too
    assert build() == ["compiled runtime.tiny.sums"]
    assert ask() == "43 compiled False"

    layout = tree / "runtime/tiny/cells.pxd"
    layout.write_text(TINY_ENGINE["cells.pxd"].replace("public long long", "public int"), encoding="ascii")
    assert build() == both
    assert ask() == "43 compiled False"

    (tree / "runtime/tiny/sums.pxd").unlink()
    assert build() == []
    assert not (tree / f"runtime/tiny/sums{SUFFIX}").exists()


def test_a_mistake_in_the_engine_fails_the_build_and_leaves_the_last_binaries(tree: Path) -> None:
    run("build_backend/build_in_place.py", root=tree)
    (tree / "runtime/tiny/sums.pxd").write_text("cpdef no such thing\n", encoding="ascii")
    with pytest.raises(AssertionError, match=r"sums\.pxd"):
        run("build_backend/build_in_place.py", root=tree)
    assert (tree / f"runtime/tiny/cells{SUFFIX}").exists()


def test_a_wheel_can_be_built_from_the_source_distribution(tree: Path) -> None:
    hook = "import sys; sys.path.insert(0, 'build_backend'); import nddlc_build; nddlc_build.build_sdist('dist')"
    run("-c", hook, root=tree)
    (archive,) = (tree / "dist").glob("*.tar.gz")
    run("-m", "tarfile", "-e", archive, tree / "unpacked", root=tree)
    (source,) = (tree / "unpacked").iterdir()
    wheel, _ = build_wheel(source, "--no-build-isolation", NDDLC_REQUIRE_COMPILED="1")
    assert {f"runtime/tiny/sums{SUFFIX}", "models/gps/mission.toml", "nddl_lang/syntax/grammar.lark"} <= contents(wheel)
