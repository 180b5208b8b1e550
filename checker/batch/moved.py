"""A store and a mission file in, where that file is now out: a project may have been copied or moved with its store.

Of a mission file below the project's folder the store remembers where in it. What older stores hold has no such place,
and is where it was.
"""

import os
import sqlite3
from pathlib import Path

FOLDER = ".nddlc"  # where a project keeps its store
PLACES = """
CREATE TABLE IF NOT EXISTS places (
    mission_file TEXT PRIMARY KEY,
    below TEXT NOT NULL
) WITHOUT ROWID;
"""


def note_place(connection: sqlite3.Connection, store: Path, mission_file: str) -> None:
    """Remember where a mission file is in the project of a store, if it is a part of that."""
    path, project = Path(mission_file), _project(store)
    if path.is_relative_to(project):
        row = (mission_file, path.relative_to(project).as_posix())
        connection.execute("INSERT OR REPLACE INTO places VALUES (?, ?)", row)


def place_now(connection: sqlite3.Connection, store: Path, mission_file: str) -> str:
    """The file at the same place of the project that the store is in now; else where it was."""
    row = connection.execute("SELECT below FROM places WHERE mission_file = ?", (mission_file,)).fetchone()
    found = _project(store) / row[0] if row is not None else None
    return str(found) if found is not None and found.is_file() else mission_file


def names_of(connection: sqlite3.Connection, store: Path, mission_file: str) -> tuple[str, ...]:
    """The names under which a store has what was flown of a mission file, that of today first."""
    path, project = Path(mission_file), _project(store)
    if not path.is_relative_to(project):
        return (mission_file,)
    below = path.relative_to(project).as_posix()
    rows = connection.execute("SELECT mission_file FROM places WHERE below = ? ORDER BY mission_file", (below,))
    return tuple(dict.fromkeys((mission_file, *(name for (name,) in rows))))


def _project(store: Path) -> Path:
    folder = Path(os.path.realpath(store)).parent
    return folder.parent if folder.name == FOLDER else folder
