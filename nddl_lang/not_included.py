"""A file beside the text that declares what is unknown in it: one message names it, in place of one for each name."""

import os
import re
import stat
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from nddl_lang.semantics.codes import UNKNOWN_CLASS, UNKNOWN_NAME, UNKNOWN_TYPE
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import LIBRARY, LoadedModules
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
_WORD = re.compile(r"[^\W\d]\w*")


def name_missing_include(
    loaded: LoadedModules, found: Sequence[Diagnostic], declared: Declared
) -> tuple[Diagnostic, ...]:
    """`found`, where unknown names that one file would bring are told once, with an include of it as the fix.

    What that include would bring to the texts after it is not told again.
    """
    told = tuple(found)
    brought: frozenset[str] = frozenset()
    for source in dict.fromkeys(each.span.source for each in told if each.code in _UNKNOWN):
        told = tuple(each for each in told if not _is_unknown(each, source) or each.span.text not in brought)
        unknown = list(dict.fromkeys(each.span.text for each in told if _is_unknown(each, source)))
        bringing = _bringing(loaded, source, unknown, declared) if len(unknown) >= _FEWEST else None
        if bringing is not None:
            name, names = bringing
            brought |= names
            told = tuple(_told_once(loaded, source, told, name, unknown))
    return told


def _is_unknown(found: Diagnostic, source: Source) -> bool:
    return found.code in _UNKNOWN and found.span.source is source


def _bringing(
    loaded: LoadedModules, source: Source, unknown: list[str], declared: Declared
) -> tuple[str, frozenset[str]] | None:
    """The file that an include would bring all the unknown names from, and all that it brings.

    One beside the text goes before one of the library, one that declares them itself before one that includes them,
    then the one that brings least.
    """
    read = {real_path(path) for path in loaded.paths.values()}
    real: dict[Path, Path] = {}  # to ask the file system for the links on the way costs more than all else here
    best: tuple[tuple[bool, bool, int], str, frozenset[str]] | None = None
    for folder in (loaded.paths[source].parent, LIBRARY):
        for path in _models(folder, real):
            if real[path] in read or not _may_bring(path, unknown):
                continue
            own, _ = _declarations(path, loaded.dialect, declared)
            brought = frozenset(_with_includes(path, loaded.dialect, declared, real, set()))
            rank = (folder is LIBRARY, not own.issuperset(unknown), len(brought))
            if brought.issuperset(unknown) and (best is None or rank < best[0]):
                best = rank, path.name, brought
    return None if best is None else best[1:]


def _with_includes(
    path: Path, dialect: Dialect, declared: Declared, real: dict[Path, Path], seen: set[Path]
) -> Iterator[str]:
    """What a file declares, and what the files declare that it includes; `real` are the one names of files."""
    seen.add(real[path])
    own, includes = _declarations(path, dialect, declared)
    yield from own
    for name in includes:
        for other in (path.parent / name, LIBRARY / name):
            if other in real or other.is_file():
                if other not in real:
                    real[other] = real_path(other)
                if real[other] not in seen:
                    yield from _with_includes(other, dialect, declared, real, seen)
                break


def _models(folder: Path, real: dict[Path, Path]) -> list[Path]:
    """The models in a folder, in the order of their names; none where the folder cannot be read, or has very many.

    Their one names are put into `real`.
    """
    try:
        with os.scandir(folder) as entries:
            links = {entry.name: entry.is_symlink() for entry in entries if entry.name[1:].endswith(".nddl")}
    except OSError:
        return []
    if len(links) > _MOST_FILES:
        return []
    within = real_path(folder)
    found = [folder / name for name in sorted(links)]
    real.update((path, real_path(path) if links[path.name] else within / path.name) for path in found)
    return found


def _may_bring(path: Path, names: list[str]) -> bool:
    """Whether a file has all these words, or includes others: to read that costs far less than to parse it."""
    kind = _kind_of(path)
    if kind is None:
        return False
    words, includes = _words_at(path, kind.st_mtime_ns, kind.st_size)
    return includes or words.issuperset(names)


@lru_cache(maxsize=256)
def _words_at(path: Path, _changed: int, _size: int) -> tuple[frozenset[str], bool]:
    """The words of a file, and whether it includes another; read anew when it has changed."""
    try:
        text = read_text(path)
    except OSError:
        text = None
    return (frozenset(_WORD.findall(text)), "#include" in text) if text is not None else (frozenset(), False)


def _kind_of(path: Path) -> os.stat_result | None:
    """What the file system tells of a regular file that is not too large."""
    try:
        kind = path.stat()
    except OSError:
        return None
    return kind if stat.S_ISREG(kind.st_mode) and kind.st_size <= _LARGEST else None


def _declarations(path: Path, dialect: Dialect, declared: Declared) -> tuple[frozenset[str], tuple[str, ...]]:
    kind = _kind_of(path)
    if kind is None:
        return frozenset(), ()
    return _declarations_at(path, dialect, declared, kind.st_mtime_ns, kind.st_size)


@lru_cache(maxsize=256)
def _declarations_at(
    path: Path, dialect: Dialect, declared: Declared, _changed: int, _size: int
) -> tuple[frozenset[str], tuple[str, ...]]:
    """What a file declares itself, and what it includes; read anew when it has changed."""
    try:
        text = read_text(path)
    except OSError:
        return frozenset(), ()
    if text is None:
        return frozenset(), ()
    statements = parse(Source(str(path), text), dialect).module.statements
    names = frozenset(each.name for statement in statements for each in declared(statement))
    return names, tuple(each.path.value for each in statements if isinstance(each, Include))


def _told_once(
    loaded: LoadedModules, source: Source, found: Sequence[Diagnostic], file: str, names: list[str]
) -> Iterable[Diagnostic]:
    ours = [each for each in found if _is_unknown(each, source) and each.span.text in names]
    first = min(ours, key=lambda each: each.span.begin)
    for each in found:
        if each not in ours:
            yield each
        elif each is first:
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
