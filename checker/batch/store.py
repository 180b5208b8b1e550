"""Keep runs and their missions in an SQLite file, transactionally, so that a batch can be resumed and explained.

Each row carries a checksum; a store carries the mark of nddlc and the version of its format. Whatever is wrong with a
store is a `StoreError` that says what to do about it.
"""

import os
import sqlite3
import time
import zlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from checker.batch.lock import Locks
from checker.batch.reading import readable_place
from checker.batch.result import MissionResult, read_record, write_record
from checker.batch.write_ahead_log import log_damage
from checker.oracle import Verdict
from checker.regression import RegressionCase
from checker.sampling.sampler import SamplePoint
from nddl_lang.mission_suffixes import MISSION_SUFFIXES

LATEST = "latest"
_FOLDER = ".nddlc"
_VERSION = 5  # of the schema and of `write_record`; other versions are not read
_MARK = 0x4E44444C  # `NDDL`: the application id of SQLite's file format
_FLUSH_SECONDS = 0.5
_MOST_FAILURES = 40  # kept of one mission file
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
CREATE TABLE IF NOT EXISTS missions (
    run TEXT NOT NULL,
    number INTEGER NOT NULL,
    verdict TEXT NOT NULL,
    result TEXT NOT NULL,
    checksum INTEGER NOT NULL,
    PRIMARY KEY (run, number)
) WITHOUT ROWID;
"""
_READS = "--store names another one"
_SALVAGE = "`nddlc store check` tells what is damaged, `nddlc store salvage` keeps what is whole"
_NO_SPACE = ("SQLITE_FULL", "SQLITE_IOERR_WRITE", "SQLITE_IOERR_FSYNC", "SQLITE_IOERR_TRUNCATE", "SQLITE_IOERR_SHMSIZE")


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


def _checksum(run_id: str, number: int, verdict: str, result: str) -> int:
    """The CRC-32 of a row."""
    return zlib.crc32(f"{run_id}\0{number}\0{verdict}\0{result}".encode("utf-8", "surrogatepass"))


class RunStore:
    """Runs on disk. Results are written in transactions: a reader sees whole missions or none."""

    def __init__(self, connection: sqlite3.Connection, path: Path) -> None:
        self.path = path
        self._connection = connection
        self._pending: list[tuple[str, int, str, str, int]] = []
        self._flushed = time.monotonic()
        self._locks: Locks | None = None
        self._file = _file_at(path)

    def begin(self, run: Run, *, keep: bool) -> dict[int, MissionResult]:
        """Register `run` as the latest; return what it has finished before if `keep`, else forget that.

        A mission that ended in an ERROR was not finished. While this process lives, no other one can begin the run.
        """
        if self._locks is None:
            self._locks = Locks(self.path.with_name(self.path.name + ".lock"))
        if not self._locks.take(run.id):
            what = f"another nddlc flies run {run.id} into the store `{self.path}` just now"
            raise StoreError(what, "wait until it has ended; what it has flown is then taken over")
        found = self.results(run.id) if keep else ()
        kept = {result.number: result for result in found if result.verdict is not Verdict.ERROR}
        with self._guarded(), self._connection:
            if not keep:
                self._connection.execute("DELETE FROM missions WHERE run = ?", (run.id,))
            self._connection.execute("DELETE FROM runs WHERE id = ?", (run.id,))
            self._connection.execute(
                "INSERT INTO runs (id, mission_file, seed, missions, sampler) VALUES (?, ?, ?, ?, ?)",
                (run.id, run.mission_file, run.seed, run.missions, run.sampler),
            )
        return kept

    def add(self, run: Run, result: MissionResult) -> None:
        """Keep a result; it is on disk after the next `flush` at the latest."""
        verdict, text = result.verdict.value, write_record(result)
        self._pending.append((run.id, result.number, verdict, text, _checksum(run.id, result.number, verdict, text)))
        self.flush_if_due()

    def flush_if_due(self) -> None:
        """Write what is pending, unless that was done just now."""
        if self._pending and time.monotonic() - self._flushed >= _FLUSH_SECONDS:
            self.flush()

    def flush(self) -> None:
        """Write what is pending."""
        if self._pending:
            with self._guarded(), self._connection:
                query = "INSERT OR REPLACE INTO missions VALUES (?, ?, ?, ?, ?)"
                self._connection.executemany(query, self._pending)
            self._pending.clear()
            if _file_at(self.path) != self._file:
                what = f"the store `{self.path}` was moved, removed or replaced while it was written to"
                raise StoreError(what, "if you have moved it, all that was flown is in it: --store names its new place")
        self._flushed = time.monotonic()

    def find(self, name: str) -> Run | None:
        """The run with that id, or the one that began last: of all for `latest`, of one mission file for its path.

        A unique beginning of an id will do.
        """
        chosen = "SELECT id, mission_file, seed, missions, sampler FROM runs "
        if name == LATEST:
            rows = self._rows(chosen + "ORDER BY turn DESC LIMIT 1")
        elif name.endswith(MISSION_SUFFIXES):
            rows = self._rows(chosen + "WHERE mission_file = ? ORDER BY turn DESC LIMIT 1", str(Path(name).resolve()))
        else:
            rows = self._rows(chosen + "WHERE substr(id, 1, ?) = ?", len(name), name)
        return Run(*rows[0]) if len(rows) == 1 else None

    def run_ids(self) -> list[str]:
        """All runs, the latest first."""
        return [row[0] for row in self._rows("SELECT id FROM runs ORDER BY turn DESC")]

    def results(self, run_id: str) -> tuple[MissionResult, ...]:
        """The finished missions of a run, in order."""
        query = "SELECT run, number, verdict, result, checksum FROM missions WHERE run = ? ORDER BY number"
        return tuple(self._read(row) for row in self._rows(query, run_id))

    def result(self, run_id: str, number: int) -> MissionResult | None:
        """One finished mission of a run."""
        query = "SELECT run, number, verdict, result, checksum FROM missions WHERE run = ? AND number = ?"
        rows = self._rows(query, run_id, number)
        return self._read(rows[0]) if rows else None

    def keep_failures(self, run: Run, results: Sequence[MissionResult]) -> None:
        """Remember missions that failed, for later runs of the same mission file; of very many the latest."""
        rows = [
            (run.mission_file, one.seed, write_record(one.point), one.judgement.code, run.id)
            for one in results
            if one.verdict is Verdict.FAIL
        ]
        query = "INSERT OR IGNORE INTO failures (mission_file, seed, point, code, run) VALUES (?, ?, ?, ?, ?)"
        with self._guarded(), self._connection:
            self._connection.executemany(query, rows[:_MOST_FAILURES])
            self._connection.execute(
                "DELETE FROM failures WHERE mission_file = ? AND turn NOT IN"
                " (SELECT turn FROM failures WHERE mission_file = ? ORDER BY turn DESC LIMIT ?)",
                (run.mission_file, run.mission_file, _MOST_FAILURES),
            )

    def keep_conditions(self, run_id: str, texts: Mapping[int, str]) -> None:
        """Remember under what conditions missions fail, by the number of the example."""
        rows = [(run_id, example, text) for example, text in texts.items()]
        with self._guarded(), self._connection:
            self._connection.executemany("INSERT OR REPLACE INTO conditions VALUES (?, ?, ?)", rows)

    def conditions(self, run_id: str) -> dict[int, str]:
        """What `keep_conditions` kept."""
        return dict(self._rows("SELECT example, text FROM conditions WHERE run = ?", run_id))

    def keep_causes(self, run_id: str, texts: Mapping[int, str]) -> None:
        """Remember what trials have shown of faults, by the number of the example."""
        rows = [(run_id, example, text) for example, text in texts.items()]
        with self._guarded(), self._connection:
            self._connection.executemany("INSERT OR REPLACE INTO causes VALUES (?, ?, ?)", rows)

    def causes(self, run_id: str) -> dict[int, str]:
        """What `keep_causes` kept."""
        return dict(self._rows("SELECT example, text FROM causes WHERE run = ?", run_id))

    def failures(self, run: Run) -> tuple[RegressionCase, ...]:
        """The missions that failed in other runs of the same mission file, in the order in which they were kept."""
        query = "SELECT seed, code, point FROM failures WHERE mission_file = ? AND run != ? ORDER BY turn"
        rows = self._rows(query, run.mission_file, run.id)
        return tuple(RegressionCase("", seed, code, read_record(SamplePoint, point)) for seed, code, point in rows)

    def close(self) -> None:
        """Write what is pending and let go of the file."""
        try:
            self.flush()
        finally:
            self._connection.close()
            if self._locks is not None:
                self._locks.close()

    def _rows(self, query: str, *values: object) -> list[Any]:
        with self._guarded():
            return self._connection.execute(query, values).fetchall()

    def _read(self, row: tuple[str, int, str, str, int]) -> MissionResult:
        found = result_of(row)
        if found is None:
            raise StoreError(f"mission {row[1]} of run {row[0]} in the store `{self.path}` is damaged", _SALVAGE)
        return found

    @contextmanager
    def _guarded(self) -> Iterator[None]:
        """Tell what is wrong with the file, or the disk, in the user's words."""
        try:
            yield
        except sqlite3.Error as problem:
            raise _told(problem, self.path) from problem


def _file_at(path: Path) -> tuple[int, int] | None:
    """What tells the file at a path from every other one; None where there is none."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_dev, found.st_ino


def result_of(row: tuple[object, ...]) -> MissionResult | None:
    """The result in a row (run, number, verdict, result, checksum); None where the row is damaged."""
    run, number, verdict, text, written = row
    if not (isinstance(run, str) and isinstance(number, int) and isinstance(verdict, str) and isinstance(text, str)):
        return None
    if _checksum(run, number, verdict, text) != written:
        return None
    return read_record(MissionResult, text)


def _told(problem: sqlite3.Error, path: Path) -> StoreError:
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
        return StoreError(f"the store `{path}` is damaged: {problem}", _SALVAGE)
    return StoreError(f"the store `{path}` cannot be used: {problem}")


@contextmanager
def open_store(path: Path) -> Iterator[RunStore]:
    """Open or make the store at `path`; whatever happens inside, finished missions are written."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.parent.name == _FOLDER and not (path.parent / ".gitignore").exists():
            (path.parent / ".gitignore").write_text("*\n", encoding="ascii")  # nothing in here is for others
        if path.exists() and not path.is_file():
            raise StoreError(f"`{path}` is no file that a store could be in")
    except OSError as problem:
        raise StoreError(f"the store `{path}` cannot be opened: {problem.strerror or problem}") from problem
    with _opened(path, path) as store:
        yield store


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


@contextmanager
def read_store(path: Path) -> Iterator[RunStore]:
    """Open the store at `path` to read from it; nothing needs to be writable there."""
    with place_to_read(path) as place, _opened(place, path) as store:
        yield store


@contextmanager
def _opened(place: Path, path: Path) -> Iterator[RunStore]:
    """The store that lies at `place` and is called `path`."""
    store = RunStore(_connect(place, path), path)
    try:
        yield store
    except BaseException:
        with suppress(StoreError):  # what went wrong first is what is told
            store.close()
        raise
    store.close()


def _connect(place: Path, path: Path) -> sqlite3.Connection:
    """A connection to a store of this version; a new one gets its tables."""
    connection: sqlite3.Connection | None = None
    try:
        if damage := log_damage(place, path):
            raise StoreError(f"the store `{path}` is damaged: {damage}", _SALVAGE)
        connection = sqlite3.connect(place, timeout=10.0)
        check_version(connection, path)
        connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = NORMAL")
        connection.executescript(f"PRAGMA application_id = {_MARK};PRAGMA user_version = {_VERSION};{_SCHEMA}")
    except (sqlite3.Error, StoreError) as problem:
        if connection is not None:
            connection.close()
        if isinstance(problem, StoreError):
            raise
        if not os.access(path.parent, os.W_OK):
            raise StoreError(f"the store `{path}` cannot be opened: its folder may not be written") from problem
        raise _told(problem, path) from problem
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
