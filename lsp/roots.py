"""Find the model that a file is a part of, where only that file is open."""

import re
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

from lsp.uris import key_of
from nddl_lang.text.read import read_text

_INCLUDE = re.compile(r'^[ \t]*#include[ \t]*"([^"\n]+)"', re.MULTILINE)
_SUFFIX = ".nddl"
# Editors are opened on home directories too.
_MOST_ENTRIES = 1000
_LARGEST = 1_000_000


def root_of(path: Path) -> Path | None:
    """The file beside `path` that includes it, at first or second hand, and that no other file there includes.

    Of several the first by name; None where there is none. A file that includes itself in the end is no root.
    """
    target = key_of(path)
    includers: dict[str, list[Path]] = {}
    for file in _neighbours(path.parent):
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
    return min(roots, key=lambda file: file.name, default=None)


def _neighbours(directory: Path) -> Iterator[Path]:
    try:
        entries = sorted(islice(directory.iterdir(), _MOST_ENTRIES))
    except OSError:
        return
    yield from (entry for entry in entries if entry.suffix == _SUFFIX)


def _included(file: Path) -> Iterator[str]:
    """The keys of the files that `file` includes from its own directory or below."""
    try:
        text = read_text(file) if file.stat().st_size <= _LARGEST else None
    except (OSError, ValueError):
        return
    for name in _INCLUDE.findall(text or ""):
        yield key_of(file.parent / name)
