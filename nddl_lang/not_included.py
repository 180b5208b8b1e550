"""A file beside the text that declares what is unknown in it: one message names it, in place of one for each name."""

import stat
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from nddl_lang.semantics.codes import UNKNOWN_CLASS, UNKNOWN_NAME, UNKNOWN_TYPE
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import LoadedModules
from nddl_lang.syntax.nodes import Identifier, Include, Statement
from nddl_lang.syntax.parser import parse
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix
from nddl_lang.text.read import read_text, real_path
from nddl_lang.text.source import Anchor, Source, Span

Declared = Callable[[Statement], Iterable[Identifier]]

_UNKNOWN = (UNKNOWN_NAME, UNKNOWN_TYPE, UNKNOWN_CLASS)
_FEWEST = 2  # names; a single one is more likely to be misspelt
_MOST_FILES = 100
_LARGEST = 2**20  # bytes


def name_missing_include(
    loaded: LoadedModules, found: Sequence[Diagnostic], declared: Declared
) -> tuple[Diagnostic, ...]:
    """`found`, where unknown names that one file beside declares are told once, with an include of it as the fix."""
    told = tuple(found)
    for source in dict.fromkeys(each.span.source for each in told if each.code in _UNKNOWN):
        unknown = list(
            dict.fromkeys(each.span.text for each in told if each.code in _UNKNOWN and each.span.source is source)
        )
        beside = _declaring(loaded, source, unknown, declared) if len(unknown) >= _FEWEST else None
        if beside is not None:
            told = tuple(_told_once(loaded, source, told, beside, unknown))
    return told


def _declaring(loaded: LoadedModules, source: Source, unknown: Iterable[str], declared: Declared) -> str | None:
    """The first file in the folder of a text that declares all the unknown names; None if none does."""
    read = {real_path(path) for path in loaded.paths.values()}
    for path in _models(loaded.paths[source].parent):
        if real_path(path) not in read and _names(path, loaded.dialect, declared).issuperset(unknown):
            return path.name
    return None


def _models(folder: Path) -> list[Path]:
    """The models in a folder, in the order of their names; none where the folder cannot be read, or has very many."""
    try:
        found = sorted(path for path in folder.iterdir() if path.suffix == ".nddl")
    except OSError:
        return []
    return found if len(found) <= _MOST_FILES else []


def _names(path: Path, dialect: Dialect, declared: Declared) -> frozenset[str]:
    try:
        kind = path.stat()
    except OSError:
        return frozenset()
    if not stat.S_ISREG(kind.st_mode) or kind.st_size > _LARGEST:
        return frozenset()
    return _names_at(path, dialect, declared, kind.st_mtime_ns, kind.st_size)


@lru_cache(maxsize=256)
def _names_at(path: Path, dialect: Dialect, declared: Declared, _changed: int, _size: int) -> frozenset[str]:
    """What a file declares itself, read anew when it has changed."""
    try:
        text = read_text(path)
    except OSError:
        return frozenset()
    if text is None:
        return frozenset()
    module = parse(Source(str(path), text), dialect).module
    return frozenset(each.name for statement in module.statements for each in declared(statement))


def _told_once(
    loaded: LoadedModules, source: Source, found: Iterable[Diagnostic], file: str, names: list[str]
) -> Iterable[Diagnostic]:
    is_first = True
    for each in found:
        if each.code not in _UNKNOWN or each.span.source is not source or each.span.text not in names:
            yield each
        elif is_first:
            is_first = False
            others = [f"`{name}`" for name in names if name != each.span.text]
            also = f"{', '.join(others[:-1])} and {others[-1]}" if len(others) > 1 else others[0]
            advice = f"`{file}`, which is not included, declares `{each.span.text}`, and {also}"
            at = _place(loaded, source)
            fix = Fix(f'add `#include "{file}"`', (Edit(Span(Anchor(source), at, at), f'#include "{file}"\n'),), False)
            yield replace(each, help=advice, fixes=(fix,))


def _place(loaded: LoadedModules, source: Source) -> int:
    """Where an include goes: below those that the text begins with, else below a comment in its first line."""
    statements = next(each.module.statements for each in loaded.parses if each.source is source)
    last = 0 if not source.line(1).startswith("//") else 1
    for statement in statements:
        if not isinstance(statement, Include):
            break
        last = source.locate(statement.span.finish)[0]
    return source.line_starts[last] if last < len(source.line_starts) else len(source.text)
