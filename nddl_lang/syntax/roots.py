"""Tell among files which are models of their own, and which are parts that others include."""

import re
from collections.abc import Sequence
from pathlib import Path

from nddl_lang.text.read import read_text

_INCLUDE = re.compile(r'^[ \t]*#include[ \t]*"([^"\n]+)"', re.MULTILINE)


def roots_among(files: Sequence[Path], directories: Sequence[Path] = ()) -> list[Path]:
    """The files that no other one includes; of files that include each other in a circle, the first."""
    by_key = {file.resolve(): file for file in files}
    included: dict[Path, list[Path]] = {}
    for key, file in by_key.items():
        names = _INCLUDE.findall(_text(file))
        places = [place / name for name in names for place in (file.parent, *directories)]
        included[key] = [target for place in places if (target := place.resolve()) in by_key and target != key]
    parts = {target for targets in included.values() for target in targets}
    roots = [key for key in by_key if key not in parts]
    reached: set[Path] = set()
    for key in [*roots, *by_key]:
        if key in reached:
            continue
        if key not in roots:
            roots.append(key)
        pending = [key]
        while pending:
            at = pending.pop()
            if at not in reached:
                reached.add(at)
                pending += included[at]
    return [by_key[key] for key in by_key if key in set(roots)]


def _text(file: Path) -> str:
    try:
        return read_text(file) or ""
    except OSError:
        return ""
