"""Name files, so that the name is the same in every checkout and on every machine, and missions."""

from functools import cache
from pathlib import Path, PurePosixPath


@cache
def relative_name(name: str, root: Path) -> str:
    """`name` relative to the mission's folder, with `/`; a file of nddlc's own library is `library/` and its name."""
    path, folder = Path(name).resolve(), root.resolve()
    if path.is_relative_to(folder):
        return path.relative_to(folder).as_posix()
    parts = PurePosixPath(path.as_posix()).parts
    if "library" in parts and "nddl_lang" in parts:
        return "/".join(parts[parts.index("nddl_lang") + 1 :])
    if path.is_relative_to(folder.parent):
        return f"../{path.relative_to(folder.parent).as_posix()}"
    return Path(name).as_posix()


def mission_name(number: int) -> str:
    """A mission of a run as commands take it; `mission k3` is the third failure that the store has kept."""
    return f"mission {number_text(number)}"


def number_text(number: int) -> str:
    """The number of a mission as commands take it: `k3` of one that the store has kept."""
    return f"k{-number}" if number < 0 else str(number)


def as_named(file: str) -> Path:
    """A file with an absolute path as the user would name it from where they stand."""
    path = Path(file)
    return path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path
