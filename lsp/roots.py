"""Find the model that a file is a part of, where only that file is open."""

import os
import re
from collections.abc import Iterable, Iterator
from functools import lru_cache
from itertools import islice
from pathlib import Path

from lsp.uris import key_of
from nddl_lang.text.read import read_text

_INCLUDE = re.compile(r'^[ \t]*#include[ \t]*"([^"\n]+)"', re.MULTILINE)
_SUFFIX = ".nddl"
# Editors are opened on home directories too.
MOST_FILES = 1000
_MOST_ENTRIES = 20_000
_LARGEST = 1_000_000


def root_of(path: Path) -> Path | None:
    """The file beside `path` that includes it, at first or second hand, and that no other file there includes.

    Of several the first by name; None where there is none. A file that includes itself in the end is no root.
    """
    return min(_roots(key_of(path), _neighbours(path.parent)), key=lambda file: file.name, default=None)


def folder_of(key: str) -> Path | None:
    """Where the file with that key lies; None of a text that was never saved."""
    return path.parent if (path := Path(key)).is_absolute() else None


def all_roots(key: str, folders: Iterable[Path]) -> list[Path]:
    """The files beside `key` and below `folders` that include it and that no other file there includes, by name."""
    folder = folder_of(key)
    files = {key_of(file): file for file in _neighbours(folder)} if folder is not None else {}
    for folder in folders:
        for file in models_below(folder):
            files.setdefault(key_of(file), file)
    return sorted(_roots(key, files.values()))


def models_below(folder: Path) -> Iterator[Path]:
    """The models in `folder` and the folders below it, hidden ones left out; not more than an editor can bear."""
    return files_below(folder, _SUFFIX)


def files_below(folder: Path, suffix: str) -> Iterator[Path]:
    """The files with that suffix in `folder` and the folders below it, as of `models_below`."""
    pending, count, seen = [str(folder)], 0, 0
    while pending and count < MOST_FILES and seen < _MOST_ENTRIES:
        try:
            with os.scandir(pending.pop()) as entries:
                found = sorted(islice(entries, _MOST_ENTRIES - seen), key=lambda entry: entry.name)
        except OSError:
            continue
        seen += len(found)
        for entry in found:
            if entry.name.startswith(".") or entry.name == "node_modules" or entry.is_symlink():
                continue
            if _is_folder(entry):
                pending.append(entry.path)
            elif entry.name.endswith(suffix) and count < MOST_FILES:
                count += 1
                yield Path(entry.path)


def _is_folder(entry: "os.DirEntry[str]") -> bool:
    try:
        return entry.is_dir()
    except OSError:
        return False


def _roots(target: str, files: Iterable[Path]) -> list[Path]:
    """Those of `files` that include `target` in the end, and that none of them includes."""
    includers: dict[str, list[Path]] = {}
    for file in files:
        for included in _included(file):
            includers.setdefault(included, []).append(file)
    reached = {target}
    pending = [target]
    roots: list[Path] = []
    while pending:
        for file in includers.get(pending.pop(), ()):
            key = key_of(file)
            if key in reached:
                continue
            reached.add(key)
            pending.append(key)
            if key not in includers:
                roots.append(file)
    return roots


def _neighbours(directory: Path) -> Iterator[Path]:
    try:
        entries = sorted(islice(directory.iterdir(), MOST_FILES))
    except OSError:
        return
    yield from (entry for entry in entries if entry.suffix == _SUFFIX)


def _included(file: Path) -> tuple[str, ...]:
    """The keys of the files that `file` includes from its own directory or below."""
    try:
        status = file.stat()
    except (OSError, ValueError):
        return ()
    return _read_includes(file, status.st_mtime_ns, status.st_size) if status.st_size <= _LARGEST else ()


@lru_cache(4 * MOST_FILES)
def _read_includes(file: Path, changed: int, size: int) -> tuple[str, ...]:
    """What `file` included when it was `changed` last and had that `size`."""
    del changed, size
    try:
        text = read_text(file)
    except (OSError, ValueError):
        return ()
    return tuple(key_of(file.parent / name) for name in _INCLUDE.findall(text or ""))
