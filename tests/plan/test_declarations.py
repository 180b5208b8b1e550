"""The `.pxd` files of compiled rooms name what the `.py` files beside them hold, so that both forms stay the same."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

RUNTIME = Path(__file__).resolve().parents[2] / "runtime"
DECLARED = sorted(RUNTIME.rglob("*.pxd"))


def attributes(node: ast.ClassDef) -> set[str]:
    """What a class's methods set on `self`."""
    return {
        each.attr
        for each in ast.walk(node)
        if isinstance(each, ast.Attribute) and isinstance(each.ctx, ast.Store)
        if isinstance(each.value, ast.Name) and each.value.id == "self"
    }


def missing(path: Path) -> Iterator[str]:
    """Attributes of compiled classes that have no C type."""
    declared = path.read_text()
    classes = dict(re.findall(r"^cdef class (\w+)[^\n]*:\n((?:[ \n][^\n]*\n?)*)", declared, re.MULTILINE))
    for node in ast.parse(path.with_suffix(".py").read_text()).body:
        if isinstance(node, ast.ClassDef) and node.name in classes:
            words = set(re.findall(r"\w+", classes[node.name]))
            for name in sorted(attributes(node) - words):
                if not is_inherited(node, name):
                    yield f"{node.name}.{name}"


def unset(path: Path) -> Iterator[str]:
    """Fields of compiled classes that no method sets: an array without a value is no memory at all."""
    declared = path.read_text()
    classes = dict(re.findall(r"^cdef class (\w+)[^\n]*:\n((?:[ \n][^\n]*\n?)*)", declared, re.MULTILINE))
    for node in ast.parse(path.with_suffix(".py").read_text()).body:
        if isinstance(node, ast.ClassDef) and node.name in classes:
            for names in re.findall(
                r"^    cdef public (?:long )*[\w:\[\]]+ ([\w, ]+)$", classes[node.name], re.MULTILINE
            ):
                yield from (f"{node.name}.{name}" for name in names.split(", ") if name not in attributes(node))


def is_inherited(node: ast.ClassDef, name: str) -> bool:
    """Whether the attribute is one of a base class that is compiled, too."""
    return any(isinstance(base, ast.Name) and name in BASES.get(base.id, ()) for base in node.bases)


BASES = {
    name: set(re.findall(r"\w+", (RUNTIME / place).read_text()))
    for name, place in (
        ("Store", "constraints/domains/store.pxd"),
        ("SupportWalk", "constraints/explanation/support_walk.pxd"),
        ("TeleoReactor", "executive/reactor.pxd"),
        ("RowBlock", "rows/block.pxd"),
    )
}


@pytest.mark.parametrize("path", DECLARED, ids=lambda path: str(path.relative_to(RUNTIME)))
def test_all_attributes_of_compiled_classes_are_declared(path: Path) -> None:
    assert not list(missing(path))


@pytest.mark.parametrize("path", DECLARED, ids=lambda path: str(path.relative_to(RUNTIME)))
def test_all_fields_of_compiled_classes_are_set(path: Path) -> None:
    assert not list(unset(path))


@pytest.mark.parametrize("path", DECLARED, ids=lambda path: str(path.relative_to(RUNTIME)))
def test_only_functions_that_exist_are_declared(path: Path) -> None:
    tree = ast.parse(path.with_suffix(".py").read_text())
    defined = {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}
    declared = set(re.findall(r"^\s*c(?:p?)def (?!class)[\w ]*?(\w+)\(", path.read_text(), re.MULTILINE))
    assert declared <= defined
