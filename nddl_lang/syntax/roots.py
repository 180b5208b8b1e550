"""Tell among files which are models of their own, and which are parts that others include."""

import re
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from itertools import islice
from pathlib import Path

from nddl_lang.text.nearest import nearest
from nddl_lang.text.read import read_text, real_path

_MOST_INCLUDES = 10_000  # of a file that are looked at
_INCLUDE = re.compile(r'^[ \t]*#include[ \t]*"([^"\n]+)"', re.MULTILINE)
Listing = Callable[[Path], list[str]]  # the models in a folder, without `.nddl`


def roots_among(files: Sequence[Path], directories: Sequence[Path] = ()) -> list[Path]:
    """The files that no other one includes; of files that include each other in a cycle, the first."""
    by_key = {real_path(file): file for file in files}
    listed = cache(listed_models)
    included = {
        key: [each for each in _included(file, directories, listed) if each in by_key] for key, file in by_key.items()
    }
    parts = {target for targets in included.values() for target in targets}
    roots = [key for key in by_key if key not in parts]
    reached: set[Path] = set()
    for key in [*roots, *by_key]:
        if key not in reached:
            if key not in roots:
                roots.append(key)
            reached |= _reached([key], included)
    return [by_key[key] for key in by_key if key in set(roots)]


def parts_of(models: Sequence[Path], directories: Sequence[Path] = ()) -> frozenset[Path]:
    """The files in the folders of models that these include, and no other file beside them; resolved."""
    roots = [real_path(model) for model in models]
    own = _closure(roots, directories)
    beside = {real_path(path) for folder in {key.parent for key in own} for path in folder.glob("*.nddl")}
    others = _closure([path for path in beside if path not in own], directories)
    folders = {root.parent for root in roots}
    return frozenset(key for key in own - others - set(roots) if not folders.isdisjoint(key.parents))


def _closure(files: Sequence[Path], directories: Sequence[Path]) -> set[Path]:
    """Files and all that they include, directly or not."""
    listed = cache(listed_models)
    included: dict[Path, list[Path]] = {}
    pending = list(files)
    while pending:
        key = pending.pop()
        if key not in included:
            included[key] = _included(key, directories, listed)
            pending += included[key]
    return set(included)


def _reached(files: Sequence[Path], included: Mapping[Path, Sequence[Path]]) -> set[Path]:
    reached: set[Path] = set()
    pending = list(files)
    while pending:
        at = pending.pop()
        if at not in reached:
            reached.add(at)
            pending += included[at]
    return reached


def _included(file: Path, directories: Sequence[Path], listed: Listing) -> list[Path]:
    """The files that a file includes itself, resolved: of each name the first that exists."""
    found: list[Path] = []
    if not _is_file(file):
        return found  # what comes through a pipe can be read only once
    for include in islice(_INCLUDE.finditer(_text(file)), _MOST_INCLUDES):
        name = include[1]
        places = (place / name for place in (file.parent, *directories) if "\0" not in name)
        target = next((real_path(path) for path in places if _is_file(path)), None)
        if target is None and "\0" not in name and (meant := model_meant(name, file.parent, None, listed)):
            target = real_path(file.parent / meant)  # a misspelt include makes no model of its own of what was meant
        if target is not None and target != real_path(file):
            found.append(target)
    return found


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a name that no file can have
        return False


def _text(file: Path) -> str:
    try:
        return read_text(file) or ""
    except OSError:
        return ""


def listed_models(folder: Path) -> list[str]:
    """The models in a folder, without `.nddl`, in the order of their names; none where it cannot be read."""
    try:
        return sorted(path.stem for path in folder.iterdir() if path.suffix == ".nddl")
    except (OSError, ValueError):
        return []


def model_meant(name: str, folder: Path, library: Path | None, listed: Listing) -> str | None:
    """The model in the folder of an including text, or of the library, that the name of a missing file stands for."""
    path = Path(name)
    within = path.parent
    try:
        found = listed(folder / within)
    except ValueError:  # a name that no file can have
        return None
    if library is not None and path.name == name:
        found = [*found, *listed(library)]
    stem = path.stem
    meant = stem if stem in found else nearest(stem, found)
    return None if meant is None else str(within / f"{meant}.nddl")
