"""The house holds: layers, no circles, small files, captions, and third parties at home. Read from the text alone."""

import ast
from collections.abc import Callable, Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

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
    "networkx": ("checker/causes",),
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


def sources(root: Path, *folders: str) -> list[Path]:
    """List the Python files of some folders, in order."""
    return sorted(path for folder in folders for path in (root / folder).rglob("*.py"))


def imports(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the line and the whole name of each import; `from a import b` is `a.b`, which may be a name in `a`."""
    for node in ast.walk(ast.parse(path.read_bytes())):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield from ((node.lineno, f"{'.' * node.level}{node.module or ''}.{alias.name}") for alias in node.names)


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


def circles(root: Path) -> Iterator[str]:
    """Complain of a circle of files that import each other."""
    files = {".".join(path.relative_to(root).with_suffix("").parts): path for path in sources(root, *LAYERS)}
    needs = {
        module: {target for _, name in imports(path) for target in (name, name.rpartition(".")[0]) if target in files}
        for module, path in files.items()
    }
    try:
        TopologicalSorter(needs).prepare()
    except CycleError as circle:
        yield "a circle of imports: " + " <- ".join(circle.args[1])


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


def hidden_imports(root: Path) -> Iterator[str]:
    """Complain of imports that a reader of the head of the file does not see."""
    for path in sources(root, *LAYERS, *OTHER_FOLDERS):
        tree = ast.parse(path.read_bytes())
        for node in ast.walk(tree):
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


CHECKS = [layer_breaks, circles, strangers, clocks, long_files, captions, hidden_imports, lone_layouts]


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.__name__)
def test_the_house_holds(check: Callable[[Path], Iterator[str]]) -> None:
    assert list(check(ROOT)) == []


@pytest.mark.parametrize(
    ("check", "files", "complaint"),
    [
        (layer_breaks, {"nddl_lang/a.py": "import compiler.b"}, "nddl_lang/a.py:1: nddl_lang imports compiler"),
        (layer_breaks, {"runtime/a.py": "\nfrom checker import b"}, "runtime/a.py:2: runtime imports checker"),
        (layer_breaks, {"checker/a.py": "import lsp"}, "checker/a.py:1: checker imports lsp"),
        (layer_breaks, {"lsp/a.py": "def f():\n    from nddlc import b"}, "lsp/a.py:2: lsp imports nddlc"),
        (layer_breaks, {"lsp/a.py": "from . import b"}, "lsp/a.py:1: the import is relative"),
        (
            circles,
            {"compiler/a.py": "import compiler.b", "compiler/b.py": "from compiler.a import A"},
            "a circle of imports: compiler.a <- compiler.b <- compiler.a",
        ),
        (circles, {"compiler/a.py": "from compiler import a"}, "a circle of imports: compiler.a <- compiler.a"),
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
    (tmp_path / "checker" / "smt").mkdir(parents=True)
    (tmp_path / "checker" / "smt" / "terms.py").write_text("import time\nimport z3\nfrom runtime.plan import tokens\n")
    for caption in ("checker", "checker/smt"):
        (tmp_path / caption / "__init__.py").write_text('"""One sentence."""\n')
    assert [complaint for check in CHECKS for complaint in check(tmp_path)] == []
