"""Keep runs and their missions in an SQLite file, transactionally, so that a batch can be resumed and explained.

Each row carries a checksum; a store carries the mark of nddlc and the version of its format. Whatever is wrong with a
store is a `StoreError` that says what to do about it.
"""

import sqlite3
import time
import zlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from checker.batch.connection import SALVAGE, Run, StoreError, connect, find_run, place_to_read, store_error
from checker.batch.explanations import Explanation, row_of
from checker.batch.lock import Locks
from checker.batch.moved import FOLDER, names_of, note_place
from checker.batch.result import MissionResult, read_record, write_record
from checker.oracle import Verdict
from checker.regression import RegressionCase
from checker.sampling.sampler import SamplePoint

_FLUSH_SECONDS = 0.5
_MOST_FAILURES = 40  # kept of one mission file


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
            if len(kept) < run.missions:  # pages would tell of fewer missions
                self._connection.execute("DELETE FROM explanations WHERE run = ?", (run.id,))
            if not keep:
                self._connection.execute("DELETE FROM missions WHERE run = ?", (run.id,))
                self._connection.execute("DELETE FROM sought WHERE run = ?", (run.id,))
            self._connection.execute("DELETE FROM runs WHERE id = ?", (run.id,))
            self._connection.execute(
                "INSERT INTO runs (id, mission_file, seed, missions, sampler) VALUES (?, ?, ?, ?, ?)",
                (run.id, run.mission_file, run.seed, run.missions, run.sampler),
            )
            note_place(self._connection, self.path, run.mission_file)
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
        with self._guarded():
            return find_run(self._connection, self.path, name)

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
            self._connection.execute("DELETE FROM explanations WHERE run = ?", (run_id,))  # they tell of others
            self._connection.executemany("INSERT OR REPLACE INTO causes VALUES (?, ?, ?)", rows)

    def causes(self, run_id: str) -> dict[int, str]:
        """What `keep_causes` kept."""
        return dict(self._rows("SELECT example, text FROM causes WHERE run = ?", run_id))

    def keep_sought(self, run_id: str, seal: str, text: str) -> None:
        """Remember all that was found of the faults of a run, and what it depends on."""
        with self._guarded(), self._connection:
            self._connection.execute("INSERT OR REPLACE INTO sought VALUES (?, ?, ?)", (run_id, seal, text))

    def sought(self, run_id: str, seal: str) -> str | None:
        """What `keep_sought` kept, if it depends on the same."""
        rows = self._rows("SELECT seal, text FROM sought WHERE run = ?", run_id)
        return next((text for kept, text in rows if kept == seal), None)

    def keep_explanations(self, run_id: str, explanations: Sequence[Explanation]) -> None:
        """Remember what there is to tell of failures."""
        rows = [(run_id, *row_of(one)) for one in explanations]
        with self._guarded(), self._connection:
            self._connection.executemany("INSERT OR REPLACE INTO explanations VALUES (?, ?, ?, ?, ?, ?, ?)", rows)

    def failures(self, run: Run) -> tuple[RegressionCase, ...]:
        """The missions that failed in other runs of the same mission file, in the order in which they were kept."""
        with self._guarded():
            names = names_of(self._connection, self.path, run.mission_file)
        places = ", ".join("?" * len(names))
        query = f"SELECT seed, code, point FROM failures WHERE mission_file IN ({places}) AND run != ?"
        query += " GROUP BY seed, point ORDER BY turn"
        rows = self._rows(query, *names, run.id)
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
            raise StoreError(f"mission {row[1]} of run {row[0]} in the store `{self.path}` is damaged", SALVAGE)
        return found

    @contextmanager
    def _guarded(self) -> Iterator[None]:
        """Tell what is wrong with the file, or the disk, in the user's words."""
        try:
            yield
        except sqlite3.Error as problem:
            raise store_error(problem, self.path) from problem


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


@contextmanager
def open_store(path: Path) -> Iterator[RunStore]:
    """Open or make the store at `path`; whatever happens inside, finished missions are written."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.parent.name == FOLDER and not (path.parent / ".gitignore").exists():
            (path.parent / ".gitignore").write_text("*\n", encoding="ascii")  # nothing in here is for others
        if path.exists() and not path.is_file():
            raise StoreError(f"`{path}` is no file that a store could be in")
    except OSError as problem:
        raise StoreError(f"the store `{path}` cannot be opened: {problem.strerror or problem}") from problem
    with _opened(path, path) as store:
        yield store


@contextmanager
def read_store(path: Path) -> Iterator[RunStore]:
    """Open the store at `path` to read from it; nothing needs to be writable there."""
    with place_to_read(path) as place, _opened(place, path) as store:
        yield store


@contextmanager
def _opened(place: Path, path: Path) -> Iterator[RunStore]:
    """The store that lies at `place` and is called `path`."""
    store = RunStore(connect(place, path), path)
    try:
        yield store
    except BaseException:
        with suppress(StoreError):  # what went wrong first is what is told
            store.close()
        raise
    store.close()
