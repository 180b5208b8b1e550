"""A mission with its models in, all files out that decide what is told of it: read, named, or missing so far."""

import tomllib
from collections.abc import Iterator
from pathlib import Path

from checker.batch.explanations import Sources
from checker.mission import Mission
from checker.models import ModelSet
from nddl_lang.lint.configuration import NAME, PROJECT, settings_in
from nddl_lang.syntax.includes import LIBRARY
from nddl_lang.text.read import real_path
from nddl_lang.text.values import toml_value


def sources_of(mission: Mission, models: ModelSet) -> Sources | None:
    """Them; None where they are not known, as in a T-REX agent file, which names others."""
    try:
        values = toml_value(mission.source.text)
    except tomllib.TOMLDecodeError:
        return None
    root = real_path(Path(models.agent.root))
    read = [_file_of(name, root) for name in models.texts]
    named = [root / name for name in _texts_in(values) if _is_file(root / name)]
    folders = dict.fromkeys((root, *(path.parent for path in read)))
    above = dict.fromkeys(place for folder in folders for place in (folder, *folder.parents))
    settings = [place / name for place in above for name in (NAME, PROJECT)]
    included = [real_path(Path(one)) for folder in folders for one in settings_in(folder).directories]
    files = dict.fromkeys((real_path(Path(mission.source.name)), *read, *named, *settings))
    looked_at = dict.fromkeys((*folders, *included, real_path(Path())))
    return Sources(tuple(map(str, files)), tuple(str(one) for one in looked_at if one.is_dir()))


def _file_of(name: str, root: Path) -> Path:
    """The file that a text of a mission's models was read from; nddlc's own library is named as `library/`."""
    path = root / name
    return real_path(path) if path.exists() else LIBRARY.parent / name


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:  # no name of a file
        return False


def _texts_in(value: object) -> Iterator[str]:
    """All texts of a mission file: some of them name files."""
    match value:
        case str():
            yield value
        case dict():
            for each in value.values():
                yield from _texts_in(each)
        case list():
            for each in value:
                yield from _texts_in(each)
        case _:
            pass
