"""The house holds: layers and rooms without cycles, small files, doors, third parties at home. Read from the text."""

import ast
import re
from collections import defaultdict
from collections.abc import Callable, Iterator
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from tests.module_names import public_names, signature_names, used_names

ROOT = Path(__file__).resolve().parent.parent

# Who may import whom; each may import itself.
LAYERS = {
    "nddl_lang": set[str](),
    "compiler": {"nddl_lang"},
    "runtime": {"nddl_lang", "compiler"},
    "checker": {"nddl_lang", "compiler", "runtime"},
    "lsp": {"nddl_lang", "compiler", "runtime", "checker"},
    "nddlc": {"nddl_lang", "compiler", "runtime", "checker", "lsp"},
}
# A third party is imported only by the files whose path starts so.
HOMES = {
    "lark": ("nddl_lang/syntax/",),
    "pygls": ("lsp/",),
    "lsprotocol": ("lsp/",),
    "z3": ("checker/smt/", "checker/proofs"),
    "networkx": ("checker/graph",),
    "distributed": ("checker/batch/cluster",),
    "scipy": ("checker/sampling/quasi_random",),
    "click": ("nddlc/",),
    "rich": ("nddlc/",),
}
# Same text and seed, same result: the lower layers know no clock and no chance of their own.
TIMELESS = ("nddl_lang", "compiler", "runtime")
CLOCKS_AND_DICE = {"datetime", "random", "secrets", "time", "uuid"}
# The one import that is not in the head of a file: `nddlc` starts fast, as it imports only the subcommand asked for.
LAZY = "nddlc/main.py"
OTHER_FOLDERS = ("bench", "build_backend", "tests")
MOST_LINES = 400
# Inside these, folders and the files beside them import each other one way only.
ROOMS = ("runtime/constraints", "runtime/plan", "runtime/solver")
# What is public need not be used here: users import it (docs/constraints.md, docs/reactors.md).
FOR_USERS = ("runtime/user/",)
# A subcommand is found by its file and this name.
SUBCOMMAND = "command"


def sources(root: Path, *folders: str) -> list[Path]:
    """List the Python files of some folders, in order."""
    return sorted(path for folder in folders for path in (root / folder).rglob("*.py"))


def imports(path: Path) -> tuple[tuple[int, str], ...]:
    """The line and the whole name of each import; `from a import b` is `a.b`, which may be a name in `a`."""
    return _imports(path.read_bytes())


@cache
def _imports(text: bytes) -> tuple[tuple[int, str], ...]:
    found: list[tuple[int, str]] = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found += [(node.lineno, alias.name) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            found += [(node.lineno, f"{'.' * node.level}{node.module or ''}.{alias.name}") for alias in node.names]
    return tuple(found)


def layer_breaks(root: Path) -> Iterator[str]:
    """Complain of imports that run upwards."""
    for path in sources(root, *LAYERS):
        layer = path.relative_to(root).parts[0]
        for line, name in imports(path):
            target = name.partition(".")[0]
            if name.startswith("."):
                yield f"{path.relative_to(root)}:{line}: the import is relative"
            elif target in LAYERS and target != layer and target not in LAYERS[layer]:
                yield f"{path.relative_to(root)}:{line}: {layer} imports {target}"


def modules(root: Path) -> dict[str, Path]:
    """Map the dotted name of each file of the layers to its path."""
    return {".".join(path.relative_to(root).with_suffix("").parts): path for path in sources(root, *LAYERS)}


def targets(path: Path, files: dict[str, Path]) -> set[str]:
    """The files that a file imports: a module, or the module that a name stands in."""
    return {target for _, name in imports(path) for target in (name, name.rpartition(".")[0]) if target in files}


def import_cycles(root: Path) -> Iterator[str]:
    """Complain of a cycle of files that import each other."""
    files = modules(root)
    try:
        TopologicalSorter({module: targets(path, files) for module, path in files.items()}).prepare()
    except CycleError as cycle:
        yield "a cycle of imports: " + " <- ".join(cycle.args[1])


def room_cycles(root: Path) -> Iterator[str]:
    """Complain of inner rooms that import each other; a file beside them is a room of its own."""
    files = modules(root)
    for layer in ROOMS:
        prefix = layer.replace("/", ".") + "."
        arrows: dict[tuple[str, str], str] = {}
        for module, path in files.items():
            for target in sorted(targets(path, files)):
                here, there = (name.removeprefix(prefix).partition(".")[0] for name in (module, target))
                if module.startswith(prefix) and target.startswith(prefix) and here != there:
                    arrows.setdefault((there, here), f"{target.removeprefix(prefix)} in {module.removeprefix(prefix)}")
        needs = defaultdict(set)
        for there, here in arrows:
            needs[here].add(there)
        try:
            TopologicalSorter(needs).prepare()
        except CycleError as cycle:
            steps = [arrows[step] for step in zip(cycle.args[1], cycle.args[1][1:], strict=False)]
            yield f"{layer}: a cycle of rooms: {' <- '.join(cycle.args[1])} ({'; '.join(steps)})"


def strangers(root: Path) -> Iterator[str]:
    """Complain of third parties that are imported outside their home."""
    for path in sources(root, *LAYERS):
        place = path.relative_to(root).as_posix()
        for line, name in imports(path):
            homes = HOMES.get(name.partition(".")[0])
            if homes is not None and not place.startswith(homes):
                yield f"{place}:{line}: {name.partition('.')[0]} is at home in {' and '.join(homes)}"


def clocks(root: Path) -> Iterator[str]:
    """Complain of clocks and dice where the result must depend on the input alone."""
    for path in sources(root, *TIMELESS):
        for line, name in imports(path):
            if name.partition(".")[0] in CLOCKS_AND_DICE:
                yield f"{path.relative_to(root)}:{line}: {name.partition('.')[0]} in a timeless layer"


def long_files(root: Path) -> Iterator[str]:
    """Complain of files that hold more than one idea."""
    for folder in (*LAYERS, *OTHER_FOLDERS):
        for path in sorted((root / folder).rglob("*.p[yx]*")):
            lines = path.read_bytes().count(b"\n") if path.suffix in (".py", ".pxd") else 0
            if lines > MOST_LINES:
                yield f"{path.relative_to(root)}: {lines} lines; split it by idea"


def captions(root: Path) -> Iterator[str]:
    """Complain of an `__init__.py` that is more than one sentence, is missing, or is where none belongs."""
    for folder in LAYERS:
        for path in sources(root, folder):
            caption = path.with_name("__init__.py")
            if not caption.exists():
                yield f"{path.relative_to(root)}: its folder has no __init__.py"
            elif path == caption:
                body = ast.parse(path.read_bytes()).body
                if len(body) != 1 or not ast.get_docstring(ast.Module(body, [])):
                    yield f"{path.relative_to(root)}: more, or less, than a caption"
    for folder in ("models", "tests"):
        yield from (
            f"{path.relative_to(root)}: {folder}/ is no package" for path in (root / folder).rglob("__init__.py")
        )


_HIDING = re.compile(
    rb"^(?!from |import )[^#\n]*\bimport\b|import\s*\(?\s*\*|TYPE_CHECKING|__import__|import_module", re.MULTILINE
)


def hidden_imports(root: Path) -> Iterator[str]:
    """Complain of imports that a reader of the head of the file does not see."""
    for path in sources(root, *LAYERS, *OTHER_FOLDERS):
        text = path.read_bytes()
        for node in ast.walk(ast.parse(text)) if _HIDING.search(text) else ():
            place = f"{path.relative_to(root)}:{getattr(node, 'lineno', 0)}"
            if isinstance(node, ast.ImportFrom) and any(alias.name == "*" for alias in node.names):
                yield f"{place}: a star import"
            elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
                for inner in ast.walk(node):
                    if isinstance(inner, ast.Import | ast.ImportFrom):
                        yield f"{path.relative_to(root)}:{inner.lineno}: an import inside a function"
            elif isinstance(node, ast.Name | ast.Attribute | ast.alias):
                name = {ast.Name: "id", ast.Attribute: "attr", ast.alias: "name"}[type(node)]
                lazy = getattr(node, name) == "import_module" and path == root / LAZY
                if getattr(node, name) in ("TYPE_CHECKING", "__import__", "import_module") and not lazy:
                    yield f"{place}: {getattr(node, name)} hides an import"


def lone_layouts(root: Path) -> Iterator[str]:
    """Complain of a `.pxd` that augments nothing, or stands where nothing is compiled."""
    for folder in (*LAYERS, *OTHER_FOLDERS):
        for path in sorted((root / folder).rglob("*.pxd")):
            if not path.with_suffix(".py").exists():
                yield f"{path.relative_to(root)}: no .py beside it"
            if folder != "runtime":
                yield f"{path.relative_to(root)}: only runtime is compiled"


def twins(root: Path) -> Iterator[str]:
    """Complain of a public class name that is defined in two files."""
    homes = defaultdict(list)
    for path in sources(root, *LAYERS):
        for name, line, is_class in public_names(ast.parse(path.read_bytes())):
            if is_class:
                homes[name].append(f"{path.relative_to(root).as_posix()}:{line}")
    yield from (f"class {name} in {' and '.join(places)}" for name, places in sorted(homes.items()) if places[1:])


def doors(root: Path) -> Iterator[str]:
    """Complain of what is public and used in its own file only: it wants an underscore.

    The grammar names the functions that make nodes, `pyproject.toml` the entry points, the command what it loads late.
    """
    trees = {path: ast.parse(path.read_bytes()) for path in sources(root, *LAYERS, *OTHER_FOLDERS)}
    settings, grammar = root / "pyproject.toml", root / "nddl_lang/syntax/grammar.lark"
    named = [path for path in (settings, *sorted((root / "nddlc").glob("*.py"))) if path.exists()]
    used = {pair for path in named for pair in re.findall(r'"([\w.]+):(\w+)"', path.read_text())}
    made = re.findall(r"->\s*(\w+)", grammar.read_text()) if grammar.exists() else []
    used |= {(f"nddl_lang.syntax.{module}", name) for module in ("builder", "statements") for name in made}
    for path, tree in trees.items():
        used |= set(used_names(path, tree))
    for module, path in modules(root).items():
        place = path.relative_to(root).as_posix()
        if place.startswith(FOR_USERS):
            continue
        shown = signature_names(trees[path])
        for name, line, _ in public_names(trees[path]):
            is_found = (module, name) in used or name in shown
            if not is_found and not (name == SUBCOMMAND and place.startswith("nddlc/")):
                yield f"{place}:{line}: {name} is used in its own file only"


def merge_marks(root: Path) -> Iterator[str]:
    """Complain of marks that a merge left in a page, a model or a table: no parser looks there."""
    for path in sorted(path for ending in ("md", "nddl", "toml") for path in root.glob(f"[dm]*/**/*.{ending}")):
        for line, text in enumerate(path.read_text(encoding="utf-8").split("\n"), 1):
            if text.startswith(("<<<<<<< ", ">>>>>>> ")):
                yield f"{path.relative_to(root).as_posix()}:{line}: a merge that was left half done"


CHECKS = [
    layer_breaks,
    import_cycles,
    room_cycles,
    strangers,
    clocks,
    long_files,
    captions,
    hidden_imports,
    lone_layouts,
    twins,
    doors,
    merge_marks,
]


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.__name__)
def test_the_house_holds(check: Callable[[Path], Iterator[str]]) -> None:
    assert list(check(ROOT)) == []


ALONE = "is used in its own file only"


@pytest.mark.parametrize(
    ("check", "files", "complaint"),
    [
        (layer_breaks, {"nddl_lang/a.py": "import compiler.b"}, "nddl_lang/a.py:1: nddl_lang imports compiler"),
        (layer_breaks, {"runtime/a.py": "\nfrom checker import b"}, "runtime/a.py:2: runtime imports checker"),
        (layer_breaks, {"checker/a.py": "import lsp"}, "checker/a.py:1: checker imports lsp"),
        (layer_breaks, {"lsp/a.py": "def f():\n    from nddlc import b"}, "lsp/a.py:2: lsp imports nddlc"),
        (layer_breaks, {"lsp/a.py": "from . import b"}, "lsp/a.py:1: the import is relative"),
        (
            import_cycles,
            {"compiler/a.py": "import compiler.b", "compiler/b.py": "from compiler.a import A"},
            "a cycle of imports: compiler.a <- compiler.b <- compiler.a",
        ),
        (import_cycles, {"compiler/a.py": "from compiler import a"}, "a cycle of imports: compiler.a <- compiler.a"),
        (
            room_cycles,
            {
                "runtime/plan/a/b.py": "import runtime.plan.c",
                "runtime/plan/c.py": "from runtime.plan.a.d import D",
                "runtime/plan/a/d.py": "",
            },
            "runtime/plan: a cycle of rooms: a <- c <- a (a.d in c; c in a.b)",
        ),
        (
            strangers,
            {"checker/a.py": "from z3 import sat"},
            "checker/a.py:1: z3 is at home in checker/smt/ and checker/proofs",
        ),
        (strangers, {"lsp/a.py": "import rich.text"}, "lsp/a.py:1: rich is at home in nddlc/"),
        (
            clocks,
            {"runtime/a.py": "from time import time"},
            "runtime/a.py:1: time in a timeless layer",
        ),
        (long_files, {"lsp/a.py": "\n" * 401}, "lsp/a.py: 401 lines; split it by idea"),
        (long_files, {"runtime/a.pxd": "\n" * 401}, "runtime/a.pxd: 401 lines; split it by idea"),
        (long_files, {"tests/a/b.py": "\n" * 401}, "tests/a/b.py: 401 lines; split it by idea"),
        (captions, {"lsp/__init__.py": '"""In."""\nA = 1'}, "lsp/__init__.py: more, or less, than a caption"),
        (captions, {"lsp/__init__.py": ""}, "lsp/__init__.py: more, or less, than a caption"),
        (captions, {"lsp/a/b.py": "", "lsp/__init__.py": '"""In."""'}, "lsp/a/b.py: its folder has no __init__.py"),
        (captions, {"tests/a/__init__.py": ""}, "tests/a/__init__.py: tests/ is no package"),
        (hidden_imports, {"lsp/a.py": "from os import *"}, "lsp/a.py:1: a star import"),
        (hidden_imports, {"lsp/a.py": "def f():\n    import os"}, "lsp/a.py:2: an import inside a function"),
        (hidden_imports, {"lsp/a.py": "from typing import TYPE_CHECKING"}, "lsp/a.py:1: TYPE_CHECKING hides an import"),
        (hidden_imports, {"tests/a.py": "__import__('os')"}, "tests/a.py:1: __import__ hides an import"),
        (
            twins,
            {"lsp/a.py": "class A: ...\nclass _B: ...", "nddlc/b.py": "\nclass A: ...\nclass _B: ..."},
            "class A in lsp/a.py:1 and nddlc/b.py:2",
        ),
        (doors, {"lsp/a.py": "def f(): ..."}, f"lsp/a.py:1: f {ALONE}"),
        (doors, {"lsp/a.py": "A = 1\n_B = A"}, f"lsp/a.py:1: A {ALONE}"),
        (doors, {"lsp/a.py": "class A: ...\ndef _f() -> A: ..."}, f"lsp/a.py:1: A {ALONE}"),
        (merge_marks, {"docs/a.md": "A\n<<<<<<< HEAD\nB\n"}, "docs/a.md:2: a merge that was left half done"),
        (lone_layouts, {"runtime/a.pxd": ""}, "runtime/a.pxd: no .py beside it"),
        (lone_layouts, {"lsp/a.pxd": "", "lsp/a.py": ""}, "lsp/a.pxd: only runtime is compiled"),
    ],
)
def test_a_broken_house_is_noticed(
    check: Callable[[Path], Iterator[str]], files: dict[str, str], complaint: str, tmp_path: Path
) -> None:
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    assert list(check(tmp_path)) == [complaint]


def test_what_is_allowed_is_not_complained_of(tmp_path: Path) -> None:
    files = {
        "checker/smt/terms.py": "import time\nimport z3\nfrom runtime.plan import tokens as rows\nrows.A + rows.B\n",
        "checker/smt/pair.py": "from checker.smt import terms\nfrom runtime.plan.tokens import c, C\n",
        "runtime/plan/tokens.py": "A: int = 1\nB, _D = 2, 3\nclass C: ...\nclass Pile: ...\n"
        "def c() -> Pile: ...\ndef d(): ...\n",
        "runtime/plan/other.py": "",
        "runtime/plan/other.pxd": "from runtime.plan.tokens cimport (\n    A, d\n)\n",
        "runtime/user/api.py": "def offered(): ...\n",
        "nddlc/fly.py": "def command(): ...\ndef main(): ...\n",
        "pyproject.toml": 'nddlc = "nddlc.fly:main"\n',
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    for caption in {parent for name in files for parent in Path(name).parents if name.endswith("py")} - {Path()}:
        (tmp_path / caption / "__init__.py").write_text('"""One sentence."""\n')
    assert [complaint for check in CHECKS for complaint in check(tmp_path)] == []
