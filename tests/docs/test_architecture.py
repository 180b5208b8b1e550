"""The pages for who changes nddlc tell the truth: files, functions and arrows exist, and no file is missing.

A file is named from the root, or from the folder in the heading above it. A name of code must be defined in a file that
the same paragraph, item or row names.
"""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.test_house import LAYERS, ROOMS, modules, sources, targets

ROOT = Path(__file__).resolve().parents[2]
PAGES = ("docs/architecture.md", "docs/extending.md")
FENCES = re.compile(r"^\s*```[^\n]*\n.*?^\s*```$", re.M | re.S)
INLINE = re.compile(r"`([^`\n]+)`")
NAME = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)?")
# Words that are no names of code: the language's own, and file endings. What is typed begins with a command.
WORDS = {"sampledParameter", "before", "nddl3", "Timeline", "PlannerConfig", "code", ".pxd", "atMost(k, b1, …)"}
COMMANDS = ("nddlc", "make", "python", "replay", "gold")
TABLES = ("codes.py", "tags.py", "pages*.py", "x.py", "x.pxd")  # one in many rooms


def blocks(text: str) -> Iterator[tuple[str, str]]:
    """Yield the folder that a heading names, and each paragraph, item or row under it."""
    base, lines = "", list[str]()
    for line in [*FENCES.sub("\n", text).splitlines(), ""]:
        if not line.strip() or re.match(r"\s*(\||\*|-|\d+\.|#)", line):
            if lines:
                yield base, " ".join(lines)
            lines = []
        if line.startswith("#"):
            folders = [each for each in INLINE.findall(line) if (ROOT / each).is_dir()]
            base = folders[0] if len(folders) == 1 else ""
        elif line.strip():
            lines.append(line.strip())


def found(base: str, path: str) -> list[Path]:
    """The files or folders that a path means, which may be a pattern."""
    for folder in dict.fromkeys((ROOT, ROOT / base)):
        if there := sorted(folder.glob(path.rstrip("/"))):
            return there
    return []


def is_path(words: str) -> bool:
    return "/" in words or re.search(r"\.(py|md|lark|toml|css|pxd)$", words) is not None


def defined(path: Path) -> set[str]:
    """Functions, classes, constants, methods and fields of a file; of what is in a class also as `Class.name`."""
    names = set[str]()
    tree = ast.parse(path.read_bytes())
    for node in ast.walk(tree):
        inside = [node] if not isinstance(node, ast.ClassDef) else [node, *node.body]
        for each in inside:
            own = set[str]()
            if isinstance(each, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                own = {each.name}
            elif isinstance(each, ast.Assign | ast.AnnAssign):
                aims = each.targets if isinstance(each, ast.Assign) else [each.target]
                parts = [part for aim in aims for part in ast.walk(aim)]
                own = {part.id for part in parts if isinstance(part, ast.Name)}
                own |= {part.attr for part in parts if isinstance(part, ast.Attribute)}
            names |= own
            if isinstance(node, ast.ClassDef) and each is not node:
                names |= {f"{node.name}.{name}" for name in own}
    return names


def mistakes(text: str) -> Iterator[str]:
    """What a page names and is not there."""
    for base, block in blocks(text):
        spans = INLINE.findall(block)
        files = [path for span in spans if is_path(span) for path in found(base, span)]
        known: set[str] | None = None
        for span in spans:
            if span in WORDS or span in TABLES or span.split()[0] in COMMANDS or (ROOT / base / span).exists():
                continue
            if is_path(span):
                if not found(base, span):
                    yield f"no file `{span}`"
            elif NAME.fullmatch(span) is None:
                yield f"`{span}` is no name"
            else:
                if known is None:
                    known = set().union(*(defined(path) for path in files if path.suffix == ".py"))
                if span not in known:
                    yield f"`{span}` is in no file that is named beside it: {block[:80]}"


@pytest.mark.parametrize("page", PAGES)
def test_what_a_page_names_exists(page: str) -> None:
    assert list(mistakes((ROOT / page).read_text(encoding="utf-8"))) == []


def test_a_name_that_is_not_there_is_noticed() -> None:
    text = (
        "## Room `runtime/plan`\n\n`gone.py`, `tags.py`\n\n* `fire` in `lifecycle.py`, `fires` too\n* `fire`\n\n`a b`\n"
    )
    told = [each.partition(":")[0] for each in mistakes(text)]
    beside = "is in no file that is named beside it"
    assert told == ["no file `gone.py`", f"`fires` {beside}", f"`fire` {beside}", "`a b` is no name"]
    assert list(mistakes("`Engine.explain` in `runtime/constraints/engine.py`")) == []
    assert list(mistakes("`Store.explain` in `runtime/constraints/engine.py`")) != []


def missing(text: str) -> list[str]:
    """The files of all layers that a page does not tell of, by themselves or by their innermost folder."""
    told = {
        path
        for base, block in blocks(text)
        for each in INLINE.findall(block)
        if is_path(each)
        for path in found(base, each)
    }
    told -= {ROOT / layer for layer in (*LAYERS, *ROOMS, "runtime/executive", "runtime/determined", "runtime/view")}
    files = [path for path in sources(ROOT, *LAYERS) if path.name not in ("__init__.py", "codes.py", "tags.py")]
    return [path.relative_to(ROOT).as_posix() for path in files if path not in told and path.parent not in told]


def test_every_file_is_told_of() -> None:
    text = (ROOT / PAGES[0]).read_text(encoding="utf-8")
    assert missing(text) == []
    assert missing(text.replace("`relaxation/cone.py`", "")[: text.index("## Route")]) == [
        "runtime/constraints/relaxation/cone.py"
    ]


def arrows(layer: str) -> dict[str, set[str]]:
    """Which inner rooms of a layer import which."""
    files = modules(ROOT)
    prefix = layer.replace("/", ".") + "."
    drawn: dict[str, set[str]] = {}
    for module, path in files.items():
        if module.startswith(prefix) and module != prefix.rstrip("."):
            here = module.removeprefix(prefix).partition(".")[0]
            there = {
                each.removeprefix(prefix).partition(".")[0] for each in targets(path, files) if each.startswith(prefix)
            }
            drawn.setdefault(here, set()).update(there - {here, "__init__"})
    drawn.pop("__init__", None)
    return drawn


@pytest.mark.parametrize("layer", ROOMS)
def test_arrows_are_those_of_the_imports(layer: str) -> None:
    text = (ROOT / PAGES[0]).read_text(encoding="utf-8").partition(f"### `{layer}`\n")[2]
    table = text.partition("| --- | --- | --- |\n")[2].partition("\n\n")[0]
    rows = [row.strip("|").split("|") for row in table.splitlines()]
    told = {
        room.strip(" `").removesuffix(".py"): {each.removesuffix(".py") for each in INLINE.findall(uses)}
        for room, uses, _ in rows
    }
    assert told == arrows(layer)
