"""Files that a mission file names: one that is not there, or is none, is told where it is named."""

from pathlib import Path

from checker.codes import NO_FILE, NO_TEXT_FILE
from checker.mission_table import MissionText
from nddl_lang.text.nearest import nearest


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
        text.diagnostics.append(NO_FILE.at(span, path=file, help=_suggest_file(root, file)))
    return is_file


def _suggest_file(root: Path, file: str) -> str | None:
    folder = (root / file).parent
    if not folder.is_dir():
        return "paths are relative to the mission file"
    close = nearest(Path(file).name, sorted(path.name for path in folder.iterdir()))
    return f"did you mean `{(Path(file).parent / close).as_posix()}`?" if close else None
