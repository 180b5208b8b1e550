"""The file of a store in, a connection to it out, of this version; or a StoreError that says what to do about it."""

import os
import sqlite3
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from checker.batch.moved import PLACES, names_of, place_now
from checker.batch.reading import readable_place
from checker.batch.write_ahead_log import log_damage
from nddl_lang.mission_suffixes import MISSION_SUFFIXES

LATEST = "latest"
SALVAGE = "`nddlc store check` tells what is damaged, `nddlc store salvage` keeps what is whole"
_VERSION = 5  # of the schema and of `write_record`; other versions are not read
_MARK = 0x4E44444C  # `NDDL`: the application id of SQLite's file format
_READS = "--store names another one"
_NO_SPACE = ("SQLITE_FULL", "SQLITE_IOERR_WRITE", "SQLITE_IOERR_FSYNC", "SQLITE_IOERR_TRUNCATE", "SQLITE_IOERR_SHMSIZE")
_SCHEMA = """
CREATE TABLE IF NOT EXISTS runs (
    turn INTEGER PRIMARY KEY AUTOINCREMENT,
    id TEXT NOT NULL UNIQUE,
    mission_file TEXT NOT NULL,
    seed INTEGER NOT NULL,
    missions INTEGER NOT NULL,
    sampler TEXT NOT NULL
);
CREATE TABLE IF NOT EXISTS failures (
    turn INTEGER PRIMARY KEY AUTOINCREMENT,
    mission_file TEXT NOT NULL,
    seed INTEGER NOT NULL,
    point TEXT NOT NULL,
    code TEXT NOT NULL,
    run TEXT NOT NULL,
    UNIQUE (mission_file, seed, point)
);
CREATE TABLE IF NOT EXISTS conditions (
    run TEXT NOT NULL,
    example INTEGER NOT NULL,
    text TEXT NOT NULL,
    PRIMARY KEY (run, example)
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS causes (
    run TEXT NOT NULL,
    example INTEGER NOT NULL,
    text TEXT NOT NULL,
    PRIMARY KEY (run, example)
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS sought (
    run TEXT NOT NULL,
    seal TEXT NOT NULL,
    text TEXT NOT NULL,
    PRIMARY KEY (run)
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS explanations (
    run TEXT NOT NULL,
    mission INTEGER NOT NULL,
    is_first INTEGER NOT NULL,
    flights INTEGER,
    sources TEXT NOT NULL,
    seal TEXT NOT NULL,
    text TEXT NOT NULL,
    PRIMARY KEY (run, mission)
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS missions (
    run TEXT NOT NULL,
    number INTEGER NOT NULL,
    verdict TEXT NOT NULL,
    result TEXT NOT NULL,
    checksum INTEGER NOT NULL,
    PRIMARY KEY (run, number)
) WITHOUT ROWID;
"""


class StoreError(Exception):
    """The store cannot be used; the message says why, in the user's words, and `advice` what to do."""

    def __init__(self, message: str, advice: str = "--store names another one, --no-store does without") -> None:
        super().__init__(message)
        self.advice = advice


@dataclass(frozen=True, slots=True)
class Run:
    """A batch: `id` names its content, so the same batch has the same id wherever it is flown."""

    id: str
    mission_file: str  # absolute path
    seed: int
    missions: int
    sampler: str = "random"


def store_error(problem: sqlite3.Error, path: Path) -> StoreError:
    """What SQLite complains of, in words."""
    name = getattr(problem, "sqlite_errorname", "")
    if name in _NO_SPACE:
        what = f"the store `{path}` cannot be written: no space is left on the disk, or in the quota"
        return StoreError(what, "what was stored before is kept; make room, and the same command goes on from there")
    if name.startswith(("SQLITE_BUSY", "SQLITE_LOCKED")):
        return StoreError(f"another process keeps the store `{path}` locked", "wait until it has ended")
    if name.startswith(("SQLITE_READONLY", "SQLITE_PERM")):
        return StoreError(f"the store `{path}` may not be written")
    if name.startswith("SQLITE_NOTADB"):
        return StoreError(f"`{path}` is no store of nddlc: it is no database")
    if name.startswith("SQLITE_CORRUPT"):
        return StoreError(f"the store `{path}` is damaged: {problem}", SALVAGE)
    return StoreError(f"the store `{path}` cannot be used: {problem}")


@contextmanager
def place_to_read(path: Path) -> Iterator[Path]:
    """Where SQLite can read the store at `path`; raises StoreError where there is none, or it cannot be read."""
    if not path.is_file():
        raise StoreError(f"there is no store `{path}`", "`nddlc check` makes one; --store names another")
    with ExitStack() as stack:
        try:
            place = stack.enter_context(readable_place(path))
        except OSError as problem:
            raise StoreError(f"the store `{path}` cannot be read: {problem.strerror or problem}", _READS) from problem
        yield place


def connect(place: Path, path: Path) -> sqlite3.Connection:
    """A connection to a store of this version; a new one gets its tables."""
    connection: sqlite3.Connection | None = None
    try:
        if damage := log_damage(place, path):
            raise StoreError(f"the store `{path}` is damaged: {damage}", SALVAGE)
        connection = sqlite3.connect(place, timeout=10.0)
        check_version(connection, path)
        connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = NORMAL")
        connection.executescript(f"PRAGMA application_id = {_MARK};PRAGMA user_version = {_VERSION};{_SCHEMA}{PLACES}")
    except (sqlite3.Error, StoreError) as problem:
        if connection is not None:
            connection.close()
        if isinstance(problem, StoreError):
            raise
        if not os.access(path.parent, os.W_OK):
            raise StoreError(f"the store `{path}` cannot be opened: its folder may not be written") from problem
        raise store_error(problem, path) from problem
    return connection


def check_version(connection: sqlite3.Connection, path: Path) -> None:
    """Refuse a database that is no store, or one of another version of nddlc; an empty one is welcome."""
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    (mark,) = connection.execute("PRAGMA application_id").fetchone()
    tables = {row[0] for row in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
    if not tables:
        return
    if mark != _MARK and not {"runs", "missions"} <= tables:
        raise StoreError(f"`{path}` is a database of something else, not a store of nddlc")
    if mark == _MARK and version == _VERSION:
        return
    age = "a newer" if version > _VERSION else "an older"
    what = f"the store `{path}` is of {age} nddlc: it has format {version or 1}, this one reads format {_VERSION}"
    raise StoreError(what, "delete it, or keep it and name another with --store")


def find_run(connection: sqlite3.Connection, store: Path, name: str) -> Run | None:
    """The run with that id, or the one that began last: of all for `latest`, of one mission file for its path.

    A unique beginning of an id will do. Where the project was copied with its `store`, the run is of the copy.
    """
    chosen = "SELECT id, mission_file, seed, missions, sampler FROM runs "
    if name == LATEST:
        rows = connection.execute(chosen + "ORDER BY turn DESC LIMIT 1").fetchall()
    elif name.endswith(MISSION_SUFFIXES):
        names = names_of(connection, store, str(Path(name).resolve()))
        query = chosen + f"WHERE mission_file IN ({', '.join('?' * len(names))}) ORDER BY turn DESC LIMIT 1"
        rows = connection.execute(query, names).fetchall()
    else:
        rows = connection.execute(chosen + "WHERE substr(id, 1, ?) = ?", (len(name), name)).fetchall()
    if len(rows) != 1:
        return None
    run = Run(*rows[0])
    return replace(run, mission_file=place_now(connection, store, run.mission_file))
