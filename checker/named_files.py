"""Files that a mission file names: one that is not there, or is none, is told where it is named."""

import ast
from dataclasses import replace
from pathlib import Path

from checker.codes import NO_CLASS, NO_FILE, NO_TEXT_FILE, OUT_OF_RANGE
from checker.mission_table import MissionText
from checker.respelt import respelt, rewritten
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.nearest import nearest
from nddl_lang.text.read import read_text
from runtime.user.reactor_library import OWN

_FREE = {"*", "exec()", "globals()", "setattr()", "__getattr__()"}  # by these a file may have any name


def look_at(text: MissionText, key: tuple[str | int, ...], root: Path, file: str) -> bool:
    """Whether a file is there; complains of one that is not, or is none, at the key that names it."""
    path, span = root / file, text.value_span(key)
    try:
        is_file, is_there, is_folder = path.is_file(), path.exists(), path.is_dir()
    except (OSError, ValueError):  # no path can be so: a name with a zero byte, or one that is too long
        is_file = is_there = is_folder = False
    if is_there and not is_file:
        what = "a directory" if is_folder else "a device or a pipe"
        text.diagnostics.append(NO_TEXT_FILE.at(span, path=file, what=what, help="name a regular file"))
    elif not is_file:
        text.diagnostics.append(_with_file_meant(NO_FILE.at(span, path=file), root, file))
    return is_file


def _with_file_meant(complaint: Diagnostic, root: Path, file: str) -> Diagnostic:
    """The complaint with the file that is meant."""
    folder = (root / file).parent
    if not folder.is_dir():
        return replace(complaint, help="paths are relative to the mission file")
    names = sorted(path.name for path in folder.iterdir())
    named = [name for name in names if Path(name).stem == Path(file).name]  # without its ending
    close = named[0] if len(named) == 1 else nearest(Path(file).name, names)
    if close is None:
        return complaint
    meant = (Path(file).parent / close).as_posix()
    return rewritten(replace(complaint, help=f"did you mean `{meant}`?"), file, meant)


def look_at_class(text: MissionText, key: tuple[str | int, ...], root: Path, file: str, class_name: str) -> None:
    """Complain of a class that a file with Python does not name; nothing is run, so whatever names it will do."""
    if file and not (root / file).resolve().is_relative_to(root.resolve()):
        return  # not of this project: whether it may be used at all is asked elsewhere
    named = ([*OWN], set()) if not file else _names_in(root / file)
    if named is None or class_name in named[0] or class_name in named[1]:
        return
    classes = named[0]
    if not file and class_name.endswith(".py"):
        found = (_names_in(root / class_name) or ([], set()))[0]
        text.diagnostics.append(
            OUT_OF_RANGE.at(
                text.value_span(key),
                key=key[-1],
                wanted="a file and a class in it, `file.py:Class`",
                found=f"`{class_name}`",
                help=f"write `{class_name}:{found[0]}`" if len(found) == 1 else None,
            )
        )
        return
    close = nearest(class_name, classes)
    there = f"it has {', '.join(f'`{each}`' for each in classes)}" if classes else "it has no class at all"
    help_text = f"did you mean `{close}`?" if close else there
    where = f"`{file}`" if file else "nddlc"
    complaint = NO_CLASS.at(text.value_span(key), where=where, name=class_name, help=help_text)
    text.diagnostics.append(respelt(complaint, class_name, classes))


def _names_in(path: Path) -> tuple[list[str], set[str]] | None:
    """The classes of a file, and the other names that it gives; None where its text does not tell."""
    try:
        tree = ast.parse(read_text(path) or "")
    except (OSError, ValueError, SyntaxError, RecursionError, MemoryError):
        return None  # told when it is run
    classes: list[str] = []
    others: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef):
            classes.append(node.name)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            others |= {one.asname or one.name for one in node.names}
        elif isinstance(node, ast.Name):
            others.add(node.id if isinstance(node.ctx, ast.Store) else f"{node.id}()")
        elif isinstance(node, ast.FunctionDef):
            others.add(f"{node.name}()")
    return None if others & _FREE else (list(dict.fromkeys(classes)), others)
