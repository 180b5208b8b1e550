"""A parsed Python file in, names out: what is public in it, what it takes from others, what its signatures speak of."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path


def public_names(tree: ast.Module) -> Iterator[tuple[str, int, bool]]:
    """Yield name, line and whether it is a class, of each public function, class and constant of a file."""
    for node in tree.body:
        names: list[str] = []
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            names = [node.name]
        elif isinstance(node, ast.Assign):
            names = [each.id for target in node.targets for each in ast.walk(target) if isinstance(each, ast.Name)]
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            names = [node.target.id]
        yield from ((name, node.lineno, isinstance(node, ast.ClassDef)) for name in names if not name.startswith("_"))


def dotted(node: ast.expr) -> str:
    """A name, or names joined by points, as it is written; empty for anything else."""
    if isinstance(node, ast.Name):
        return node.id
    owner = dotted(node.value) if isinstance(node, ast.Attribute) else ""
    return f"{owner}.{node.attr}" if isinstance(node, ast.Attribute) and owner else ""


def used_names(path: Path, tree: ast.Module) -> Iterator[tuple[str, str]]:
    """Yield module and name of all that a file takes from others: by name, through a module, or for its C types."""
    known: dict[str, str] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            yield from ((node.module or "", alias.name) for alias in node.names)
            known |= {alias.asname or alias.name: f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Import):
            known |= {alias.asname or alias.name: alias.name for alias in node.names}
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and (module := known.get(dotted(node.value))) is not None:
            yield module, node.attr
    layout = path.with_suffix(".pxd")
    declared = layout.read_text() if layout.exists() else ""
    for module, many, one in re.findall(r"^from (\S+) cimport (?:\(([^)]*)\)|(.*))", declared, re.MULTILINE):
        yield from ((module, name) for name in re.findall(r"\w+", many or one))


def signature_names(tree: ast.Module) -> set[str]:
    """The names in annotations and bases of what is public: who uses one holds the other, though without its name."""
    shown: list[ast.AST] = []
    for node in tree.body:
        inside = node.body if isinstance(node, ast.ClassDef) else []
        for each in (node, *inside):
            if isinstance(each, ast.FunctionDef | ast.AsyncFunctionDef) and not each.name.startswith("_"):
                arguments = (*each.args.posonlyargs, *each.args.args, *each.args.kwonlyargs)
                shown += [part for part in (each.returns, *(one.annotation for one in arguments)) if part is not None]
            elif isinstance(each, ast.AnnAssign):
                shown.append(each.annotation)
            elif isinstance(each, ast.ClassDef):
                shown += each.bases
            elif isinstance(each, ast.Assign) and isinstance(each.value, ast.BinOp | ast.Subscript):
                shown.append(each.value)  # a type with a name
    return {
        name.id for part in shown for name in ast.walk(part) if isinstance(name, ast.Name) and not name.id.isupper()
    }
