"""Keep runs and their missions in an SQLite file, transactionally, so that a batch can be resumed and explained."""

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from checker.batch.result import MissionResult, read_result, write_result
from checker.oracle import Verdict

LATEST = "latest"
FOLDER = ".nddlc"
_COMMIT_EVERY = 64  # results
_VERSION = 2  # of the schema and of `write_result`; other versions are not read
SCHEMA = """
CREATE TABLE IF NOT EXISTS runs (
    turn INTEGER PRIMARY KEY AUTOINCREMENT,
    id TEXT NOT NULL UNIQUE,
    mission_file TEXT NOT NULL,
    seed INTEGER NOT NULL,
    missions INTEGER NOT NULL
);
CREATE TABLE IF NOT EXISTS missions (
    run TEXT NOT NULL,
    number INTEGER NOT NULL,
    verdict TEXT NOT NULL,
    result TEXT NOT NULL,
    PRIMARY KEY (run, number)
) WITHOUT ROWID;
"""


class StoreError(Exception):
    """The store cannot be used; the message says why, in the user's words."""


@dataclass(frozen=True, slots=True)
class Run:
    """A batch: `id` names its content, so the same batch has the same id wherever it is flown."""

    id: str
    mission_file: str  # absolute path
    seed: int
    missions: int


class RunStore:
    """Runs on disk. Results are written in transactions: a reader sees whole missions or none."""

    def __init__(self, connection: sqlite3.Connection) -> None:
        self._connection = connection
        self._pending: list[tuple[str, int, str, str]] = []

    def begin(self, run: Run, *, keep: bool) -> dict[int, MissionResult]:
        """Register `run` as the latest; return what it has finished before if `keep`, else forget that.

        A mission that ended in an ERROR was not finished.
        """
        found = self.results(run.id) if keep else ()
        kept = {result.number: result for result in found if result.verdict is not Verdict.ERROR}
        with self._connection:
            if not keep:
                self._connection.execute("DELETE FROM missions WHERE run = ?", (run.id,))
            self._connection.execute("DELETE FROM runs WHERE id = ?", (run.id,))
            self._connection.execute(
                "INSERT INTO runs (id, mission_file, seed, missions) VALUES (?, ?, ?, ?)",
                (run.id, run.mission_file, run.seed, run.missions),
            )
        return kept

    def add(self, run: Run, result: MissionResult) -> None:
        """Keep a result; it is on disk after the next `flush` at the latest."""
        self._pending.append((run.id, result.number, result.verdict.value, write_result(result)))
        if len(self._pending) >= _COMMIT_EVERY:
            self.flush()

    def flush(self) -> None:
        """Write what is pending."""
        with self._connection:
            self._connection.executemany("INSERT OR REPLACE INTO missions VALUES (?, ?, ?, ?)", self._pending)
        self._pending.clear()

    def find(self, name: str) -> Run | None:
        """The run with that id, or the one that began last for `latest`; a unique beginning of an id will do."""
        chosen = "SELECT id, mission_file, seed, missions FROM runs "
        if name == LATEST:
            rows = self._connection.execute(chosen + "ORDER BY turn DESC LIMIT 1").fetchall()
        else:
            rows = self._connection.execute(chosen + "WHERE substr(id, 1, ?) = ?", (len(name), name)).fetchall()
        return Run(*rows[0]) if len(rows) == 1 else None

    def run_ids(self) -> list[str]:
        """All runs, the latest first."""
        return [row[0] for row in self._connection.execute("SELECT id FROM runs ORDER BY turn DESC")]

    def results(self, run_id: str) -> Iterator[MissionResult]:
        """The finished missions of a run, in order."""
        rows = self._connection.execute("SELECT result FROM missions WHERE run = ? ORDER BY number", (run_id,))
        return (read_result(row[0]) for row in rows)

    def result(self, run_id: str, number: int) -> MissionResult | None:
        """One finished mission of a run."""
        query = "SELECT result FROM missions WHERE run = ? AND number = ?"
        row = self._connection.execute(query, (run_id, number)).fetchone()
        return read_result(row[0]) if row else None


@contextmanager
def open_store(path: Path) -> Iterator[RunStore]:
    """Open or make the store at `path`; whatever happens inside, finished missions are written."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.parent.name == FOLDER and not (path.parent / ".gitignore").exists():
            (path.parent / ".gitignore").write_text("*\n", encoding="ascii")  # nothing in here is for others
        connection = sqlite3.connect(path, timeout=10.0)
        _prepare(connection, path)
    except (OSError, sqlite3.Error) as problem:
        reason = getattr(problem, "strerror", None) or problem
        raise StoreError(f"the store `{path}` cannot be opened: {reason}") from problem
    store = RunStore(connection)
    try:
        yield store
    finally:
        try:
            store.flush()
        finally:
            connection.close()


def _prepare(connection: sqlite3.Connection, path: Path) -> None:
    """Make the tables of a new store; refuse one that another version of nddlc has written."""
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    if connection.execute("SELECT COUNT(*) FROM sqlite_master").fetchone() == (0,):
        version = _VERSION
    if version != _VERSION:
        connection.close()
        what = f"the store `{path}` has format {version or 1}, this nddlc reads format {_VERSION}"
        raise StoreError(f"{what}: delete it, or keep it and name another")
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("PRAGMA synchronous = NORMAL")
    connection.executescript(f"PRAGMA user_version = {_VERSION};{SCHEMA}")
